// The length of wrinkles against closed forms, from the fabric's own dynamics to the measure that `post` takes: a strip
// on an elastic foundation (Hetenyi 1946), and a stretched sheet, whose tension is one (Cerda & Mahadevan 2003).
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "post/forming/waves.hpp"
#include "solver/element/yarn_law.hpp"
#include "tests/support/small_world.hpp"

namespace weaveform {
namespace {

using std::numbers::pi;

constexpr double compression = 198.0;  // MPa; of the yarns, a hundredth of their tensile modulus
constexpr double noise = 1e-3;         // mm; out of the plane, at the start
// Waves a tenth as high as a wrinkle are looked for, so that they may be small.
constexpr WrinkleLimits low = {.height = 0.05};

// A force -K z on the area of every node. And what keeps the pressed yarns straight in the fabric's plane, where the cells'
// shear stiffness alone would let them turn aside at 0.07 N/mm: stiff springs across them, along `across`.
class Foundation : public Actor {
public:
  Foundation(const Mesh& mesh, const PackedMesh& packed, double per_area, std::size_t across)  // N/mm^3
      : packed_(packed), across_(across), start_(mesh.nodes.position) {
    for (const double area : node_areas(mesh)) {
      stiffness_.push_back(per_area * area);
      straightening_.push_back(1.0 * area);
    }
  }
  [[nodiscard]] std::string name() const override { return "foundation"; }
  void add_forces(State& state, double /*step*/) override {
    for (std::size_t n = 0; n < stiffness_.size(); ++n) {
      const int at = packed_.packed_of_mesh[n];
      state.force[2][at] -= stiffness_[n] * state.position[2][at];
      state.force[across_][at] -= straightening_[n] * (state.position[across_][at] - start_[n][across_]);
    }
  }
  void add_stiffness_bound(const std::vector<Vec3>& /*position*/, double /*fabric_frequency*/,
                           std::vector<double>& bound) const override {
    for (std::size_t n = 0; n < stiffness_.size(); ++n) bound[n] += stiffness_[n] + straightening_[n];
  }

private:
  const PackedMesh& packed_;
  std::size_t across_;
  std::vector<Vec3> start_;                        // mm
  std::vector<double> stiffness_, straightening_;  // N/mm; per mesh node
};

GripSpec grip(const std::string& name, std::optional<BlankEdge> edge, double travel, std::vector<Component> free = {}) {
  GripSpec spec;
  spec.name = name;
  spec.edge = edge;
  spec.travel = travel;
  spec.free = std::move(free);
  return spec;
}

Scene bending_scene(std::array<double, 2> size, double coarsening, double rigidity) {
  Scene scene;
  scene.blank.size = size;
  scene.blank.yarn_angle = 0.0;
  scene.blank.coarsening = {coarsening, coarsening};
  scene.model.cell = CellElement::rotation_free;
  scene.model.cell_bending = {{rigidity, rigidity, 0.01 * rigidity}};
  scene.model.compression_modulus = compression;
  scene.analysis.duration = 0.5;  // s; waves grow by e in 1 to 3 ms, sound crosses the strip in 2
  scene.analysis.damping = 100.0;
  return scene;
}

// Nodes off the plane by chance, and the blank stretched along x.
void disturb(Mesh& mesh, double stretch) {
  std::mt19937_64 generator(7);
  mesh.nodes.flat_position = mesh.nodes.position;
  for (Vec3& x : mesh.nodes.position) {
    x[0] *= 1.0 + stretch;
    x[2] += noise * (2.0 * static_cast<double>(generator() >> 11) * 0x1.0p-53 - 1.0);
  }
}

// N/mm; that yarns across a width bear at this engineering strain, negative in compression.
double membrane_force(const Scene& scene, double stretch) {
  const Card card = load_card(scene.fabric.material);
  const double strain = std::log1p(stretch);
  return yarn_laws(card, scene.model)[0].stress(strain) * card.yarn[0].section / (1.0 + stretch) /
         card.yarn[0].interval;
}

struct Wave {
  double length = 0.0, cells = 0.0;  // mm, 1
  int half_waves = 0;
};

Wave wave_along(const test::SmallWorld& world, World& running, std::size_t family) {
  const Mesh& mesh = world.mesh(0);
  const WaveMeasure found =
      find_waves(mesh, out_of_plane_curvatures(mesh, running.ply(0).positions()), low).yarn[family];
  return {found.wavelength, found.cells, found.half_waves};
}

// l (pi/n)/asin(pi/n), n = l/h (waves.hpp): of chords of length h instead of a sheet; two of them where there is none.
double of_chords(double wavelength, double h) {
  const double share = pi * h / wavelength;
  return share < 1.0 ? wavelength * share / std::asin(share) : 2.0 * h;
}

// mm; 500 mm of fabric, four cells wide, pressed between clamps by a fifth more than buckles it.
Wave strip_on_foundation(double coarsening, double rigidity, double foundation, double* h = nullptr) {
  const double cell = 4.92 * coarsening;
  Scene scene = bending_scene({500.0, 4.0 * cell}, coarsening, rigidity);
  const double critical = 2.0 * std::sqrt(rigidity * foundation) / std::abs(membrane_force(scene, -1e-6) / 1e-6);
  scene.grip = {grip("left", BlankEdge::left, 0.0), grip("right", BlankEdge::right, -500.0 * 1.2 * critical)};
  test::SmallWorld world({scene}, std::numeric_limits<double>::infinity(), 1, nullptr,
                         [](std::size_t, Mesh& mesh) { disturb(mesh, 0.0); });
  world->ply(0).add(std::make_unique<Foundation>(world.mesh(0), world->ply(0).packed(), foundation, 1));
  world.run(std::numeric_limits<int>::max());
  if (h != nullptr) *h = world.mesh(0).spacing[0];
  return wave_along(world, *world, 0);
}

double on_foundation(double rigidity, double foundation) {
  return 2.0 * pi * std::pow(rigidity / foundation, 0.25);
}

constexpr double soft_ground = 1.217e-3;  // N/mm^3; waves of 40 mm at a rigidity of 2 N mm

// 6 to 13 waves on the strip, by 8 to 16 cells each: chords make up to 2.5 % of it.
TEST(WrinkleWavelength, OnAFoundationItGoesWithTheFourthRootOfTheRigidity) {
  std::vector<double> log_length, log_rigidity;
  for (const double rigidity : {2.0, 8.0, 32.0}) {
    const Wave found = strip_on_foundation(1.0, rigidity, soft_ground);
    const double exact = on_foundation(rigidity, soft_ground);
    EXPECT_NEAR(found.length / exact, 1.0, 0.03) << rigidity;
    EXPECT_GT(found.half_waves, 40) << "on three yarns";
    log_length.push_back(std::log(found.length));
    log_rigidity.push_back(std::log(rigidity));
  }
  // 2 % of length and the chords at either end of a factor of 16 in rigidity
  EXPECT_NEAR((log_length[2] - log_length[0]) / (log_rigidity[2] - log_rigidity[0]), 0.25, 0.02);
}

// The same waves of 40 mm by 16, 8, 4 and 2.7 cells.
TEST(WrinkleWavelength, ChordsShortenItAsTheirClosedFormSays) {
  for (const double coarsening : {0.5, 1.0, 2.0, 3.0}) {
    double h = 0.0;
    const Wave found = strip_on_foundation(coarsening, 2.0, soft_ground, &h);
    EXPECT_NEAR(found.length / of_chords(on_foundation(2.0, soft_ground), h), 1.0, 0.04) << coarsening;
    const bool is_coarse = coarsening > 0.75;
    EXPECT_EQ(found.cells < least_cells_per_wave, is_coarse) << found.cells;
  }
}

struct Stretched {
  Wave wave;
  double tension = 0.0;  // N/mm
};

// What the pressed edges do out of the plane: nothing (they may bulge), or lie on the plane and turn.
enum class Edges { loose, held };

constexpr double sheet_length = 100.0, sheet_width = 420.0;  // mm

// Between ends that stretch it by a hundredth, and pressed across by a tenth more than buckles it
// where its edges are held.
Stretched stretched_sheet(double rigidity, Edges edges) {
  constexpr double length = sheet_length, width = sheet_width, stretch = 0.01;
  Scene scene = bending_scene({length, width}, 1.0, rigidity);
  scene.model.yarn_law = YarnLaw::linear;
  scene.model.yarn_stiffness_scale = 0.01;
  scene.model.compression_modulus = compression / 0.01;
  const double tension = membrane_force(scene, stretch), ground = tension * std::pow(pi / length, 2);
  const double critical = 2.0 * std::sqrt(rigidity * ground) / std::abs(membrane_force(scene, -1e-6) / 1e-6);
  scene.grip = {grip("left", BlankEdge::left, 0.0, {Component::y}),
                grip("right", BlankEdge::right, 0.0, {Component::y})};
  for (const double side : {-1.0, 1.0}) {
    GripSpec press = grip(side < 0.0 ? "near" : "far", {}, -0.55 * critical * width, {Component::x});
    if (edges == Edges::loose) press.free.push_back(Component::z);
    press.box = {{-0.5 * length + 2.0, side * 0.5 * width - 1.0, 0.5 * length - 2.0, side * 0.5 * width + 1.0}};
    press.direction = {{0.0, side, 0.0}};
    scene.grip.push_back(press);
  }
  test::SmallWorld world({scene}, std::numeric_limits<double>::infinity(), 1, nullptr,
                         [](std::size_t, Mesh& mesh) { disturb(mesh, stretch); });
  world->ply(0).add(std::make_unique<Foundation>(world.mesh(0), world->ply(0).packed(), 0.0, 0));
  world.run(std::numeric_limits<int>::max());
  return {wave_along(world, *world, 1), tension};
}

// Half a sine along the pull makes of the tension a foundation, K = T (pi/L)^2, and of each yarn across a bar on it under an
// axial load P, D w,yyyy + P w,yy + K w = 0. Where its ends are held, waves of 2 pi (D/K)^(1/4) buckle it at P = 2 (D K)^(1/2):
// Cerda & Mahadevan's. Where they are loose, D w,yy = 0 and D w,yyy + P w,y = 0 there, it is half of that load that buckles
// it (Hetenyi 1946), and only at the ends: with w = exp(s y), s^2 = (K/D)^(1/2) exp(2 pi i/3), so that
//   s = (K/D)^(1/4) (-1/2 + i 3^(1/2)/2) ,  waves 2/3^(1/2) = 1.155 times as long, half a wave a sixth as high as the one before.
// Held edges take a whole number m of half waves, that with the least P = D k^2 + K/k^2 , k = m pi/W.
double wave_of_sheet(Edges edges, double rigidity, double tension) {
  const double free = 2.0 * std::sqrt(pi) * std::pow(rigidity / tension, 0.25) * std::sqrt(sheet_length);
  if (edges == Edges::loose) return 2.0 / std::sqrt(3.0) * free;
  const auto load = [&](double half_waves) {
    const double k = half_waves * pi / sheet_width;
    return rigidity * k * k + tension * std::pow(pi / sheet_length / k, 2);
  };
  double best = 1.0;
  while (load(best + 1.0) < load(best)) ++best;
  return 2.0 * sheet_width / best;
}

class StretchedSheet : public testing::TestWithParam<Edges> {};

// 5 to 12 waves by 7 to 17 cells each. Held edges were within 0.2 % at every rigidity; of loose ones, whose waves fade within
// a length, the two or three that are high enough to count were within 1 %: twice that.
TEST_P(StretchedSheet, WavelengthsAreThoseOfABarOnTheTensionsFoundation) {
  std::vector<double> log_length, log_rigidity;
  for (const double rigidity : {0.5, 2.0, 8.0}) {
    const Stretched found = stretched_sheet(rigidity, GetParam());
    const double ratio = found.wave.length / wave_of_sheet(GetParam(), rigidity, found.tension);
    RecordProperty("ratio_" + std::to_string(rigidity), std::to_string(ratio));
    EXPECT_NEAR(ratio, 1.0, GetParam() == Edges::held ? 0.01 : 0.02) << rigidity;
    log_length.push_back(std::log(found.wave.length));
    log_rigidity.push_back(std::log(rigidity));
  }
  EXPECT_NEAR((log_length[2] - log_length[0]) / (log_rigidity[2] - log_rigidity[0]), 0.25, 0.01);
}

INSTANTIATE_TEST_SUITE_P(PressedEdges, StretchedSheet, testing::Values(Edges::held, Edges::loose),
                         [](const auto& instance) { return instance.param == Edges::held ? "held" : "loose"; });

}  // namespace
}  // namespace weaveform
