#include "mesher/resolve/drape_stack.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "mesher/resolve/of_ply.hpp"
#include "mesher/resolve/stack.hpp"
#include "mesher/tools/tool.hpp"

namespace weaveform {
namespace {

// mm; from the tool: how near and how far a draped ply comes with its nodes and the middles of its cells, which are
// chords of the tool.
struct Standing {
  double least = std::numeric_limits<double>::infinity(), greatest = -std::numeric_limits<double>::infinity();
};

Standing standing_of(const Tool& tool, const MeshCells& cells, const std::vector<std::array<double, 3>>& position) {
  Standing found;
  int hint = 0;
  const auto look = [&](const std::array<double, 3>& x) {
    if (std::isnan(x[0])) return;  // it has no place
    Distances here;
    tool_distances(tool, tool.start, {x.data(), &x[1], &x[2]}, 1, &hint, here);
    found.least = std::min(found.least, here.distance[0]);
    found.greatest = std::max(found.greatest, here.distance[0]);
  };
  for (const auto& x : position) look(x);
  for (int c = 0; c < cells.size(); ++c) look(cell_centre(cells, c, position));
  return found;
}

const Tool& draped_tool(const std::vector<Tool>& tools, const std::string& name) {
  return *std::find_if(tools.begin(), tools.end(), [&](const Tool& tool) { return tool.name == name; });
}

DrapedPly draped_at(const Resolved& ply, double off) {
  DrapedPly laid{.off = off, .tools = ply.tools, .drape = {}};
  for (Tool& tool : laid.tools)
    if (tool.name == ply.scene.drape->tool) tool.offset = off;
  laid.drape = drape_blank(ply.scene, ply.mesh, laid.tools);
  return laid;
}

// The numbers of the plies, from the one on the tool on.
std::vector<std::size_t> from_the_tool(const Resolved& model) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < model.ply.size(); ++k) order.push_back(k);
  if (model.scene.drape->projection[2] > 0.0) std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace

// The way of a chord changes little with the distance, so that a few looks find it.
std::vector<DrapedPly> drape_plies(const Resolved& model) {
  constexpr int looks = 4;
  constexpr double room = 1e-3;  // of a thickness
  const std::string& name = model.scene.drape->tool;
  const std::vector<std::size_t> order = from_the_tool(model);
  std::vector<DrapedPly> laid(order.size());
  double before = 0.0;  // mm; how far the ply before comes from the tool
  for (std::size_t n = 0; n < order.size(); ++n) {
    const std::size_t k = order[n];
    const Resolved& ply = model.ply[k];
    const Tool& tool = draped_tool(ply.tools, name);
    const auto standing = [&] { return standing_of(tool, ply.mesh.cells, laid[k].drape.position); };
    const double least = n == 0 ? 0.0 : before + distance_between(model, std::min(k, order[n - 1]));
    const double step = room * ply.card.thickness;
    of_ply(model, k, [&] { laid[k] = draped_at(ply, n == 0 ? tool.offset : least); });
    for (int look = 0; look < looks && n > 0; ++look) {
      const double lacking = least - standing().least;
      if (lacking <= step) break;
      of_ply(model, k, [&] { laid[k] = draped_at(ply, laid[k].off + lacking + step); });
    }
    before = standing().greatest;
  }
  return laid;
}

void drape_stack(Resolved& model) {
  const std::vector<DrapedPly> laid = drape_plies(model);
  for (const std::size_t k : from_the_tool(model))
    of_ply(model, k, [&] { lay_drape(model.ply[k].scene, laid[k].drape, model.ply[k].mesh); });
  join_plies(model);
}

}  // namespace weaveform
