// The wrinkle measure on fabric whose shape is known.
#include "post/forming/wrinkles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/unit/post/forming/forming_shapes.hpp"

namespace weaveform {
namespace {

using std::numbers::pi;

// A fabric on a plate with wrinkles across the warp, z = a (1 + sin(2 pi x/l + phase)).
struct Wrinkled {
  Mesh mesh;
  Wrinkles found;
  Wrinkled(double amplitude, double wave_length, double spacing, double phase = 0.3)
      : mesh(test::centred_lattice(static_cast<int>(std::lround(120.0 / spacing)) + 1, spacing)),
        found(find_wrinkles(
            mesh,
            test::moved(mesh,
                        [=](const Vec3& x) {
                          return Vec3{x[0], x[1], amplitude * (1.0 + std::sin(2.0 * pi * x[0] / wave_length + phase))};
                        }),
            {test::plane_tool(0.0)})) {}
};

TEST(WrinkleMeasure, FabricLyingOnASphereHasNone) {
  const double radius = 75.0;
  for (const double spacing : {5.0, 20.0}) {
    const Mesh mesh = test::centred_lattice(static_cast<int>(160.0 / spacing) + 1, spacing);
    const auto position = test::moved(mesh, [&](const Vec3& x) { return test::on_bowl(x, radius); });
    const Wrinkles found = find_wrinkles(mesh, position, {test::sphere_tool(radius)});
    EXPECT_EQ(found.area_share, 0.0);
    EXPECT_LT(found.greatest_curvature, 1e-12) << "rounding of positions over the spacing squared";
    EXPECT_LT(*std::max_element(found.relief.begin(), found.relief.end()), 1e-11);
  }
}

TEST(WrinkleMeasure, FlatFabricBetweenOpenPlatesHasNone) {
  const Mesh mesh = test::centred_lattice(9, 10.0);
  PlacedTool above = test::plane_tool(3.0);
  above.place.axis = {0.0, 0.0, -1.0};
  const Wrinkles found = find_wrinkles(mesh, mesh.nodes.position, {test::plane_tool(0.0), above});
  EXPECT_EQ(found.area_share, 0.0);
  EXPECT_EQ(found.greatest_curvature, 0.0);
}

// A taut strip that leaves a sphere along its tangent: straighter than the tool, though it stands off by far.
TEST(WrinkleMeasure, FreeSpanFromASphereIsNoWrinkle) {
  const double radius = 75.0, leaves = 40.0;  // mm; of arc
  const Mesh mesh = test::centred_lattice(33, 5.0);
  const auto position = test::moved(mesh, [&](const Vec3& x) {
    const double arc = std::clamp(x[0], -leaves, leaves), angle = arc / radius, beyond = x[0] - arc;
    return Vec3{radius * std::sin(angle) + beyond * std::cos(angle), x[1],
                -radius * std::cos(angle) + beyond * std::sin(angle)};
  });
  PlacedTool roll = test::sphere_tool(radius);
  roll.tool.shape = ToolShape::cylinder;
  roll.place.axis = {0.0, 1.0, 0.0};
  const Wrinkles found = find_wrinkles(mesh, position, {roll});
  EXPECT_EQ(found.area_share, 0.0);
  EXPECT_LT(found.greatest_curvature, 1e-12);
}

TEST(WrinkleMeasure, SinusoidGivesHeightAndCurvatureBackToSecondOrder) {
  // A slender wrinkle, so that the exact curvature at its crest is a (2 pi/l)^2.
  const double a = 0.6, l = 30.0;
  const double height = 2.0 * a, curvature = a * std::pow(2.0 * pi / l, 2);
  double height_error[2], curvature_error[2];
  for (int k = 0; k < 2; ++k) {
    // With this phase crests fall between nodes by the same part of the spacing on both nets.
    const double spacing = k == 0 ? 2.0 : 1.0;
    const Wrinkled fabric(a, l, spacing, 0.5 * pi + 2.0 * pi * 0.25 * spacing / l);
    height_error[k] = height - *std::max_element(fabric.found.relief.begin(), fabric.found.relief.end());
    curvature_error[k] = curvature - fabric.found.greatest_curvature;
  }
  EXPECT_LT(std::abs(height_error[1]), 0.01 * height);
  EXPECT_LT(std::abs(curvature_error[1]), 0.01 * curvature);
  EXPECT_NEAR(height_error[0] / height_error[1], 4.0, 0.6);
  EXPECT_NEAR(curvature_error[0] / curvature_error[1], 4.0, 0.6);
}

TEST(WrinkleMeasure, SinusoidBetweenPlatesIsFoundThoughItsCrestsTouch) {
  const double a = 2.0, l = 24.0;
  const Mesh mesh = test::centred_lattice(61, 2.0);
  const auto position = test::moved(mesh, [=](const Vec3& x) {
    return Vec3{x[0], x[1], a * (1.0 + std::cos(2.0 * pi * x[0] / l))};
  });
  PlacedTool above = test::plane_tool(2.0 * a);
  above.place.axis = {0.0, 0.0, -1.0};
  const Wrinkles found = find_wrinkles(mesh, position, {test::plane_tool(0.0), above});
  EXPECT_GT(found.area_share, 0.5);
  EXPECT_NEAR(found.greatest_relief, 2.0 * a, 1e-9) << "crest and valley are nodes";
}

// Half the thickness in amplitude at 60 thicknesses of wave length are the limits; the thickness is 0.5 mm.
TEST(WrinkleMeasure, LimitsTellLowAndLongUndulationsFromWrinkles) {
  EXPECT_EQ(Wrinkled(0.24, 15.0, 1.0).found.area_share, 0.0) << "too low";
  EXPECT_EQ(Wrinkled(1.0, 120.0, 1.0).found.area_share, 0.0) << "too long";
  EXPECT_GT(Wrinkled(0.5, 15.0, 1.0).found.area_share, 0.3);
}

// Crests and valleys are wrinkled where |sin| passes y/(a k^2): the share of the area has a closed form.
TEST(WrinkleMeasure, AreaShareIsThatOfCrestsAndValleys) {
  const double a = 1.0, l = 24.0;
  const Wrinkled fabric(a, l, 0.5);
  const double least = WrinkleLimits{}.curvature(0.5) / (a * std::pow(2.0 * pi / l, 2));
  const double share = 1.0 - 2.0 / pi * std::asin(least);
  // a node's strip is 0.5 of 12 mm between zeros of the curvature, and slopes lower it by (1 + slope^2)^(3/2)
  EXPECT_NEAR(fabric.found.area_share, share, 0.05);
}

}  // namespace
}  // namespace weaveform
