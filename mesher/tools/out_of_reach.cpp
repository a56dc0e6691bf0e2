#include "mesher/tools/out_of_reach.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesher/tools/tool.hpp"

namespace weaveform {
namespace {

constexpr int places = 65;                // on a tool's way
constexpr std::size_t most_nodes = 2000;  // of the blank looked at, evenly picked: a warning must not take time

struct Cloud {
  std::vector<std::array<double, 3>> point;  // mm
  double spacing = 0.0;                      // mm; between them, about
};

Cloud pick_nodes(const Mesh& mesh) {
  const std::size_t count = mesh.nodes.position.size();
  const std::size_t every = (count + most_nodes - 1) / most_nodes;
  Cloud cloud;
  for (std::size_t n = 0; n < count; n += every) cloud.point.push_back(mesh.nodes.position[n]);
  cloud.spacing = std::max(mesh.spacing[0], mesh.spacing[1]) * std::sqrt(static_cast<double>(every));
  return cloud;
}

// mm; from the fabric's face, negative inside.
double least_gap(const Tool& tool, double way, const Cloud& cloud) {
  Placement place = tool.start;
  for (std::size_t c = 0; c < 3; ++c) place.origin[c] += way * tool.direction[c];
  double least = std::numeric_limits<double>::infinity();
  for (const auto& point : cloud.point) {
    Distances found = {};
    int hint = 0;
    tool_distances(tool, place, {point.data(), &point[1], &point[2]}, 1, &hint, found);
    least = std::min(least, found.distance[0] - tool.offset);
  }
  return least;
}

double extent_of(const Cloud& cloud) {
  double greatest = 0.0;
  for (const auto& p : cloud.point)
    greatest =
        std::max(greatest, std::hypot(p[0] - cloud.point[0][0], p[1] - cloud.point[0][1], p[2] - cloud.point[0][2]));
  return greatest;
}

struct Approach {
  double at_start = 0.0, at_end = 0.0, nearest = 0.0;  // mm
  double way = 0.0;                                    // mm; looked at
  bool leaves = false;                                 // farther from the blank at every place than at the one before
};

bool is_pushed(const ToolSpec& spec) {
  return spec.force.value_or(0.0) > 0.0;
}

Approach approach(const Tool& tool, const ToolSpec& spec, const Cloud& cloud) {
  Approach found;
  found.at_start = found.at_end = found.nearest = least_gap(tool, 0.0, cloud);
  // one that is pushed goes on until it meets something
  found.way = spec.force ? found.at_start + 2.0 * extent_of(cloud) : spec.travel;
  found.leaves = found.way != 0.0;
  for (int k = 1; k < places; ++k) {
    const double gap = least_gap(tool, found.way * k / (places - 1), cloud);
    found.leaves = found.leaves && gap > found.at_end;
    found.at_end = gap;
    found.nearest = std::min(found.nearest, gap);
  }
  return found;
}

// Whether a tool that is pushed finds one at rest on the blank's other side, so that the fabric stays where it is.
bool is_opposed(std::size_t pushed, const std::vector<Tool>& tools, const Scene& scene,
                const std::vector<Approach>& approaches, double slack) {
  for (std::size_t t = 0; t < tools.size(); ++t) {
    const bool rests = scene.tools[t].travel == 0.0 && !is_pushed(scene.tools[t]);
    double along = 0.0;
    for (std::size_t c = 0; c < 3; ++c) along += tools[t].direction[c] * tools[pushed].direction[c];
    if (rests && along < 0.0 && approaches[t].at_start <= slack) return true;
  }
  return false;
}

// mm; how far all tools but one may carry the fabric.
double carried_by_others(std::size_t tool, const std::vector<Tool>& tools, const Scene& scene,
                         const std::vector<Approach>& approaches, const Cloud& cloud) {
  double sum = 0.0;
  for (std::size_t t = 0; t < tools.size(); ++t) {
    if (t == tool) continue;
    if (!is_pushed(scene.tools[t]))
      sum += std::abs(scene.tools[t].travel);
    else if (!is_opposed(t, tools, scene, approaches, 0.5 * cloud.spacing))
      sum += extent_of(cloud);
  }
  return sum;
}

std::string motion_of(const ToolSpec& spec) {
  return is_pushed(spec) ? fmt::format("is pushed by {:g} N", *spec.force)
                         : fmt::format("travels {:g} mm", spec.travel);
}

}  // namespace

std::vector<std::string> tools_out_of_reach(const Scene& scene, const Mesh& mesh, const std::vector<Tool>& tools) {
  const auto travels = [](const GripSpec& grip) { return grip.travel != 0.0; };
  if (scene.tools.empty() || mesh.nodes.position.empty() || scene.frame ||
      scene.analysis.gravity != std::array<double, 3>{0.0, 0.0, 0.0} ||
      std::any_of(scene.grip.begin(), scene.grip.end(), travels))
    return {};
  const Cloud cloud = pick_nodes(mesh);
  std::vector<Approach> approaches;
  for (std::size_t t = 0; t < tools.size(); ++t) approaches.push_back(approach(tools[t], scene.tools[t], cloud));
  std::vector<std::string> lines;
  for (std::size_t t = 0; t < tools.size(); ++t) {
    const ToolSpec& spec = scene.tools[t];
    const Approach& found = approaches[t];
    if (spec.travel == 0.0 && !is_pushed(spec)) continue;
    // between two places and between two points a little more may be met
    const double slack = std::abs(found.way) / (places - 1) + 0.5 * cloud.spacing;
    const double carried = carried_by_others(t, tools, scene, approaches, cloud);
    if (found.leaves && carried <= found.at_start)
      lines.push_back(fmt::format(
          "tool '{}' never touches the fabric: it {} and moves away from it, {:.4g} mm off at the start and "
          "{:.4g} mm at the end; check its direction, and its travel's sign",
          spec.name, motion_of(spec), std::max(found.at_start, 0.0), found.at_end));
    else if (found.nearest > slack + carried)
      lines.push_back(fmt::format(
          "tool '{}' never touches the fabric: it {} and comes no nearer than {:.4g} mm; check its position, direction "
          "and travel",
          spec.name, motion_of(spec), found.nearest));
  }
  return lines;
}

}  // namespace weaveform
