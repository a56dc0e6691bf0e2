#include "post/forming/punch_force.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "post/forming/part_axis.hpp"
#include "solver/contact/tool_motion.hpp"

namespace weaveform {
namespace {

constexpr double least_share = 0.01;      // of the run's greatest sum of forces: less is noise over noise
constexpr double same_line = 1.0 - 1e-9;  // cosine between the directions of two tools

struct RowSum {
  double sum = 0.0, size = 0.0;  // N; of the forces along the first tool's direction, and half of their sizes
};

}  // namespace

std::size_t PunchCurve::row_at(double part) const {
  const double wanted = part * travel.back();
  const auto nearest = std::min_element(travel.begin(), travel.end(), [wanted](double a, double b) {
    return std::abs(a - wanted) < std::abs(b - wanted);
  });
  return static_cast<std::size_t>(nearest - travel.begin());
}

std::optional<PunchCurve> punch_curve(const Scene& scene, const History& history) {
  const int number = first_travelling_tool(scene);
  if (number < 0 || history.row.empty()) return {};
  PunchCurve curve;
  curve.punch_number = number;
  curve.punch = scene.tools[number].name;
  curve.travel = history.values(curve.punch + ".displacement_mm");
  for (const auto& tool : scene.tools) {
    curve.tool.push_back(tool.name);
    curve.force.push_back(history.values(tool.name + ".force_N"));
  }
  const auto& force = curve.force[number];
  const auto greatest =
      std::max_element(force.begin(), force.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  curve.greatest = *greatest;
  curve.greatest_at = curve.travel[static_cast<std::size_t>(greatest - force.begin())];
  return curve;
}

std::optional<ForceBalance> force_balance(const Scene& scene, const std::vector<Tool>& tools, const History& history) {
  const bool others = !scene.grip.empty() || scene.frame || scene.analysis.gravity != std::array{0.0, 0.0, 0.0};
  if (tools.size() < 2 || others || history.row.empty()) return {};
  const Eigen::Vector3d line(tools.front().direction.data());
  std::vector<RowSum> row(history.row.size());
  for (const Tool& tool : tools) {
    const double along = line.dot(Eigen::Vector3d(tool.direction.data()));
    if (std::abs(along) < same_line) return {};
    const std::vector<double> force = history.values(tool.name + ".force_N");
    for (std::size_t k = 0; k < row.size(); ++k) {
      row[k].sum += std::copysign(1.0, along) * force[k];
      row[k].size += 0.5 * std::abs(force[k]);
    }
  }
  double greatest_size = 0.0;
  for (const RowSum& r : row) greatest_size = std::max(greatest_size, r.size);
  ForceBalance balance;
  const double begin = force_rise * history.row.back().front();
  for (std::size_t k = 0; k < row.size(); ++k) {
    const double time = history.row[k].front();
    if (time <= begin || row[k].size <= least_share * greatest_size) continue;
    const double difference = std::abs(row[k].sum) / row[k].size;
    if (difference > balance.greatest) balance = {difference, time};
  }
  return balance;
}

}  // namespace weaveform
