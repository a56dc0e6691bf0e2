// The course of a tool that starts and stops gently, from histories made up so that the answer is known.
#include "post/trust/gentle_course.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/error.hpp"
#include "solver/constraint/grips.hpp"

namespace weaveform {
namespace {

constexpr int course_history_rows = 400;

// A punch that makes 50 mm in 0.2 s by the smooth step and moves a mass (tonne mm^2) that depends on the part of its way.
History followed(const std::function<double(double)>& mass) {
  History history{{"time_s", "punch.displacement_mm", "kinetic_energy_mJ"}, {}};
  for (int n = 0; n <= course_history_rows; ++n) {
    const double x = static_cast<double>(n) / course_history_rows, part = smooth_step(x);
    const double rate = 30.0 * x * x * (1.0 - x) * (1.0 - x) / 0.2;
    history.row.push_back({0.2 * x, 50.0 * part, 0.5 * mass(part) * rate * rate});
  }
  return history;
}

// Part of the way at each point of the table.
std::vector<double> parts_of(const std::vector<std::vector<double>>& course) {
  std::vector<double> parts = {0.0};
  for (std::size_t n = 1; n < course.size(); ++n)
    parts.push_back(parts.back() + 0.5 * (course[n][1] + course[n - 1][1]) * (course[n][0] - course[n - 1][0]));
  for (double& part : parts) part /= parts.back();
  return parts;
}

// K(p)/K_m, and of a mass that stays the same the speed: it rises evenly over the time 2 p_m and falls, evenly too, over
// 2 (1 - p_m)/(1 + sqrt(k)) of it.
double energy_at(double part) {
  return part <= 0.625 ? part / 0.625 : 1.0 - 15.0 / 16.0 * (part - 0.625) / 0.375;
}
double speed_at(double time) {
  const double rise = 2.0 * 0.625, fall = 2.0 * 0.375 / 1.25, top = rise / (rise + fall);
  return time <= top ? time / top : 1.0 - 0.75 * (time - top) / (1.0 - top);
}

TEST(GentleCourse, OfAMassThatStaysTheSameGrowsAndFallsEvenlyInTime) {
  const auto course = gentle_course(followed([](double) { return 1e-3; }), "punch");
  ASSERT_GT(course.size(), 5u);
  for (const auto& point : course) EXPECT_NEAR(point[1], speed_at(point[0]), 2e-3) << point[0];
}

// dK/dp is the same all over the rise and all over the fall, whatever the mass. Tables have three decimals, and a point's
// mass is the mean over its neighbourhood.
TEST(GentleCourse, GivesKineticEnergyThatRisesAndFallsEvenlyAlongTheWay) {
  const auto mass = [](double part) { return 1e-3 * (0.2 + part); };
  const auto course = gentle_course(followed(mass), "punch");
  const auto part = parts_of(course);
  double greatest = 0.0;
  for (std::size_t n = 0; n < course.size(); ++n)
    greatest = std::max(greatest, mass(part[n]) * course[n][1] * course[n][1]);
  for (std::size_t n = 0; n < course.size(); ++n)
    EXPECT_NEAR(mass(part[n]) * course[n][1] * course[n][1] / greatest, energy_at(part[n]), 0.03) << part[n];
}

TEST(GentleCourse, IsATableThatASceneMayHave) {
  for (const double power : {0.0, 1.0, 2.0, 6.0}) {
    const auto course = gentle_course(followed([&](double part) { return 1e-3 * std::pow(part, power); }), "punch");
    EXPECT_EQ(course.front(), (std::vector{0.0, 0.0}));
    EXPECT_EQ(course.back()[0], 1.0);
    EXPECT_LT(course.back()[1], 0.26);  // a quarter, of the speed with that mass
    for (std::size_t n = 1; n < course.size(); ++n) EXPECT_GT(course[n][0], course[n - 1][0]);
    EXPECT_TRUE(std::any_of(course.begin(), course.end(), [](const auto& point) { return point[1] == 1.0; }));
  }
}

// The tool comes to the fabric after five sixteenths of its way, where the share of one point ends and the next begins.
TEST(GentleCourse, OfAGapIsThatOfTheFabricBehindIt) {
  const auto course = gentle_course(followed([](double part) { return part < 0.3125 ? 0.0 : 1e-3; }), "punch");
  for (const auto& point : course) EXPECT_NEAR(point[1], speed_at(point[0]), 2e-3) << point[0];
}

TEST(GentleCourse, IsNoneWhereNothingMoves) {
  EXPECT_TRUE(gentle_course(followed([](double) { return 0.0; }), "punch").empty());
  History still = followed([](double) { return 1.0; });
  for (auto& row : still.row) row[1] = 0.0;
  EXPECT_TRUE(gentle_course(still, "punch").empty());
  EXPECT_THROW((void)gentle_course(still, "die"), InputError);
}

}  // namespace
}  // namespace weaveform
