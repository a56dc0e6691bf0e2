#include "post/report/shown_part.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "mesher/exchange/gathered.hpp"

namespace weaveform {
namespace {

using Index = std::array<int, 2>;

class Builder {
public:
  explicit Builder(const Mesh& mesh) : place_(static_cast<std::size_t>(mesh.node_count()), -1) {}

  void add_cell(const std::array<int, 4>& corner, const std::vector<int>& stands_for) {
    std::array<int, 4> shown = {};
    for (std::size_t k = 0; k < 4; ++k) shown[k] = place_of(corner[k] < 0 ? corner[k - 1] : corner[k]);
    part.cell.push_back(shown);
    part.of.insert(part.of.end(), stands_for.begin(), stands_for.end());
    part.first.push_back(static_cast<int>(part.of.size()));
  }
  void add_yarn(std::size_t family, int from, int to) { part.yarn[family].push_back({place_of(from), place_of(to)}); }
  [[nodiscard]] bool is_shown(int node) const { return place_[static_cast<std::size_t>(node)] >= 0; }

  ShownPart part;

private:
  int place_of(int node) {
    int& place = place_[static_cast<std::size_t>(node)];
    if (place < 0) {
      place = static_cast<int>(part.node.size());
      part.node.push_back(node);
    }
    return place;
  }
  std::vector<int> place_;
};

// Full quadrilaterals of a block, by the block's index; a block is whole when it has block^2 of them.
std::map<Index, std::vector<int>> whole_blocks(const Mesh& mesh, int block) {
  std::map<Index, std::vector<int>> blocks;
  for (int c = 0; c < mesh.cells.size(); ++c) {
    const auto& [i, j] = mesh.cells.lattice[c];
    bool full = mesh.cells.offset[c + 1] - mesh.cells.offset[c] == 4;
    for (int k = mesh.cells.offset[c]; k < mesh.cells.offset[c + 1]; ++k)
      full = full && mesh.nodes.crossing[mesh.cells.node[k]][0] >= 0;
    if (full) blocks[{i / block, j / block}].push_back(c);
  }
  std::erase_if(blocks,
                [block](const auto& one) { return one.second.size() != static_cast<std::size_t>(block * block); });
  return blocks;
}

}  // namespace

ShownPart shown_part(const Mesh& mesh, int block) {
  Builder builder(mesh);
  std::vector<bool> is_in_block(static_cast<std::size_t>(mesh.cells.size()), false);
  std::set<std::array<int, 3>> sides;  // family, from, to
  if (block > 1) {
    std::map<Index, int> crossing;
    for (int n = 0; n < mesh.node_count(); ++n)
      if (mesh.nodes.crossing[n][0] >= 0) crossing[mesh.nodes.crossing[n]] = n;
    for (const auto& [at, cells] : whole_blocks(mesh, block)) {
      const int i = at[0] * block, j = at[1] * block;
      const std::array<int, 4> corner = {crossing.at({i, j}), crossing.at({i + block, j}),
                                         crossing.at({i + block, j + block}), crossing.at({i, j + block})};
      builder.add_cell(corner, cells);
      sides.insert({{0, corner[0], corner[1]}, {0, corner[3], corner[2]}});
      sides.insert({{1, corner[0], corner[3]}, {1, corner[1], corner[2]}});
      for (const int c : cells) is_in_block[static_cast<std::size_t>(c)] = true;
    }
  }
  for (const foreign::Shell& shell : foreign::shells_of(mesh.cells))
    if (!is_in_block[static_cast<std::size_t>(shell.cell)]) builder.add_cell(shell.node, {shell.cell});
  for (const auto& [family, from, to] : sides) builder.add_yarn(static_cast<std::size_t>(family), from, to);
  for (int y = 0; y < mesh.yarn_count(); ++y) {
    const auto& [from, to] = mesh.yarns.node[y];
    if (block == 1 || (builder.is_shown(from) && builder.is_shown(to)))
      builder.add_yarn(static_cast<std::size_t>(mesh.yarns.family[y]), from, to);
  }
  return builder.part;
}

}  // namespace weaveform
