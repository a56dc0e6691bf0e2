// Compression (docs/stability.md): a sheet with bending stiffness bears up to Euler's strain and then buckles at its
// own length, on any mesh; a membrane of trusses folds at once, at the length of its cells. Yarns too soft in
// compression shorten where they should give way.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "tests/support/trust.hpp"

namespace weaveform {
namespace {

using test::Solved;

constexpr double strip_length = 118.08;  // mm; twelve cells of the plain weave at coarsening 2

// A strip pressed together by `shortening` mm between clamps. A thousandth of its weight lets it leave its plane;
// linear yarns, for those of the card have no stiffness to hold that little at zero strain; a tenth of theirs, for the
// time.
Scene pressed_together(double shortening, double coarsening, YarnElement yarn, CellElement cell) {
  Scene scene = test::strip_scene("twintex-pw", {strip_length, 59.04}, coarsening, -shortening);
  scene.model.yarn = yarn;
  scene.model.cell = cell;
  scene.model.yarn_law = YarnLaw::linear;
  scene.model.yarn_stiffness_scale = 0.1;
  scene.analysis.gravity = {0.0, 0.0, -10.0};
  scene.analysis.duration = 0.5;
  scene.analysis.damping = 20.0;
  scene.output.history = 20;
  return scene;
}

// N mm per width; Euler's rigidity, 4 pi^2 D/L^2 = E_c A/h * strain between clamps.
double euler_rigidity(const Scene& scene) {
  const YarnCard yarn = load_card(scene.fabric.material).yarn[0];
  const double stiffness = scene.model.yarn_stiffness_scale * yarn.compression_modulus * yarn.section / yarn.interval;
  const double shortening = -scene.grip[1].travel;
  return stiffness * shortening * strip_length / (4.0 * std::numbers::pi * std::numbers::pi);
}

void set_rigidity(Scene& scene, double rigidity) {
  if (scene.model.yarn == YarnElement::beam)
    scene.model.yarn_bending = {0.0, rigidity * load_card(scene.fabric.material).yarn[0].interval};
  else
    scene.model.cell_bending = {rigidity, rigidity, 0.1 * rigidity};
}

Folds folds_of(const Solved& run) {
  return find_folds(run.scene, run.mesh, run.result.position).value();
}

// bench/stability/euler.toml finds the border within 8 % of Euler's rigidity, on every mesh and for every element. A
// buckle grows slowly near it, hence the 0.7.
TEST(StabilityCompression, SheetsThatBendBuckleAtEulersStrainOnEveryMesh) {
  for (const auto& [yarn, cell, coarsening] : {std::tuple{YarnElement::beam, CellElement::membrane, 4.0},
                                               std::tuple{YarnElement::beam, CellElement::membrane, 2.0},
                                               std::tuple{YarnElement::truss, CellElement::shell, 2.0},
                                               std::tuple{YarnElement::truss, CellElement::rotation_free, 4.0}}) {
    SCOPED_TRACE(testing::Message() << name_of(yarn) << " + " << name_of(cell) << ", coarsening " << coarsening);
    Scene scene = pressed_together(0.1, coarsening, yarn, cell);
    const double euler = euler_rigidity(scene), half_thickness = 0.25;  // N mm, mm
    set_rigidity(scene, 1.25 * euler);
    EXPECT_LT(folds_of(Solved(scene)).out_of_plane, half_thickness);
    set_rigidity(scene, 0.7 * euler);
    const Solved buckled(scene);
    const Folds folds = folds_of(buckled);
    EXPECT_GT(folds.out_of_plane, half_thickness);
    EXPECT_LT(folds.zigzag_height, 0.15 * folds.out_of_plane) << "one buckle as long as the strip, 6 cells or 12";
    EXPECT_TRUE(test::warnings_of(buckled).empty());
  }
}

// Four times Euler's strain of a sheet: that has one buckle, the membrane as many as its cells let it have.
TEST(StabilityCompression, AMembraneFoldsFromCellToCellAndSaysSo) {
  for (const double coarsening : {4.0, 2.0}) {
    SCOPED_TRACE(coarsening);
    const Solved membrane(pressed_together(2.0, coarsening, YarnElement::truss, CellElement::membrane));
    EXPECT_GT(folds_of(membrane).zigzag_share, 0.2);
    EXPECT_TRUE(test::says(test::warnings_of(membrane), "no bending stiffness"));
  }
  Scene scene = pressed_together(2.0, 2.0, YarnElement::truss, CellElement::rotation_free);
  set_rigidity(scene, 0.25 * euler_rigidity(scene));
  const Solved sheet(scene);
  EXPECT_GT(folds_of(sheet).out_of_plane, 5.0);
  EXPECT_EQ(folds_of(sheet).zigzag_share, 0.0);
  EXPECT_TRUE(test::warnings_of(sheet).empty());
}

// Pressed by a quarter of its length the membrane turns cells over.
TEST(StabilityCompression, CellsThatAreTurnedOverAreToldOf) {
  Scene scene = pressed_together(30.0, 4.0, YarnElement::truss, CellElement::membrane);
  scene.analysis.duration = 0.2;
  scene.analysis.damping.reset();
  const Solved run(scene);
  EXPECT_GT(run.result.statistics.folded_cells_at_end, 0);
  EXPECT_TRUE(test::says(test::warnings_of(run), "folded over"));
}

// bench/stability/compression_modulus.toml: on the hemisphere the punch force leaves that of stiff yarns by 2 % at a
// modulus of 33 MPa at coarsening 4; yarns shorten by 1.7 % at 60 MPa, by 2.9 % at 20.
TEST(StabilityCompression, YarnsTooSoftInCompressionTakeForceAndAngleAwayAndSaySo) {
  Scene scene = test::example("hemisphere_pw",
                              {"blank.coarsening=4", "analysis.duration=0.2", test::late_punch, "output.frames=0"});
  const auto force_at = [&](double modulus, bool warned) {
    scene.model.compression_modulus = modulus;
    const Solved run(scene);
    EXPECT_EQ(test::says(test::warnings_of(run), "yarns shorten"), warned) << modulus;
    return run.last("punch.force_N");
  };
  const double stiff = force_at(2000.0, false);
  EXPECT_NEAR(force_at(80.0, false) / stiff, 1.0, 0.02);
  EXPECT_LT(force_at(25.0, true) / stiff, 0.98);
}

// The modulus acts on every yarn that is pressed, and on none that is pulled. With the step that follows the strains
// reached 1e-3: viscosity goes with the step, and that with the modulus where it is the stiffest.
TEST(StabilityCompression, APulledFabricDoesNotKnowTheModulus) {
  Scene scene = test::example("bias_extension_pw", {"blank.coarsening=4", "analysis.duration=0.2", "output.frames=0"});
  const auto load_at = [&](double modulus) {
    scene.model.compression_modulus = modulus;
    return Solved(scene).last("top.force_N");
  };
  EXPECT_NEAR(load_at(0.0) / load_at(2000.0), 1.0, 1e-3);
  scene.analysis.step_bound = StepBound::stiffest;
  EXPECT_NEAR(load_at(0.0) / load_at(2000.0), 1.0, 1e-4);
}

}  // namespace
}  // namespace weaveform
