#include "post/trust/chords.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "post/forming/fabric_surface.hpp"

namespace weaveform {
namespace {

using Eigen::Vector3d;

constexpr std::array<double, 3> looked_at = {0.25, 0.5, 0.75};  // parts of a chord; an edge need not lie at its middle

void keep_worse(CutChord& worst, const CutChord& found) {
  if (found.depth > 0.0 && found.ratio() > worst.ratio()) worst = found;
}

// The tool's surface seen from the fabric: gaps at nodes and at any other point.
struct Seen {
  const PlacedTool& tool;
  int number;
  double lift;              // 1; of a chord's length
  std::vector<double> gap;  // mm; per node
  Seen(const PlacedTool& the_tool, int its_number, const std::vector<Vec3>& position, bool curved)
      : tool(the_tool), number(its_number), lift(curved ? lifted_share : 0.0) {
    for (const Vec3& x : position) gap.push_back(gap_to(tool, vector_of(x)).gap);
  }
  [[nodiscard]] double sunk(int node) const { return std::max(0.0, -gap[node]); }
  template <class Nodes>
  [[nodiscard]] bool touches(const Nodes& nodes, double length) const {
    return std::any_of(nodes.begin(), nodes.end(), [&](int n) { return gap[n] <= lift * length; });
  }
};

CutChord along_yarn(const Seen& seen, const std::vector<Vec3>& position, double thickness,
                    const std::array<int, 2>& node) {
  const Vector3d a = vector_of(position[node[0]]), b = vector_of(position[node[1]]);
  CutChord found{seen.number, a, (b - a).norm(), 0.0, false};
  for (const double part : looked_at) {
    const Vector3d x = (1.0 - part) * a + part * b;
    const double sunk = (1.0 - part) * seen.sunk(node[0]) + part * seen.sunk(node[1]);
    const double depth = -gap_to(seen.tool, x).gap - sunk;
    if (depth <= found.depth) continue;
    found.depth = depth;
    found.at = x;
  }
  found.unnoticed = found.depth > thickness && !seen.touches(node, found.length);
  return found;
}

CutChord across_cell(const Seen& seen, const std::vector<Vec3>& position, double thickness,
                     const std::array<int, 4>& node) {
  Vector3d middle = Vector3d::Zero();
  double sunk = 0.0, side = 0.0;
  for (int a = 0; a < 4; ++a) {
    middle += 0.25 * vector_of(position[node[a]]);
    sunk += 0.25 * seen.sunk(node[a]);
    side += 0.25 * (vector_of(position[node[(a + 1) % 4]]) - vector_of(position[node[a]])).norm();
  }
  const double depth = -gap_to(seen.tool, middle).gap - sunk;
  return {seen.number, middle, side, 0.5 * depth, depth > thickness && !seen.touches(node, side)};
}

}  // namespace

double CutChord::ratio() const {
  if (tool < 0) return 0.0;
  if (unnoticed) return 2.0;
  const double q = depth / length;
  return 8.0 * q / (1.0 + 4.0 * q * q);
}

double CutChord::radius() const {
  return tool < 0 ? std::numeric_limits<double>::infinity() : length / ratio();
}

CutChord worst_chord(const Mesh& mesh, const std::vector<Vec3>& position, const std::vector<PlacedTool>& tools,
                     bool curved) {
  CutChord worst;
  for (std::size_t t = 0; t < tools.size(); ++t) {
    const Seen seen(tools[t], static_cast<int>(t), position, curved);
    // a distance changes no faster than points move: an end half a chord away leaves no middle in the tool
    const auto near = [&](int a, int b) {
      const double length = (vector_of(position[a]) - vector_of(position[b])).norm();
      return std::min(seen.gap[a], seen.gap[b]) < length;
    };
    for (int e = 0; e < mesh.yarn_count(); ++e) {
      const auto& node = mesh.yarns.node[e];
      if (mesh.yarns.softening[e] != 0.0 && near(node[0], node[1]))
        keep_worse(worst, along_yarn(seen, position, mesh.thickness, node));
    }
    for (int c = 0; c < mesh.cells.size(); ++c) {
      const int begin = mesh.cells.offset[c];
      if (mesh.cells.offset[c + 1] - begin != 4) continue;
      const int* node = mesh.cells.node.data() + begin;
      if (near(node[0], node[2]))
        keep_worse(worst, across_cell(seen, position, mesh.thickness, {node[0], node[1], node[2], node[3]}));
    }
  }
  return worst;
}

}  // namespace weaveform
