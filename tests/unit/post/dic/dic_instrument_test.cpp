// The virtual instrument against closed forms: facets, strain windows, noise, uncertainty.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <random>

#include "core/vector/angle.hpp"
#include "fabric/card/card.hpp"
#include "mesher/lattice/build.hpp"
#include "mesher/scene/reader.hpp"
#include "post/dic/virtual/facet.hpp"
#include "post/dic/virtual/noise.hpp"
#include "post/dic/virtual/strain_window.hpp"
#include "post/dic/virtual/zone_border.hpp"

namespace {

using namespace weaveform;
using namespace weaveform::dic;
using Eigen::Vector2d;

const double r = std::sqrt(0.5);
const YarnDirections diagonal = {{r, r}, {-r, r}};
const YarnDirections upright = {{1.0, 0.0}, {0.0, 1.0}};

// Angle between two yarns by acos, not by the asin of the code.
double angle_of(const Eigen::Matrix2d& f, const YarnDirections& yarns) {
  const Vector2d a = f * Vector2d(yarns.g1[0], yarns.g1[1]), b = f * Vector2d(yarns.g2[0], yarns.g2[1]);
  return 0.5 * std::numbers::pi - std::acos(a.dot(b) / (a.norm() * b.norm()));
}

TEST(VirtualInstrument, HomogeneousTrellisComesBackExactly) {
  for (const double gamma : {-40.0, -5.0, 0.0, 12.0, 31.0, 60.0}) {
    const double half = 0.5 * gamma * degree;
    const auto field = [&](const Vec2& p) {
      // Both yarns turn by half the angle towards y, whatever the whole turns by.
      const Vector2d x(p[0], p[1]), g1(r, r), g2(-r, r);
      const Eigen::Rotation2Dd whole(0.3);
      return Vector2d(
          whole * (x.dot(g1) * (Eigen::Rotation2Dd(half) * g1) + x.dot(g2) * (Eigen::Rotation2Dd(-half) * g2)) - x);
    };
    for (const double facet : {0.0, 3.0, 17.0})
      for (const int window : {3, 5, 15})
        EXPECT_NEAR(levelled_angle(field, {31.0, -7.0}, facet, 2.5, window, diagonal), gamma * degree, 1e-12);
  }
}

// Displacements of the second degree: neither facet nor symmetric window moves the gradient in the middle.
TEST(VirtualInstrument, LinearStrainComesBackExactly) {
  const auto field = [](const Vec2& p) {
    return Vector2d(0.02 * p[0] * p[1] - 0.01 * p[1] * p[1], 0.005 * p[0] * p[0] + 0.01 * p[0] * p[1]);
  };
  const Vec2 at = {4.0, -3.0};
  Eigen::Matrix2d f;
  f << 1.0 + 0.02 * at[1], 0.02 * at[0] - 0.02 * at[1], 0.01 * at[0] + 0.01 * at[1], 1.0 + 0.01 * at[0];
  EXPECT_NEAR(levelled_angle(field, at, 5.0, 2.0, 7, diagonal), angle_of(f, diagonal), 1e-13);
}

// u = a y^3: the mean over a facet is a (y^3 + y f^2 / 4), the window's slope a (sum y^4 / sum y^2 + f^2 / 4).
TEST(VirtualInstrument, QuadraticStrainIsLevelledAsTheClosedFormSaysInSecondOrder) {
  constexpr double a = 1e-4;
  const auto field = [](const Vec2& p) { return Vector2d(a * p[1] * p[1] * p[1], 0.0); };
  double before = 0.0;
  for (const double facet : {16.0, 8.0, 4.0, 2.0}) {
    const double step = 0.5 * facet;
    double fourth = 0.0, second = 0.0;
    for (int j = -2; j <= 2; ++j) {
      fourth += std::pow(j * step, 4);
      second += std::pow(j * step, 2);
    }
    const double slope = a * (fourth / second + facet * facet / 4.0);
    const double levelled = levelled_angle(field, {0.0, 0.0}, facet, step, 5, upright);
    // F = [[1, slope], [0, 1]]: the weft turns by atan(slope).
    EXPECT_NEAR(levelled, std::atan(slope), 1e-13) << facet;
    // The true angle there is 0, so `levelled` is the error: halving the instrument quarters it.
    if (before > 0.0) {
      EXPECT_NEAR(before / levelled, 4.0, 1e-3) << facet;
    }
    before = levelled;
  }
}

// Mean of max(0, s + x) over a square of side f, its diagonal along x: the square's extent along x is a triangle of
// half width h = f / sqrt(2), integrated twice.
double ramp_mean(double s, double f) {
  const double h = f / std::sqrt(2.0);
  if (s <= -h) return 0.0;
  if (s >= h) return s;
  return s <= 0.0 ? std::pow(s + h, 3) / (6.0 * h * h) : s + std::pow(h - s, 3) / (6.0 * h * h);
}

TEST(VirtualInstrument, KinkBetweenZonesIsLevelledAsTheClosedFormSays) {
  constexpr double gamma = 31.0 * degree, step = 2.0;
  const auto field = [](const Vec2& p) { return ideal_zone_border(p, gamma, diagonal); };
  const Vector2d g1 = Vector2d(r, r), g2 = Vector2d(-r, r);
  Eigen::Matrix2d yarns, zone_a;
  yarns << g1, g2;
  zone_a << Eigen::Rotation2Dd(0.5 * gamma) * g1, Eigen::Rotation2Dd(-0.5 * gamma) * g2;
  const Eigen::Matrix2d f_a = zone_a * yarns.inverse();
  const Vector2d jump = g2 - Eigen::Rotation2Dd(-0.5 * gamma) * g2;  // of F g2 across the border
  for (const double facet : {2.0, 4.0, 8.0})
    for (const int window : {3, 5, 9})
      for (const double s : {-12.0, -4.0, -1.3, 0.0, 0.7, 3.0, 9.0}) {
        const Vector2d centre = s * g2;
        Vector2d slope = Vector2d::Zero();
        double square = 0.0;
        for (int i = -(window / 2); i <= window / 2; ++i)
          for (int j = -(window / 2); j <= window / 2; ++j) {
            const Vector2d offset(i * step, j * step);
            slope += ramp_mean((centre + offset).dot(g2), facet) * offset;
            square += 0.5 * offset.squaredNorm();
          }
        const Eigen::Matrix2d f = f_a + jump * (slope / square).transpose();
        // The quadrature meets the kink with squares of f/4: at most a few thousandths of the jump's 15.5 degrees.
        EXPECT_NEAR(levelled_angle(field, {centre[0], centre[1]}, facet, step, window, diagonal), angle_of(f, diagonal),
                    0.05 * degree)
            << "facet " << facet << ", window " << window << ", s " << s;
      }
}

TEST(VirtualInstrument, IdealBorderHasTheZonesAngles) {
  constexpr double gamma = 25.0 * degree;
  const auto field = [](const Vec2& p) { return ideal_zone_border(p, gamma, diagonal); };
  EXPECT_NEAR(levelled_angle(field, {30.0, -30.0}, 4.0, 2.0, 5, diagonal), gamma, 1e-12);
  EXPECT_NEAR(levelled_angle(field, {-30.0, 30.0}, 4.0, 2.0, 5, diagonal), 0.5 * gamma, 1e-12);
}

class OnTheMesh : public testing::Test {
protected:
  OnTheMesh() {
    scene = read_scene(WEAVEFORM_SOURCE_DIR "/examples/bias_extension_pw.toml",
                       {"blank.coarsening=3", "blank.orientation=20", "blank.position=[5,-8,2]"});
    mesh = build_mesh(scene, load_card(scene.fabric.material, scene.file));
  }
  [[nodiscard]] std::vector<Vec3> linear(const FlatMesh& flat) const {
    std::vector<Vec3> u;
    for (const Vec2& x : flat.nodes()) u.push_back(at(x));
    return u;
  }
  static Vec3 at(const Vec2& x) { return {0.3 + 0.1 * x[0] - 0.2 * x[1], -1.0 + 0.05 * x[1], 0.01 * x[0]}; }
  [[nodiscard]] std::vector<Vec2> places() const {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> x(-57.5, 57.5), y(-115.0, 115.0);
    std::vector<Vec2> points = {{0.0, 0.0}, {57.499, 0.0}, {-57.4, 114.9}, {0.0, -114.99}};
    for (int i = 0; i < 3000; ++i) points.push_back({x(random), y(random)});
    return points;
  }
  Scene scene;
  Mesh mesh;
};

// Every point of the blank lies in a cell (edge cells too), and linear fields are sampled exactly.
TEST_F(OnTheMesh, SamplingCoversTheBlankAndKeepsLinearFields) {
  const FlatMesh flat(mesh, scene.blank);
  const auto points = places();
  const auto u = linear(flat);
  for (const double facet : {0.0, 7.0}) {
    const Sampling sampling = sample_facets(flat, points, facet, 0.2, 0.4);
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_TRUE(sampling.found(i)) << points[i][0] << ", " << points[i][1];
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(sampling.value(i, u)[k], at(points[i])[k], 1e-9) << points[i][0] << ", " << points[i][1];
    }
  }
  const Sampling outside = sample_points(flat, {{58.0, 0.0}, {0.0, 116.0}, {-200.0, 3.0}, {std::nan(""), 0.0}});
  for (std::size_t i = 0; i < outside.size(); ++i) EXPECT_FALSE(outside.found(i));
}

TEST_F(OnTheMesh, FacetsOffTheFabricSeeNothing) {
  const FlatMesh flat(mesh, scene.blank);
  // At the middle of an edge half of a facet is on the fabric.
  EXPECT_TRUE(sample_facets(flat, {{57.4, 0.0}}, 6.0, 0.45).found(0));
  EXPECT_FALSE(sample_facets(flat, {{57.4, 0.0}}, 6.0, 0.55).found(0));
  EXPECT_FALSE(sample_facets(flat, {{57.6, 0.0}}, 6.0, 0.1).found(0));
}

struct GridField {
  std::vector<Vec2> point;
  std::vector<Vec3> u;
  std::vector<bool> valid;
};

GridField grid(int side, double step, std::uint64_t seed, double noise) {
  GridField field;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const NoiseKey key = {seed, 0, field.point.size()};
      const double x = i * step, y = j * step;
      field.point.push_back({x, y});
      field.u.push_back(
          {0.1 * x + 0.3 * y + noise * normal(key, 0), -0.2 * x + 0.05 * y + noise * normal(key, 1), 0.0});
      field.valid.push_back(true);
    }
  return field;
}

TEST(StrainWindow, LinearFieldIsExactWithHolesAndAtTheEdges) {
  GridField field = grid(12, 1.7, 1, 0.0);
  for (const std::size_t hole : {14, 15, 27, 60, 61, 100}) field.valid[hole] = false;
  const Neighbours neighbours = find_neighbours(field.point, 1.7, 5);
  EXPECT_EQ(neighbours.full, 25);
  Eigen::Matrix2d f;
  f << 1.1, 0.3, -0.2, 1.05;
  int fitted = 0;
  for (std::size_t i = 0; i < field.point.size(); ++i) {
    const WindowFit fit = fit_window(field.point, neighbours, i, field.valid, field.u, 0.3);
    EXPECT_EQ(fit.good, field.valid[i]);
    if (!fit.good) continue;
    ++fitted;
    EXPECT_NEAR(shear_angle(fit.gradient, diagonal), angle_of(f, diagonal), 1e-12);
    EXPECT_NEAR(fit.scatter, 0.0, 1e-7);  // the square root of rounding in a sum of squares
  }
  EXPECT_EQ(fitted, 144 - 6);
  // Whole windows only: those of the inner points without a hole in sight.
  EXPECT_FALSE(fit_window(field.point, neighbours, 0, field.valid, field.u, 1.0).good);
}

TEST(StrainWindow, PointsOnALineHaveNoGradient) {
  GridField field;
  for (int i = 0; i < 9; ++i) {
    field.point.push_back({static_cast<double>(i), 0.0});
    field.u.push_back({0.0, 0.0, 0.0});
    field.valid.push_back(true);
  }
  const Neighbours neighbours = find_neighbours(field.point, 1.0, 9);
  EXPECT_FALSE(fit_window(field.point, neighbours, 4, field.valid, field.u, 0.1).good);
}

TEST(StrainWindow, StepIsFoundWithPointsMissing) {
  GridField field = grid(40, 2.25, 1, 0.0);
  std::vector<Vec2> left;
  for (std::size_t i = 0; i < field.point.size(); ++i)
    if (uniform({3, 0, i}, 0) > 0.3) left.push_back(field.point[i]);
  EXPECT_DOUBLE_EQ(typical_step(left), 2.25);
}

TEST(StrainWindow, SensitivityIsTheDerivative) {
  Eigen::Matrix<double, 3, 2> gradient;
  gradient << 0.1, 0.3, -0.2, 0.05, 0.15, -0.1;
  const auto sensitivity = angle_sensitivity(gradient, diagonal);
  constexpr double h = 1e-6;
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 2; ++l) {
      auto up = gradient, down = gradient;
      up(k, l) += h;
      down(k, l) -= h;
      EXPECT_NEAR(sensitivity(k, l), (shear_angle(up, diagonal) - shear_angle(down, diagonal)) / (2.0 * h), 1e-9);
    }
}

// 4000 noisy windows: their scatter of the angle and about the plane is what is predicted. A standard deviation from
// n draws is known to 1/sqrt(2 n) = 1.1 %: four times that is allowed.
TEST(StrainWindow, UncertaintyIsTheScatterOfManySeeds) {
  constexpr double noise = 0.01;
  constexpr int seeds = 4000;
  double sum = 0.0, square = 0.0, scatter = 0.0, predicted = 0.0;
  for (int seed = 0; seed < seeds; ++seed) {
    const GridField field = grid(5, 2.0, static_cast<std::uint64_t>(seed), noise);
    const Neighbours neighbours = find_neighbours(field.point, 2.0, 5);
    const WindowFit fit = fit_window(field.point, neighbours, 12, field.valid, field.u, 0.5);
    const double angle = shear_angle(fit.gradient, diagonal);
    sum += angle / seeds;
    square += angle * angle / seeds;
    scatter += fit.scatter * fit.scatter / seeds;
    predicted += angle_uncertainty(fit, angle_sensitivity(fit.gradient, diagonal), noise, 2) / seeds;
  }
  EXPECT_NEAR(std::sqrt(square - sum * sum) / predicted, 1.0, 0.045);
  EXPECT_NEAR(std::sqrt(scatter) / noise, 1.0, 0.02);
}

TEST(Noise, IsNormalAndDependsOnEveryKey) {
  constexpr int draws = 100000;
  double sum = 0.0, square = 0.0, product = 0.0;
  for (std::uint64_t i = 0; i < draws; ++i) {
    const double a = normal({1, 2, i}, 0), b = normal({1, 2, i}, 1);
    sum += a / draws;
    square += a * a / draws;
    product += a * b / draws;
  }
  EXPECT_NEAR(sum, 0.0, 4.0 / std::sqrt(draws));
  EXPECT_NEAR(square, 1.0, 4.0 * std::sqrt(2.0 / draws));
  EXPECT_NEAR(product, 0.0, 4.0 / std::sqrt(draws));
  EXPECT_EQ(normal({1, 2, 3}, 0), normal({1, 2, 3}, 0));
  EXPECT_NE(normal({1, 2, 3}, 0), normal({2, 2, 3}, 0));
  EXPECT_NE(normal({1, 2, 3}, 0), normal({1, 3, 3}, 0));
  EXPECT_NE(normal({1, 2, 3}, 0), normal({1, 2, 4}, 0));
}

}  // namespace
