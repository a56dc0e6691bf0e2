// How far a blank has left its plane, and zigzags from cell to cell, on fabric whose shape is known.
#include "post/measure/folds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/post/forming/forming_shapes.hpp"

namespace weaveform {
namespace {

constexpr double spacing = 5.0;  // mm

// z = amplitude * shape(x / spacing + phase), with `cells` to a wave.
Folds waved(double amplitude, double cells, double phase) {
  const Mesh mesh = test::centred_lattice(25, spacing);
  const auto position = test::moved(mesh, [&](const Vec3& x) {
    return Vec3{x[0], x[1], amplitude * std::cos(2.0 * std::numbers::pi * (x[0] / spacing + phase) / cells)};
  });
  return find_folds(Scene{}, mesh, position).value();
}

TEST(Folds, AFlatFabricHasNone) {
  const Mesh mesh = test::centred_lattice(9, spacing);
  const Folds folds = find_folds(Scene{}, mesh, mesh.nodes.position).value();
  EXPECT_EQ(folds.out_of_plane, 0.0);
  EXPECT_EQ(folds.zigzag_height, 0.0);
  EXPECT_EQ(folds.zigzag_share, 0.0);
}

TEST(Folds, AZigzagHasTheHeightOfItsCrestsOverItsTroughs) {
  for (const double amplitude : {1e-3, 0.05, 0.3}) {
    const Folds folds = waved(amplitude, 2.0, 0.0);
    EXPECT_NEAR(folds.out_of_plane, amplitude, 1e-12);
    const double slope = 2.0 * amplitude / spacing;
    EXPECT_NEAR(folds.zigzag_height, 2.0 * amplitude, 2.0 * amplitude * slope * slope) << "turns are of that order off";
  }
}

TEST(Folds, WavesThatCellsResolveAreNoZigzags) {
  for (const double cells : {8.0, 12.0, 24.0})
    for (const double phase : {0.0, 0.2, 0.5, 0.7}) {
      const Folds folds = waved(1.0, cells, phase);
      EXPECT_LT(folds.zigzag_height, 0.06 * 2.0) << cells << ' ' << phase;
      EXPECT_EQ(folds.zigzag_share, 0.0);
    }
}

TEST(Folds, ScenesWithToolsHaveAMeasureOfTheirOwn) {
  const Mesh mesh = test::centred_lattice(9, spacing);
  Scene scene;
  scene.tools.emplace_back();
  EXPECT_FALSE(find_folds(scene, mesh, mesh.nodes.position).has_value());
}

}  // namespace
}  // namespace weaveform
