// Nets on evenly laid triangles against the same nets on the smooth surface: the generators run along rows of vertices,
// beside them and across, and take their share of each vertex's angle deficit, so that places and angles come nearer
// with the square of the facets' size wherever the seed lies.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <memory>
#include <string>

#include "tests/support/drape_case.hpp"

namespace weaveform {
namespace {

using namespace weaveform::test;
constexpr double one_degree = std::numbers::pi / 180.0;

using Height = std::function<double(double, double)>;
using Slope = std::function<Eigen::Vector2d(double, double)>;

struct Shape {
  std::string name;
  Height height;
  Slope slope;
};

Shape saddle() {
  return {"saddle", [](double x, double y) { return (x * x - y * y) / 160.0; },
          [](double x, double y) { return Eigen::Vector2d(x / 80.0, -y / 80.0); }};
}

Shape cap() {
  constexpr double radius = 75.0;  // mm
  const auto height = [](double x, double y) { return std::sqrt(radius * radius - x * x - y * y); };
  return {"sphere", height, [height](double x, double y) { return Eigen::Vector2d(-x, -y) / height(x, y); }};
}

// Squares of side h cut along one diagonal, 100 mm wide, a vertex at the origin.
std::shared_ptr<const TriangleSurface> triangles_of(const Shape& shape, double h) {
  const int half = static_cast<int>(50.0 / h), side = 2 * half + 1;
  TriangleList list;
  for (int j = -half; j <= half; ++j)
    for (int i = -half; i <= half; ++i) list.point.push_back({i * h, j * h, shape.height(i * h, j * h)});
  for (int j = 0; j + 1 < side; ++j)
    for (int i = 0; i + 1 < side; ++i) {
      const int a = j * side + i, b = a + 1, c = a + side, d = c + 1;
      list.triangle.push_back({a, b, d});
      list.triangle.push_back({a, d, c});
    }
  return std::make_shared<TriangleSurface>(list, shape.name);
}

struct Errors {
  double place = 0.0;  // mm
  double angle = 0.0;  // rad
};

// A net of 20 by 20 cells of 3 mm around a seed, the warp at an angle to the rows of vertices, on both.
Errors errors_of(const Shape& shape, double h, const Eigen::Vector2d& seed, double turn) {
  Tool tool;
  tool.shape = ToolShape::triangles;
  tool.surface = triangles_of(shape, h);
  const ToolSurface facets(tool, 0.0);
  const auto smooth = height_field(shape.height, shape.slope);
  NetStart start;
  start.seed = {seed[0], seed[1], shape.height(seed[0], seed[1])};
  start.normal = Vector3d(-shape.slope(seed[0], seed[1])[0], -shape.slope(seed[0], seed[1])[1], 1.0).normalized();
  start.warp = Vector3d(std::cos(turn), std::sin(turn), 0.0);
  start.warp = (start.warp - start.warp.dot(start.normal) * start.normal).normalized();
  start.spacing = {3.0, 3.0};
  constexpr int cells = 10;
  const DrapedNet reference = drape_all(smooth, start, square_box(cells));
  int hint = 0;
  EXPECT_TRUE(project(facets, start.seed, hint));
  const DrapedNet net = drape_all(facets, start, square_box(cells));
  EXPECT_LT(length_error(net, start), 1e-9);
  Errors worst;
  for (std::size_t k = 0; k < net.position.size(); ++k)
    worst.place = std::max(worst.place, (net.position[k] - reference.position[k]).norm());
  for (int j = -cells; j < cells; ++j)
    for (int i = -cells; i < cells; ++i)
      worst.angle = std::max(worst.angle, std::abs(cell_angle(net, i, j) - cell_angle(reference, i, j)));
  return worst;
}

// Where the seed lies in its square of vertices (in sides of it), and the warp's direction (deg).
struct Course {
  Eigen::Vector2d phase;
  double turn;
};

class DrapeTriangles : public testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(DrapeTriangles, NetsTendToTheSmoothSurfaceInSecondOrderWhereverTheyRun) {
  const auto [which, course] = GetParam();
  const Shape shape = which == 0 ? saddle() : cap();
  const std::array<Course, 6> courses = {{{{0.0, 0.0}, 0.0},
                                          {{0.0, 0.0}, 45.0},
                                          {{0.0, 1e-7}, 0.0},
                                          {{0.5, 0.25}, 0.0},
                                          {{0.3, 0.1}, 45.0},
                                          {{0.3, 0.1}, 20.0}}};
  const auto& [phase, turn] = courses[course];
  std::array<Errors, 3> errors;
  const std::array<double, 3> size = {2.0, 1.0, 0.5};  // mm
  for (int level = 0; level < 3; ++level) {
    // the seed in a square some way off the middle, at the same place of it for all sizes
    const Eigen::Vector2d seed = Eigen::Vector2d(6.0, -4.0) + size[level] * phase;
    errors[level] = errors_of(shape, size[level], seed, turn * one_degree);
    RecordProperty("place_mm_" + std::to_string(level), std::to_string(errors[level].place));
    RecordProperty("angle_deg_" + std::to_string(level), std::to_string(errors[level].angle / one_degree));
  }
  // two halvings together: a single one is uneven, for the facets under a node differ from size to size
  EXPECT_GT(std::log2(errors[0].place / errors[2].place), 2.0 * 1.7);
  EXPECT_GT(std::log2(errors[0].angle / errors[2].angle), 2.0 * 1.5);
  EXPECT_LT(errors[2].place, 0.01);
  EXPECT_LT(errors[2].angle, 0.05 * one_degree);
}

INSTANTIATE_TEST_SUITE_P(ShapesAndCourses, DrapeTriangles,
                         testing::Combine(testing::Values(0, 1), testing::Values(0, 1, 2, 3, 4, 5)));

}  // namespace
}  // namespace weaveform
