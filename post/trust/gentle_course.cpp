#include "post/trust/gentle_course.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace weaveform {
namespace {

// p; closer to each other where the speed changes most
constexpr std::array course_points = {0.0,     1.0 / 16, 1.0 / 8, 1.0 / 4,   3.0 / 8, 1.0 / 2,
                                      5.0 / 8, 3.0 / 4,  7.0 / 8, 15.0 / 16, 1.0};
constexpr std::size_t last_point = course_points.size() - 1;
using AtPoints = std::array<double, course_points.size()>;

// Of the greatest dp/dt: when the tool is slower, what swings by itself counts for more than what follows.
constexpr double told_from = 0.2;
// Of the greatest mass: where less follows, the tool is hardly at the fabric, and ever faster it would strike it.
constexpr double least_following = 1.0 / 8;
constexpr double risen_at = 5.0 / 8;    // p_m
constexpr double left_over = 1.0 / 16;  // k

struct CourseRow {
  double part = 0.0, rate = 0.0, kinetic = 0.0;  // p, dp/dt in 1/s, mJ
};

std::vector<CourseRow> course_rows(const History& history, const std::string& tool) {
  const auto time = history.values("time_s"), kinetic = history.values("kinetic_energy_mJ");
  const auto way = history.values(tool + ".displacement_mm");
  std::vector<CourseRow> rows;
  if (way.empty() || way.back() == 0.0) return rows;
  for (std::size_t k = 1; k + 1 < way.size(); ++k)
    rows.push_back(
        {way[k] / way.back(), (way[k + 1] - way[k - 1]) / (way.back() * (time[k + 1] - time[k - 1])), kinetic[k]});
  return rows;
}

// tonne mm^2; M at each point but the first and last; 0 where no row tells it, or nothing moves.
AtPoints following_masses(const std::vector<CourseRow>& rows) {
  double fastest = 0.0;
  for (const CourseRow& row : rows) fastest = std::max(fastest, row.rate);
  AtPoints mass{};
  for (std::size_t n = 1; n < last_point; ++n) {
    const double from = 0.5 * (course_points[n - 1] + course_points[n]);
    const double to = 0.5 * (course_points[n] + course_points[n + 1]);
    double energy = 0.0, squares = 0.0;
    for (const CourseRow& row : rows) {
      if (row.part < from || row.part > to || row.rate < told_from * fastest) continue;
      energy += row.kinetic;
      squares += row.rate * row.rate;
    }
    if (squares > 0.0) mass[n] = 2.0 * energy / squares;
  }
  return mass;
}

// What is not known is as at the next point, at the end as at the one before.
void fill_gaps(AtPoints& mass) {
  const double greatest = *std::max_element(mass.begin(), mass.end());
  for (std::size_t n = last_point - 1; n-- > 1;)
    if (mass[n] == 0.0) mass[n] = mass[n + 1];
  for (std::size_t n = 2; n <= last_point; ++n)
    if (mass[n] == 0.0) mass[n] = mass[n - 1];
  for (double& one : mass) one = std::max(one, least_following * greatest);
}

// In parts of the greatest; K(p)/K_m.
double course_energy(double part) {
  return part <= risen_at ? part / risen_at : 1.0 - (1.0 - left_over) * (part - risen_at) / (1.0 - risen_at);
}

double to_three_decimals(double value) {
  return std::round(1e3 * value) / 1e3;
}

}  // namespace

std::vector<std::vector<double>> gentle_course(const History& history, const std::string& tool) {
  auto mass = following_masses(course_rows(history, tool));
  if (!(*std::max_element(mass.begin(), mass.end()) > 0.0)) return {};
  fill_gaps(mass);
  AtPoints speed{}, time{};
  for (std::size_t n = 1; n <= last_point; ++n) speed[n] = std::sqrt(course_energy(course_points[n]) / mass[n]);
  // straight lines between points: dp = (v_n-1 + v_n)/2 dt
  for (std::size_t n = 1; n <= last_point; ++n)
    time[n] = time[n - 1] + 2.0 * (course_points[n] - course_points[n - 1]) / (speed[n - 1] + speed[n]);
  const double fastest = *std::max_element(speed.begin(), speed.end());
  std::vector<std::vector<double>> course;
  for (std::size_t n = 0; n <= last_point; ++n)
    course.push_back({to_three_decimals(time[n] / time[last_point]), to_three_decimals(speed[n] / fastest)});
  return course;
}

}  // namespace weaveform
