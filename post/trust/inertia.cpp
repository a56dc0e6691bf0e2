#include "post/trust/inertia.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace weaveform {
namespace {

std::vector<std::string> moved_parts(const Scene& scene) {
  std::vector<std::string> names;
  for (const auto& grip : scene.grip) names.push_back(grip.name);
  if (scene.frame) names.push_back(scene.frame->grip);
  for (const auto& tool : scene.tools) names.push_back(tool.name);
  return names;
}

// mJ; S per row.
std::vector<double> weighed_way(const Scene& scene, const History& history) {
  std::vector<double> way(history.row.size(), 0.0);
  for (const std::string& name : moved_parts(scene)) {
    const auto x = history.values(name + ".displacement_mm"), force = history.values(name + ".force_N");
    double greatest = 0.0, sum = 0.0;
    for (const double f : force) greatest = std::max(greatest, std::abs(f));
    for (std::size_t k = 0; k < x.size(); ++k) {
      sum += greatest * std::abs(x[k] - (k == 0 ? 0.0 : x[k - 1]));
      way[k] += sum;
    }
  }
  return way;
}

// mJ; K and what mass-proportional damping took so far, per row.
std::vector<double> given_to_motion(const History& history, double damping) {
  const auto time = history.values("time_s"), kinetic = history.values("kinetic_energy_mJ");
  std::vector<double> energy = kinetic;
  double lost = 0.0;
  for (std::size_t k = 1; k < time.size(); ++k) {
    lost += damping * (kinetic[k] + kinetic[k - 1]) * (time[k] - time[k - 1]);
    energy[k] += lost;
  }
  return energy;
}

}  // namespace

InertiaShare inertia_share(const Scene& scene, const History& history, double damping) {
  InertiaShare greatest;
  const bool moved_otherwise =
      scene.analysis.gravity != std::array{0.0, 0.0, 0.0} || scene.analysis.perturbation != 0.0;
  if (moved_otherwise || history.row.empty()) return greatest;
  const auto way = weighed_way(scene, history), energy = given_to_motion(history, damping);
  const auto time = history.values("time_s");
  const double window = inertia_window * way.back();
  for (std::size_t from = 0, to = 0; window > 0.0 && from < way.size(); ++from) {
    if (way[from] < inertia_begins * way.back()) continue;
    while (to < way.size() && way[to] - way[from] < window) ++to;
    if (to == way.size()) break;
    const double share = (energy[to] - energy[from]) / (way[to] - way[from]);
    if (std::abs(share) > std::abs(greatest.share)) greatest = {share, time[from], time[to]};
  }
  return greatest;
}

}  // namespace weaveform
