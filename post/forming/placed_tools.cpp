#include "post/forming/placed_tools.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace weaveform {
namespace {

double at_time(const History& history, const std::vector<double>& value, double time) {
  if (history.row.empty()) throw InputError("history has no row; solve again");
  const auto later = std::find_if(history.row.begin(), history.row.end(),
                                  [time](const std::vector<double>& row) { return row.front() >= time; });
  if (later == history.row.end()) return value.back();
  const auto k = static_cast<std::size_t>(later - history.row.begin());
  if (k == 0) return value.front();
  const double from = history.row[k - 1].front(), to = later->front();
  return value[k - 1] + (time - from) / (to - from) * (value[k] - value[k - 1]);
}

}  // namespace

std::vector<PlacedTool> place_tools(const std::vector<Tool>& tools, const History& history, double time) {
  std::vector<PlacedTool> placed;
  const std::vector<Vec3> moved = displacements(tools, history, time);
  for (std::size_t t = 0; t < tools.size(); ++t) {
    placed.push_back({tools[t], tools[t].start});
    for (std::size_t c = 0; c < 3; ++c) placed.back().place.origin[c] += moved[t][c];
  }
  return placed;
}

std::vector<Vec3> displacements(const std::vector<Tool>& tools, const History& history, double time) {
  std::vector<Vec3> moved;
  for (const Tool& tool : tools)
    moved.push_back(scaled(tool.direction, at_time(history, history.values(tool.name + ".displacement_mm"), time)));
  return moved;
}

Gap gap_to(const PlacedTool& tool, const Eigen::Vector3d& x) {
  Distances found;
  int hint = 0;
  tool_distances(tool.tool, tool.place, {&x[0], &x[1], &x[2]}, 1, &hint, found);
  return {found.distance[0] - tool.tool.offset, {found.normal[0][0], found.normal[1][0], found.normal[2][0]}};
}

int nearest_tool(const std::vector<PlacedTool>& tools, const Eigen::Vector3d& x) {
  int nearest = -1;
  double least = 0.0;
  for (std::size_t t = 0; t < tools.size(); ++t) {
    const double gap = gap_to(tools[t], x).gap;
    if (nearest >= 0 && gap >= least) continue;
    nearest = static_cast<int>(t);
    least = gap;
  }
  return nearest;
}

}  // namespace weaveform
