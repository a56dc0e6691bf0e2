// A half or quarter in any symmetric shape feels the forces of the whole and has its stable step.
#include "solver/constraint/mirror_planes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesher/symmetry/cut_part.hpp"
#include "solver/ply/ply.hpp"
#include "tests/support/chosen.hpp"
#include "tests/support/contact_scene.hpp"
#include "tests/support/fabric_patch.hpp"

namespace weaveform {
namespace {

using Eigen::Vector3d;

struct Case {
  double yarn_angle;
  std::array<double, 2> phase;
  Formulation formulation;
  const char* symmetry;
  bool bending = false;
  const char* yarn = "truss";
};

// Mirrored at x = 0 and y = 0: stretched, sheared out of shape and bent out of the plane.
Vec3 shaped(const Vec3& x) {
  const double a = x[0] / 60.0, b = x[1] / 80.0;
  return {x[0] * (1.01 + 0.05 * b * b), x[1] * (1.0 + 0.08 * a * a), 3.0 * a * a + 2.0 * b * b};
}

struct Moved {
  std::unique_ptr<Ply> ply;

  Moved(const Mesh& whole, const SymmetricPart* part, const Scene& scene, const Card& card)
      : ply(std::make_unique<Ply>(
            PlySetup{.whole = whole, .part = part, .scene = scene, .card = card, .team = alone()})) {
    const Mesh& mesh = ply->mesh();
    for (int n = 0; n < mesh.node_count(); ++n) {
      const Vec3 x = shaped(mesh.nodes.position[n]);
      for (int c = 0; c < 3; ++c) ply->state().position[c][ply->packed().packed_of_mesh[n]] = x[c];
    }
    ply->follow();
    ply->compute_forces(0.0);
  }
  [[nodiscard]] Vector3d force(int n) const {
    const int p = ply->packed().packed_of_mesh[n];
    return {ply->state().force[0][p], ply->state().force[1][p], ply->state().force[2][p]};
  }
  [[nodiscard]] double mass(int n) const { return ply->packed().mass[ply->packed().packed_of_mesh[n]]; }
};

TEST(MirrorPlanes, AccelerationsAndStepAreThoseOfTheWhole) {
  const std::vector<Case> cases = {{0.0, {0.0, 0.0}, Formulation::energy, "quarter"},
                                   {0.0, {0.5, 0.5}, Formulation::energy, "quarter"},
                                   {90.0, {0.5, 0.0}, Formulation::energy, "quarter"},
                                   {45.0, {0.0, 0.0}, Formulation::energy, "quarter"},
                                   {45.0, {0.5, 0.5}, Formulation::energy, "quarter"},
                                   {45.0, {0.0, 0.0}, Formulation::incremental, "half"},
                                   {0.0, {0.0, 0.0}, Formulation::side_frame, "quarter"},
                                   {0.0, {0.5, 0.0}, Formulation::contravariant, "half"},
                                   {0.0, {0.0, 0.0}, Formulation::energy, "quarter", true},
                                   {0.0, {0.5, 0.5}, Formulation::energy, "quarter", true},
                                   {45.0, {0.0, 0.0}, Formulation::energy, "quarter", true},
                                   {45.0, {0.5, 0.5}, Formulation::energy, "half", true},
                                   {0.0, {0.0, 0.5}, Formulation::energy, "quarter", false, "seatbelt"}};
  for (const auto& c : cases) {
    Scene scene = test::FabricPatch::make_scene("twintex-pw", c.yarn_angle, {60.0, 80.0}, c.formulation,
                                                Thickness::constant_volume, Section::incompressible);
    scene.blank.phase = c.phase;
    scene.model.symmetry = test::chosen(c.symmetry);
    scene.model.yarn = test::chosen(c.yarn);
    if (scene.model.yarn == YarnElement::seatbelt) scene.model.partner = SeatbeltPartner::compression;
    if (c.bending) {
      // stiff enough that bending makes a good part of the force
      scene.model.yarn = YarnElement::beam;
      scene.model.yarn_bending = {{3e3, 2e3}};
      scene.model.cell = CellElement::rotation_free;
      scene.model.cell_bending = {{300.0, c.yarn_angle == 45.0 ? 300.0 : 400.0, 200.0}};
    }
    const Card card = load_card(scene.fabric.material);
    const Mesh whole = build_mesh(scene, card);
    const SymmetricPart part = cut_part(whole, find_symmetry(scene, card, whole, make_tools(scene, whole)), c.bending);
    const std::string name = std::to_string(c.yarn_angle) + " deg, phase " + std::to_string(c.phase[0]);
    const Moved all(whole, nullptr, scene, card), some(whole, &part, scene, card);

    double greatest = 0.0;
    for (int n = 0; n < whole.node_count(); ++n) greatest = std::max(greatest, all.force(n).norm());
    std::vector<char> is_image(part.mesh.node_count(), 0);
    for (const auto& image : part.mesh.symmetry.image) is_image[image.node] = 1;
    for (int n = 0; n < part.mesh.node_count(); ++n) {
      if (is_image[n] != 0) {
        EXPECT_EQ(some.force(n).norm(), 0.0);
        EXPECT_EQ(some.mass(n), 0.0);
        continue;
      }
      const int w = part.mesh.symmetry.whole_node[n];
      if (all.mass(w) == 0.0) continue;  // tied
      const double share = some.mass(n) / all.mass(w);
      // 1, 1/2 in a plane, 1/4 in both
      EXPECT_NEAR(4.0 * share, std::round(4.0 * share), 1e-12) << name << ", node " << w;
      // rounding of sums in another order
      EXPECT_LT((some.force(n) - share * all.force(w)).norm(), 1e-11 * greatest) << name << ", node " << w;
    }

    if (c.bending) {
      const double energy = all.ply->stored_energy().bending;
      EXPECT_GT(energy, 0.0);
      EXPECT_NEAR(part.mesh.symmetry.parts() * some.ply->stored_energy().bending, energy, 1e-12 * energy) << name;
    }
    const double of_whole = all.ply->renew_stable_step().step;
    EXPECT_NEAR(some.ply->renew_stable_step().step, of_whole, 1e-10 * of_whole) << name;
  }
}

}  // namespace
}  // namespace weaveform
