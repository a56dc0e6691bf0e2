// Tool shapes: signed distance, normal and nearest point against independent answers, and across every border.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "core/error.hpp"
#include "core/vector/vector.hpp"
#include "mesher/tools/tool.hpp"

namespace weaveform {
namespace {

struct Answer {
  double distance;
  Vec3 normal;
};

Answer ask(const Tool& tool, const Vec3& p) {
  Distances out;
  int hint = 0;
  tool_distances(tool, tool.start, {&p[0], &p[1], &p[2]}, 1, &hint, out);
  return {out.distance[0], {out.normal[0][0], out.normal[1][0], out.normal[2][0]}};
}

Tool shape(ToolShape kind, const std::function<void(ToolSpec&)>& set = {}) {
  Scene scene;
  ToolSpec spec;
  spec.name = "tool";
  spec.shape = kind;
  spec.position = {{0.0, 0.0, 0.0}};
  if (set) set(spec);
  scene.tools = {spec};
  return make_tools(scene, 0.5).front();
}

Tool ring(double opening, double fillet) {
  return shape(ToolShape::ring, [&](ToolSpec& s) {
    s.opening_radius = opening;
    s.fillet_radius = fillet;
  });
}
Tool sphere(double radius) {
  return shape(ToolShape::sphere, [&](ToolSpec& s) { s.radius = radius; });
}
Tool revolved(const std::vector<std::vector<double>>& corners) {
  return shape(ToolShape::revolved, [&](ToolSpec& s) { s.profile = corners; });
}

// Every shape once, with corners, arcs, hollow arcs and endless lines among the profiles.
std::vector<Tool> zoo() {
  return {shape(ToolShape::plane),
          sphere(7.5),
          shape(ToolShape::cylinder, [](ToolSpec& s) { s.radius = 4.0; }),
          ring(8.0, 2.0),
          ring(8.0, 0.0),
          revolved({{0, 0}, {6, 0, 2}, {6, 9}}),
          revolved({{0, -3}, {5, 2, 0, 2}, {5, 9}}),
          revolved({{12, 30}, {12, 3}, {9, 0, 9, 3}, {7, 0}, {7, -9}}),
          revolved({{20, 0}, {8, 0}, {8, -5}})};
}

// Random points dense about the shapes.
std::vector<Vec3> cloud(int count) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> place(-14.0, 14.0);
  std::vector<Vec3> points(count);
  for (auto& p : points) p = {place(generator), place(generator), place(generator)};
  return points;
}

// Rounding of coordinates of 10 mm is 1e-15; a distance from cancelled squares keeps half the digits at worst near 0.
constexpr double distance_rounding = 1e-11;  // mm

TEST(ToolShape, NormalIsUnitAndNearestPointLiesOnTheSurface) {
  for (const Tool& tool : zoo())
    for (const auto& p : cloud(3000)) {
      const Answer a = ask(tool, p);
      ASSERT_NEAR(length(a.normal), 1.0, 1e-12);
      Vec3 nearest = p;
      for (int c = 0; c < 3; ++c) nearest[c] -= a.distance * a.normal[c];
      ASSERT_NEAR(ask(tool, nearest).distance, 0.0, distance_rounding);
    }
}

// The gradient of a distance is its normal, wherever the nearest point is unique: on the axis and on medial surfaces,
// which random points miss, it is not.
TEST(ToolShape, NormalIsTheGradientOfTheDistance) {
  const double h = 1e-5;
  int tested = 0;
  for (const Tool& tool : zoo())
    for (const auto& p : cloud(300)) {
      const Answer a = ask(tool, p);
      Vec3 gradient;
      bool smooth = true;
      for (int c = 0; c < 3; ++c) {
        Vec3 up = p, down = p;
        up[c] += h;
        down[c] -= h;
        const double forward = (ask(tool, up).distance - a.distance) / h;
        const double backward = (a.distance - ask(tool, down).distance) / h;
        smooth = smooth && std::abs(forward - backward) < 1e-3;  // curvature 1/mm times h stays far below
        gradient[c] = 0.5 * (forward + backward);
      }
      if (!smooth) continue;
      ++tested;
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(gradient[c], a.normal[c], 1e-5);
    }
  EXPECT_GT(tested, 2500);  // of 2700: kinks are rare
}

// No jump across any border of the piecewise formulas: fillet to plate, shank to ball, corner to face.
TEST(ToolShape, DistanceIsContinuousAcrossEveryBorder) {
  const std::vector<Vec3> border = {{8.0, 0, 0.3}, {10.0, 0, 0.3},   {10.0, 0, -0.3}, {7.5, 0, -2.0}, {8.5, 0, -2.0},
                                    {7.6, 0, 0.0}, {7.4, 0, 0.0},    {4.0, 0, -0.1},  {6.1, 0, 2.0},  {4.0, 0, 0.1},
                                    {6.0, 0, 0.0}, {5.1, 0, 2.0},    {9.0, 0, 0.1},   {9.0, 0, -0.1}, {7.0, 0, 0.1},
                                    {7.0, 0, 0.0}, {12.0, 0, 3.1},   {8.0, 0, 0.0},   {0.0, 0, -7.6}, {0.0, 0, -0.1},
                                    {0.0, 0, 0.1}, {1e-13, 0, -3.1}, {20.0, 0, 0.1}};
  for (const Tool& tool : zoo())
    for (const auto& p : border)
      for (const double dx : {-1e-12, 0.0, 1e-12})
        for (const double dz : {-1e-12, 0.0, 1e-12}) {
          const Vec3 q = {p[0] + dx, p[1], p[2] + dz};
          EXPECT_NEAR(ask(tool, q).distance, ask(tool, p).distance, 1e-11);
          const double size = length(ask(tool, q).normal);
          // a point on the axis of a cylinder or ring has no direction to its wall; it is deep inside or far outside
          if (q[0] > 0.0) {
            EXPECT_NEAR(size, 1.0, 1e-12);
          }
        }
}

TEST(ToolShape, RingAndSphereAreRevolvedProfiles) {
  const Tool die = ring(8.0, 2.0), die_profile = revolved({{30, 0}, {8, 0, 2}, {8, -30}});
  const Tool ball = sphere(7.5), ball_profile = revolved({{0, -7.5}, {7.5, -7.5, 7.5}, {7.5, 30}});
  for (const auto& p : cloud(5000)) {
    if (ask(die, p).distance > -2.0) {  // deeper than the fillet, the ring measures to its faces
      ASSERT_NEAR(ask(die, p).distance, ask(die_profile, p).distance, distance_rounding);
    }
    ASSERT_NEAR(ask(ball, p).distance, ask(ball_profile, p).distance, distance_rounding);
  }
}

// A brute-force answer: the least distance to many points along the outline.
// Contact asks for those that may touch, and after a restart for all. A block is full, as contact's are but the last.
TEST(ToolShape, WhoIsAskedWithWhomDoesNotShow) {
  constexpr int together = 8;
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> turn(-3.0, 3.0), far(10.0, 14.0), height(-2.5, 1.0);
  for (const Tool& tool : zoo()) {
    std::vector<Vec3> points = cloud(2000);
    for (int k = 0; k < 2000; ++k) {  // over a ring's face, and where it begins
      const double angle = turn(generator), r = k % 4 == 0 ? 10.0 : far(generator);
      points.push_back({r * std::cos(angle), r * std::sin(angle), height(generator)});
    }
    const auto distances = [&](const std::vector<Vec3>& group) {
      std::array<std::vector<double>, 3> x;
      for (const Vec3& p : group)
        for (std::size_t c = 0; c < 3; ++c) x[c].push_back(p[c]);
      Distances out;
      tool_distances(tool, tool.start, {x[0].data(), x[1].data(), x[2].data()}, static_cast<int>(group.size()), nullptr,
                     out);
      return out;
    };
    const auto count = static_cast<std::ptrdiff_t>(points.size());
    std::uniform_int_distribution<std::ptrdiff_t> any(0, count - together);
    for (std::ptrdiff_t first = 0; first + together <= count; first += together) {
      std::vector<Vec3> group(points.begin() + first, points.begin() + first + together);
      const Distances alone = distances(group);
      const std::ptrdiff_t other = any(generator);
      group.insert(group.end(), points.begin() + other, points.begin() + other + together);
      const Distances with_others = distances(group);
      for (int n = 0; n < together; ++n) {
        ASSERT_EQ(alone.distance[n], with_others.distance[n]);
        for (int c = 0; c < 3; ++c) ASSERT_EQ(alone.normal[c][n], with_others.normal[c][n]);
      }
    }
  }
}

TEST(ToolShape, ProfileDistanceIsThatOfItsOutline) {
  const Profile profile = make_profile({{0, -3}, {5, 2, 0, 2}, {5, 6, 1}, {9, 6}, {9, 12}}, "test");
  const double step = 0.002;  // mm, between the points
  std::vector<std::array<double, 2>> outline;
  const auto add_line = [&](double r0, double z0, double r1, double z1) {
    const int count = static_cast<int>(std::hypot(r1 - r0, z1 - z0) / step);
    for (int n = 0; n <= count; ++n) outline.push_back({r0 + (r1 - r0) * n / count, z0 + (z1 - z0) * n / count});
  };
  const auto add_arc = [&](double r, double z, double radius, double from, double to) {
    for (double a = from; a <= to; a += step / radius)
      outline.push_back({r + radius * std::cos(a), z + radius * std::sin(a)});
  };
  constexpr double pi = std::numbers::pi;
  add_arc(0, 2, 5, -pi / 2, 0);
  add_line(5, 2, 5, 5);
  add_arc(6, 5, 1, pi / 2, pi);
  add_line(6, 6, 9, 6);
  add_line(9, 6, 9, 40);  // the last line is endless
  for (const auto& p : cloud(500)) {
    const double r = std::hypot(p[0], p[1]), z = p[2];
    double least = 1e9;
    for (const auto& q : outline) least = std::min(least, std::hypot(q[0] - r, q[1] - z));
    EXPECT_NEAR(std::abs(profile_distance(profile, r, z).distance), least, step);
    const bool inside =
        z > 6 ? r < 9
              : (z > 2 ? r < 5 || (z > 5 && r < 6 && std::hypot(r - 6, z - 5) > 1) : r * r + (z - 2) * (z - 2) < 25);
    if (least > 1e-6) {
      EXPECT_EQ(profile_distance(profile, r, z).distance < 0.0, inside) << r << " " << z;
    }
  }
}

TEST(ToolShape, ProfilesThatAreNoneAreRefused) {
  const auto refused = [](const std::vector<std::vector<double>>& corners, const std::string& word) {
    try {
      (void)make_profile(corners, "here");
    } catch (const InputError& error) {
      return std::string(error.what()).starts_with("here") && std::string(error.what()).find(word) != std::string::npos;
    }
    return false;
  };
  EXPECT_TRUE(refused({{0, 0}}, "two corners"));
  EXPECT_TRUE(refused({{0, 0}, {0, 0}}, "once more"));
  EXPECT_TRUE(refused({{0, 0}, {5}}, "[r, z]"));
  EXPECT_TRUE(refused({{-1, 0}, {5, 0}}, "negative"));
  EXPECT_TRUE(refused({{0, 0}, {5, 0, 9}, {5, 4}}, "smaller"));
  EXPECT_TRUE(refused({{0, 0}, {5, 0, 1}}, "radius"));
  EXPECT_TRUE(refused({{0, 0}, {5, 0, 1, 1}}, "centre"));
  EXPECT_TRUE(refused({{0, -5}, {5, 0, 0, 0}}, "ends on an arc"));
}

// A sphere of triangles, as fine as `rings`.
TriangleList faceted_sphere(double radius, int rings) {
  TriangleList list;
  constexpr double pi = std::numbers::pi;
  const int around = 2 * rings;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < around; ++j) {
      const double a = pi * i / rings, b = 2 * pi * j / around;
      list.point.push_back(
          {radius * std::sin(a) * std::cos(b), radius * std::sin(a) * std::sin(b), radius * std::cos(a)});
    }
  const auto at = [&](int i, int j) { return i == 0 || i == rings ? i * around : i * around + j % around; };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < around; ++j) {
      if (i > 0) list.triangle.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i < rings - 1) list.triangle.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
    }
  return list;
}

double point_triangle_squared(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  // brute force over barycentric coordinates, refined about the best
  double best = 1e300, bu = 0.0, bv = 0.0, width = 1.0;
  for (int level = 0; level < 14; ++level, width *= 0.35) {
    const double cu = bu, cv = bv;
    for (int i = -6; i <= 6; ++i)
      for (int j = -6; j <= 6; ++j) {
        const double u = std::clamp(cu + width * i / 6.0, 0.0, 1.0), v = std::clamp(cv + width * j / 6.0, 0.0, 1.0 - u);
        double square = 0.0;
        for (int k = 0; k < 3; ++k) square += std::pow(a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]) - p[k], 2);
        if (square < best) best = square, bu = u, bv = v;
      }
  }
  return best;
}

TEST(TriangleTool, DistanceEqualsBruteForceForAnyHint) {
  const TriangleList list = faceted_sphere(10.0, 8);
  const TriangleSurface surface(list, "test");
  std::mt19937 generator(3);
  for (const auto& p : cloud(150)) {
    double least = 1e300;
    for (const auto& t : list.triangle)
      least = std::min(least, point_triangle_squared(p, list.point[t[0]], list.point[t[1]], list.point[t[2]]));
    const double expected = std::sqrt(least);
    for (int n = 0; n < 3; ++n) {
      const int hint = static_cast<int>(generator() % static_cast<unsigned>(surface.size()));
      // the refined search ends at a grid of 1e-6 of a side; beside the closest point the distance is flat
      EXPECT_NEAR(std::abs(surface.distance(p, hint).distance), expected, 1e-5 * (1.0 + expected));
    }
  }
}

TEST(TriangleTool, InsideAndOutsideAreToldApartAtCornersAndEdges) {
  const TriangleList list = faceted_sphere(10.0, 8);
  const TriangleSurface surface(list, "test");
  for (const auto& q : list.point)
    for (const double scale : {1e-6, 0.01, 0.3}) {
      Vec3 out = q, in = q;
      for (int c = 0; c < 3; ++c) {
        out[c] *= 1.0 + scale;
        in[c] *= 1.0 - scale;
      }
      EXPECT_GT(surface.distance(out).distance, 0.0);
      EXPECT_LT(surface.distance(in).distance, 0.0);
    }
}

// Sides of which squares or differences are lost beside the distance (found by fuzzing).
TEST(TriangleTool, SliversAnswerWithNumbers) {
  for (const double width : {1e-6, 1e-12, 1e-19, 1e-41}) {
    const std::vector<TriangleList> slivers = {{{{0, 1, 0}, {0, width, 0}, {width, 0, width}}, {{0, 1, 2}}},
                                               {{{0, 0, 0}, {width, 0, 0}, {0, width, 0}}, {{0, 1, 2}}},
                                               {{{0, 0, 0}, {1, 0, 0}, {0.5, width, 0}}, {{0, 1, 2}}}};
    for (const TriangleList& list : slivers) {
      const TriangleSurface surface(list, "test");
      for (const Vec3& p : {Vec3{1, 0, -0.5}, Vec3{1, 1, -0.5}, Vec3{0.5, 2, 1}, Vec3{-1, 0, 0}, Vec3{0.3, 0.3, 0.3}}) {
        const double there = surface.distance(p).distance;
        double least = HUGE_VAL;  // to the corners
        for (const auto& q : list.point) least = std::min(least, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
        EXPECT_TRUE(std::isfinite(there) && std::abs(there) <= least + 1e-9)
            << there << " where a corner is " << least << " away, width " << width;
      }
    }
  }
}

TEST(TriangleTool, SurfacesTurnedAgainstEachOtherAreRefused) {
  TriangleList list = faceted_sphere(10.0, 4);
  std::swap(list.triangle[3][0], list.triangle[3][1]);
  EXPECT_THROW(TriangleSurface(list, "test"), InputError);
  EXPECT_THROW(TriangleSurface(TriangleList{}, "test"), InputError);
}

}  // namespace
}  // namespace weaveform
