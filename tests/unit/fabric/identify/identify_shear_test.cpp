// Fitting of shear laws: constrained least squares, exact recovery, positive tangents, the choice of a form.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.hpp"
#include "core/vector/angle.hpp"
#include "fabric/identify/constrained_least_squares.hpp"
#include "fabric/identify/shear_fit.hpp"
#include "fabric/identify/statistics.hpp"
#include "fabric/trellis/bias_rectangle.hpp"
#include "fabric/trellis/shear_frame.hpp"

namespace weaveform::identify {
namespace {

std::vector<ShearObservation> observations_of(const ShearCurve& truth, double to_deg) {
  std::vector<ShearObservation> all;
  for (int i = 1; i <= to_deg; ++i) {
    all.push_back({i * degree, 1.0, 0.0, 0.0});
    all.back().value = predicted(truth, all.back());
  }
  return all;
}

Eigen::MatrixXd random_matrix(std::mt19937& random, int rows, int columns) {
  std::normal_distribution<double> normal;
  Eigen::MatrixXd matrix(rows, columns);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) matrix(i, j) = normal(random);
  return matrix;
}

// Karush-Kuhn-Tucker: feasible, and the gradient is a combination of active constraints with multipliers >= 0, so that
// no feasible direction descends. Checked by trying many feasible points nearby and far.
TEST(LeastSquaresAbove, NoFeasiblePointIsBetter) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::MatrixXd A = random_matrix(random, 12, 4), G = random_matrix(random, 6, 4);
    const Eigen::VectorXd b = random_matrix(random, 12, 1);
    const Eigen::VectorXd inside = random_matrix(random, 4, 1);
    const Eigen::VectorXd h = G * inside - Eigen::VectorXd::Constant(6, 0.1);  // so that `inside` is feasible
    const Eigen::VectorXd x = least_squares_above(A, b, G, h);
    EXPECT_GE((G * x - h).minCoeff(), -1e-9);
    const double best = (A * x - b).norm();
    for (int i = 0; i < 200; ++i) {
      const Eigen::VectorXd other = x + std::pow(10.0, -i % 5) * Eigen::VectorXd(random_matrix(random, 4, 1));
      if ((G * other - h).minCoeff() < 0.0) continue;
      EXPECT_GE((A * other - b).norm(), best - 1e-9);
    }
  }
}

TEST(LeastSquaresAbove, ConstraintsThatDoNotBindChangeNothing) {
  std::mt19937 random(2);
  const Eigen::MatrixXd A = random_matrix(random, 12, 4), G = random_matrix(random, 6, 4);
  const Eigen::VectorXd b = random_matrix(random, 12, 1), free = least_squares(A, b);
  const Eigen::VectorXd h = G * free - Eigen::VectorXd::Ones(6);
  EXPECT_NEAR((least_squares_above(A, b, G, h) - free).norm(), 0.0, 1e-10);
}

TEST(LeastSquaresAbove, ContradictionIsAnInputError) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(2, 2);
  Eigen::MatrixXd G(2, 2);
  G << 1, 0, -1, 0;  // x0 >= 1 and x0 <= -1
  EXPECT_THROW((void)least_squares_above(A, Eigen::VectorXd::Zero(2), G, Eigen::VectorXd::Ones(2)), InputError);
}

TEST(StudentT, HasTheTabulatedValues) {
  // Abramowitz & Stegun 1964, table 26.10
  EXPECT_NEAR(student_t(0.95, 1), 12.706, 5e-4);
  EXPECT_NEAR(student_t(0.95, 4), 2.776, 5e-4);
  EXPECT_NEAR(student_t(0.99, 10), 3.169, 5e-4);
  EXPECT_NEAR(student_t(0.90, 120), 1.658, 5e-4);
}

TEST(ShearCurve, APolynomialComesBackExactly) {
  const ShearCurve truth{{0.0, 0.264, -0.533, 0.313, 0.42}, {}};
  const auto fit = fit_shear_curve(observations_of(truth, 50), {4, false});
  for (std::size_t n = 0; n < 5; ++n) EXPECT_NEAR(fit.curve.stress[n], truth.stress[n], 1e-10);
  EXPECT_FALSE(fit.constrained);
}

TEST(ShearCurve, AFrictionLikeStartComesBack) {
  const ShearCurve truth{{0.0, 0.05, 0.1, 0.0, 0.3}, {0.07, 0.02}};
  const auto fit = fit_shear_curve(observations_of(truth, 50), {4, true});
  EXPECT_NEAR(fit.curve.start.plateau, 0.07, 1e-5);
  EXPECT_NEAR(fit.curve.start.rise, 0.02, 1e-5);
}

TEST(ShearCurve, LoadsOfABiasExtensionGiveTheSameLaw) {
  const ShearCurve truth{{0.0, 0.264, -0.533, 0.313, 0.42}, {}};
  auto seen = observations_of(truth, 45);
  for (auto& one : seen) {
    const auto weights = bias_load_weights({115.0, 300.0}, 0.5, one.angle);
    one = {one.angle, weights.full, weights.half, 0.0};
    one.value = predicted(truth, one);
  }
  const auto fit = fit_shear_curve(seen, {4, false});
  for (std::size_t n = 0; n < 5; ++n) EXPECT_NEAR(fit.curve.stress[n], truth.stress[n], 1e-9);
}

TEST(ShearCurve, TheTangentIsPositiveWhereTheFreeOneIsNot) {
  // A curve that dips: its free fit has a negative tangent, which the paper's law must not have.
  const ShearCurve dipping{{0.0, 0.3, -0.9, 0.8, 0.1}, {}};
  ASSERT_FALSE(negative_tangent(dipping, 1.0).empty());
  for (const bool start : {false, true}) {
    const auto fit = fit_shear_curve(observations_of(dipping, 50), {4, start});
    EXPECT_TRUE(fit.constrained);
    EXPECT_TRUE(negative_tangent(fit.curve, log_shear_strain(50 * degree)).empty());
    EXPECT_GE(fit.squares, fit.free_squares);
    for (int i = 0; i <= 500; ++i)
      EXPECT_GT(tangent_of(fit.curve, log_shear_strain(0.1 * i * degree)), 0.0) << 0.1 * i << " deg";
  }
}

std::vector<ShearSpecimen> specimens_of(const ShearCurve& truth, double noise) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<ShearSpecimen> specimens(4);
  for (auto& specimen : specimens) {
    specimen.grid = observations_of(truth, 50);
    for (auto& seen : specimen.grid) seen.value += noise * normal(random);
  }
  return specimens;
}

TEST(ShearForm, TheStartIsTakenOnlyWhereThereIsOne) {
  const ShearCurve with_start{{0.0, 0.05, 0.1, 0.0, 0.3}, {0.07, 0.02}}, without{{0.0, 0.264, -0.533, 0.313, 0.42}, {}};
  EXPECT_TRUE(fit_shear(specimens_of(with_start, 1e-3), 4, FormAsked::automatic, 0.95).start_chosen);
  EXPECT_FALSE(fit_shear(specimens_of(without, 1e-3), 4, FormAsked::automatic, 0.95).start_chosen);
  EXPECT_TRUE(fit_shear(specimens_of(without, 1e-3), 4, FormAsked::polynomial_start, 0.95).start_chosen)
      << "as asked for";
}

TEST(LocalValue, AveragesNoiseAndKeepsAParabola) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  std::vector<double> x, exact, noisy;
  for (int i = 0; i <= 400; ++i) {
    x.push_back(0.01 * i);
    exact.push_back(1.0 + x.back() * x.back());
    noisy.push_back(exact.back() + 0.1 * normal(random));
  }
  EXPECT_NEAR(local_value(x, exact, 2.0, 0.5), 5.0, 1e-12);
  EXPECT_NEAR(local_value(x, exact, 2.005, 0.001), 1.0 + 2.005 * 2.005, 1e-4) << "a line between neighbours";
  // 101 points under a parabola: deviation 0.1 * 1.5 / sqrt(101) = 0.015.
  EXPECT_NEAR(local_value(x, noisy, 2.0, 0.5), 5.0, 0.06);
}

TEST(Trellis, FrameAndBiasAnglesInvert) {
  const ShearFrame frame{216.0, 120.0};
  const BiasRectangle rectangle{115.0, 260.0};
  for (double angle = 0.0; angle < 80.0 * degree; angle += 5.0 * degree) {
    EXPECT_NEAR(frame_shear_angle(frame, frame_displacement(frame, angle)), angle, 1e-12);
    EXPECT_NEAR(bias_shear_angle(rectangle, bias_travel(rectangle, angle)), angle, 1e-12);
    EXPECT_NEAR(normalised_shear_force(frame, frame_load(frame, 0.3, angle), angle), 0.3, 1e-14);
  }
  EXPECT_TRUE(std::isnan(frame_shear_angle(frame, 1000.0)));
}

TEST(Trellis, ZonesFillTheRectangle) {
  for (const double length : {150.0, 200.0, 230.0, 345.0}) {
    const BiasZones zones = bias_zones({115.0, length});
    EXPECT_NEAR(zones.a + zones.b + zones.c, 115.0 * length, 1e-9);
    for (const double area : {zones.a, zones.b, zones.c}) EXPECT_GE(area, 0.0);
  }
}

// F = dW/d delta, W the energy of zones A and B: the loads are those of a potential.
TEST(Trellis, BiasLoadIsTheSlopeOfTheStoredEnergy) {
  const Card card = load_card("twintex-pw");
  const BiasRectangle rectangle{115.0, 300.0};
  const BiasZones zones = bias_zones(rectangle);
  const auto energy = [&](double travel) {
    const double angle = bias_shear_angle(rectangle, travel);
    return card.thickness * (zones.a * shear_energy(card.shear, log_shear_strain(angle)) +
                             zones.b * shear_energy(card.shear, log_shear_strain(0.5 * angle)));
  };
  for (const double travel : {5.0, 20.0, 50.0}) {
    const double angle = bias_shear_angle(rectangle, travel);
    const auto weights = bias_load_weights(rectangle, card.thickness, angle);
    const double load = weights.full * shear_stress(card.shear, log_shear_strain(angle)) +
                        weights.half * shear_stress(card.shear, log_shear_strain(0.5 * angle));
    const double step = 1e-3;  // mm; central difference, error of its square
    EXPECT_NEAR(load, (energy(travel + step) - energy(travel - step)) / (2.0 * step), 1e-6 * load);
  }
}

}  // namespace
}  // namespace weaveform::identify
