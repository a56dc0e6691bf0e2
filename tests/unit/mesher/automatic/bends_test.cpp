// Radii of tools: of formulas as they are given, of triangles as they were before they were cut into facets.
#include "mesher/automatic/bends.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

namespace weaveform {
namespace {

constexpr double offset = 0.25;  // mm; of all tools here
using std::numbers::pi;

Tool tool_of(const TriangleList& list) {
  Tool tool;
  tool.name = "cad";
  tool.shape = ToolShape::triangles;
  tool.offset = offset;
  tool.surface = std::make_shared<TriangleSurface>(list, "test");
  return tool;
}

// A surface over a grid of n x m parameters, quads cut along one diagonal, its outside where u x v points.
TriangleList grid(int n, int m, const std::function<Vec3(double, double)>& at) {
  TriangleList list;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i) list.point.push_back(at(static_cast<double>(i) / n, static_cast<double>(j) / m));
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      list.triangle.push_back({a, b, c});
      list.triangle.push_back({a, c, d});
    }
  return list;
}

// A plate, a quarter round of radius r, and a wall, all `length` long. `shift` moves every other row along the edge, so
// that triangles are oblique.
TriangleList rounded_edge(double r, double length, int facets, double shift) {
  const auto profile = [=](double u) -> Vec2 {  // y, z; material below and left
    const double s = u * (facets + 2);
    if (s <= 1.0) return {-r - 20.0 * (1.0 - s), 0.0};
    if (s >= facets + 1.0) return {0.0, -r - 20.0 * (s - facets - 1.0)};
    const double angle = 0.5 * pi * (s - 1.0) / facets;
    return {-r + r * std::sin(angle), -r + r * std::cos(angle)};
  };
  const int rows = facets + 2, along = static_cast<int>(length / 4.0);
  return grid(rows, along, [=](double u, double v) -> Vec3 {
    const Vec2 p = profile(u);
    const int row = static_cast<int>(std::lround(u * rows));
    const double x = length * v + (row % 2 == 1 && v > 0.0 && v < 1.0 ? shift : 0.0);
    return {-x, p[0], p[1]};
  });
}

TriangleList ball_half(double radius, int n) {
  return grid(4 * n, n, [=](double u, double v) -> Vec3 {
    const double t = 2.0 * pi * u, p = 0.5 * pi * (0.02 + 0.98 * v);
    return {radius * std::sin(p) * std::cos(t), -radius * std::sin(p) * std::sin(t), radius * std::cos(p)};
  });
}

ToolBends bends_of(const Tool& tool, double reach = 1e6) {
  return tool_bends(Scene{}, {tool}, reach);
}

// Of the edge's turning all is about the direction it runs in, whichever family that is.
TEST(ToolBends, OfAnEdgeAlongTheYarnsSayThatItIs) {
  const Tool tool = tool_of(rounded_edge(6.0, 80.0, 8, 0.0));  // along x
  for (const double yarns : {0.0, 3.0, 30.0, 45.0, 87.0, 90.0}) {
    Scene scene;
    scene.blank.yarn_angle = yarns - 20.0;
    scene.blank.orientation = 20.0;
    const double along = tool_bends(scene, {tool}, 1e6).edge.along_yarns;
    if (yarns == 30.0 || yarns == 45.0)
      EXPECT_EQ(along, 0.0) << yarns;
    else
      EXPECT_NEAR(along, 1.0, 1e-12) << yarns;
  }
  Scene scene;
  scene.blank.yarn_angle = 0.0;
  EXPECT_LT(tool_bends(scene, {tool_of(ball_half(20.0, 12))}, 1e6).edge.along_yarns, 0.3) << "round tools average";
}

// Facets of 5 to 22 degrees: within 6 %, for the two chords beside the flat are half turned. Slivers hide where they turn:
// the radius may come out smaller by a third (facets.cpp), never larger.
TEST(ToolBends, OfARoundedEdgeOfTrianglesAreItsRadius) {
  for (const double radius : {3.0, 12.0})
    for (const int facets : {4, 8, 18})
      for (const double shift : {0.0, 1.0}) {
        const ToolBends bends = bends_of(tool_of(rounded_edge(radius, 80.0, facets, shift)));
        EXPECT_LT(bends.edge.radius, 1.06 * radius + offset) << facets << " facets, shift " << shift;
        EXPECT_GT(bends.edge.radius, (shift == 0.0 ? 0.94 : 0.62) * radius + offset)
            << facets << " facets, shift " << shift;
        EXPECT_TRUE(std::isinf(bends.form.radius)) << "a single curvature forms nothing: " << bends.form.radius;
      }
}

TEST(ToolBends, OfADomeOfTrianglesAreItsRadiusAndWidth) {
  for (const int n : {12, 30}) {
    const ToolBends bends = bends_of(tool_of(ball_half(50.0, n)));
    EXPECT_NEAR(bends.edge.radius, 50.0 + offset, 2.5) << n;                         // facets of 3 to 8 degrees
    EXPECT_NEAR(bends.form.radius, std::sqrt(2.0 / 3.0) * 50.0 + offset, 2.0) << n;  // bends.hpp: 0.82 R
  }
}

TEST(ToolBends, OfTrianglesDoNotHangOnTheirSize) {
  const double coarse = bends_of(tool_of(rounded_edge(8.0, 80.0, 6, 0.0))).edge.radius;
  const double fine = bends_of(tool_of(rounded_edge(8.0, 80.0, 24, 0.0))).edge.radius;
  EXPECT_NEAR(coarse, fine, 0.06 * fine);
}

TEST(ToolBends, AnEdgeWithoutRadiusDoesNotCount) {
  EXPECT_TRUE(std::isinf(bends_of(tool_of(rounded_edge(3.0, 80.0, 1, 0.0))).edge.radius));  // two bends of 45 degrees
  Tool ring;
  ring.name = "binder";
  ring.shape = ToolShape::ring;
  ring.radius = 40.0;
  EXPECT_TRUE(std::isinf(bends_of(ring).edge.radius));
}

TEST(ToolBends, WhatLiesOffTheBlankDoesNotCount) {
  const Tool tool = tool_of(rounded_edge(3.0, 80.0, 8, 0.0));
  EXPECT_FALSE(std::isinf(bends_of(tool, 100.0).edge.radius));
  Tool away = tool;
  away.start.origin = {500.0, 0.0, 0.0};
  EXPECT_TRUE(std::isinf(bends_of(away, 100.0).edge.radius));
}

TEST(ToolBends, OfFormulasAreTheirOwn) {
  Tool sphere;
  sphere.name = "punch";
  sphere.shape = ToolShape::sphere;
  sphere.radius = 75.0;
  sphere.offset = offset;
  Tool ring;
  ring.name = "die";
  ring.shape = ToolShape::ring;
  ring.radius = 77.0;
  ring.fillet_radius = 15.0;
  ring.offset = offset;
  const ToolBends bends = tool_bends(Scene{}, {sphere, ring}, 1e6);
  EXPECT_EQ(bends.edge.radius, 15.25);
  EXPECT_EQ(bends.edge.tool, "die");
  EXPECT_EQ(bends.form.radius, 75.25);
  EXPECT_EQ(bends.form.tool, "punch");
}

// A cup's rounded rim is as wide as the cup; the rounded opening that it is drawn through forms nothing.
TEST(ToolBends, OfACupAreItsRimAndItsWidth) {
  Tool cup;
  cup.name = "cup";
  cup.shape = ToolShape::revolved;
  cup.profile = make_profile({{0, 0}, {40, 0, 10}, {40, 60}}, "test");
  const ToolBends bends = bends_of(cup);
  EXPECT_NEAR(bends.edge.radius, 10.0, 1e-9);
  EXPECT_NEAR(bends.form.radius, 40.0, 1e-9);
  Tool opening = cup;
  opening.profile = make_profile({{200, 0}, {44, 0, 8}, {44, -60}}, "test");
  EXPECT_NEAR(bends_of(opening).edge.radius, 8.0, 1e-9);
  EXPECT_TRUE(std::isinf(bends_of(opening).form.radius));
}

// The dome of examples/drape_hemisphere.toml: its hollow fillet counts for the net that is laid into it, and only there.
TEST(ToolBends, HollowsCountForANet) {
  Tool dome;
  dome.name = "dome";
  dome.shape = ToolShape::revolved;
  dome.offset = offset;
  dome.profile = make_profile({{300, 0}, {88.741196, 0}, {73.950997, 12.5, 88.741196, 15}, {0, 75, 0, 0}}, "test");
  const ToolBends pressed = bends_of(dome);
  EXPECT_NEAR(pressed.edge.radius, 75.25, 1e-3);
  EXPECT_NEAR(pressed.form.radius, 75.25, 1e-3);
  EXPECT_TRUE(std::isinf(pressed.drape.radius));
  Scene scene;
  scene.drape.emplace().tool = "dome";
  EXPECT_NEAR(tool_bends(scene, {dome}, 1e6).drape.radius, 14.75, 1e-3);
}

}  // namespace
}  // namespace weaveform
