#include "post/trust/pushed_tools.hpp"

#include <algorithm>
#include <cmath>

#include "solver/contact/tool_motion.hpp"

namespace weaveform {
namespace {

constexpr double onset = 2.0 * force_rise;  // of the duration
constexpr double without = 0.01;            // of the force; a tool that gives less has lost the fabric

bool something_travels(const Scene& scene) {
  const auto travels = [](const auto& part) { return part.travel != 0.0; };
  return std::any_of(scene.grip.begin(), scene.grip.end(), travels) ||
         std::any_of(scene.tools.begin(), scene.tools.end(), travels) || (scene.frame && scene.frame->travel != 0.0);
}

PushedTool look_at(const ToolSpec& spec, const History& history, std::size_t first, double mass, double border) {
  const auto time = history.values("time_s"), felt = history.values(spec.name + ".force_N"),
             way = history.values(spec.name + ".displacement_mm");
  PushedTool found;
  for (std::size_t k = first; k < time.size(); ++k) {
    const double off = std::abs(felt[k] - *spec.force) / *spec.force,
                 share = 1.0 / static_cast<double>(time.size() - first);
    if (off > border) found.share_off += share;
    if (felt[k] < without * *spec.force) found.share_free += share;
    if (off < found.off) continue;
    found.off = off;
    found.time = time[k];
    found.felt = felt[k];
    const std::size_t before = k == 0 ? 0 : k - 1, after = std::min(k + 1, time.size() - 1);
    if (after > before) found.viscous = spec.damping * mass * (way[after] - way[before]) / (time[after] - time[before]);
  }
  return found;
}

}  // namespace

std::vector<PushedTool> pushed_tools(const Scene& scene, const History& history, double free_mass, double border) {
  std::vector<PushedTool> found;
  if (history.row.empty()) return found;
  const double end = history.row.back().front();
  const auto begun = std::find_if(history.row.begin(), history.row.end(),
                                  [end](const std::vector<double>& row) { return row.front() > onset * end; });
  const std::size_t first =
      something_travels(scene) ? static_cast<std::size_t>(begun - history.row.begin()) : history.row.size() - 1;
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    const ToolSpec& spec = scene.tools[t];
    if (!spec.force || *spec.force <= 0.0) continue;
    found.push_back(look_at(spec, history, first, spec.mass.value_or(free_mass), border));
    found.back().tool = static_cast<int>(t);
  }
  return found;
}

}  // namespace weaveform
