// A tool that moves and never touches forms nothing, whatever the run's numbers look like.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "mesher/tools/tool.hpp"
#include "post/forming/placed_tools.hpp"
#include "post/trust/borders.hpp"

namespace weaveform {
namespace {

double gap_between(const PlacedTool& tool, const std::vector<Vec3>& position) {
  double least = std::numeric_limits<double>::max();
  for (const Vec3& x : position) least = std::min(least, gap_to(tool, {x[0], x[1], x[2]}).gap);
  return least;
}

}  // namespace

void warn_of_idle_tools(const FinishedRun& run, Warnings& warnings) {
  const bool any = std::any_of(run.scene.tools.begin(), run.scene.tools.end(), [](const ToolSpec& tool) {
    return tool.travel != 0.0 || tool.force.value_or(0.0) > 0.0;
  });
  if (!any) return;
  std::vector<PlacedTool> placed;
  for (std::size_t t = 0; t < run.scene.tools.size(); ++t) {
    const ToolSpec& spec = run.scene.tools[t];
    const bool pushed = spec.force.value_or(0.0) > 0.0;
    if ((spec.travel == 0.0 && !pushed) || run.history.index(spec.name + ".contact_area_mm2") < 0) continue;
    const auto area = run.history.values(spec.name + ".contact_area_mm2");
    if (std::any_of(area.begin(), area.end(), [](double a) { return a > 0.0; })) continue;
    if (placed.empty()) placed = place_tools(run.tools, run.history, run.end.time);
    const double at_end = gap_between(placed[t], run.end.position);
    PlacedTool start = placed[t];
    start.place = start.tool.start;
    const double at_start = gap_between(start, run.mesh.nodes.position);
    warnings.push_back(fmt::format(
        "tool '{}' never touches the fabric: it {}{} {:.4g} mm off at the start and {:.4g} mm at the end; check its "
        "position, direction and {}",
        spec.name, pushed ? "is pushed" : "moves", at_end > at_start ? " away," : ", and is", at_start, at_end,
        pushed ? "force" : "travel"));
  }
}

}  // namespace weaveform
