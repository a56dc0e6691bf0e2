#include "mesher/mesh/stack.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace weaveform {
namespace {

constexpr int rows_between = 2;  // of lattices; cells at an edge may begin at row -1

void add_nodes(const Mesh& own, int first_row, bool with_flat, Mesh& stack) {
  for (int n = 0; n < own.node_count(); ++n) {
    std::array<int, 2> crossing = own.nodes.crossing[n];
    if (crossing[0] >= 0) crossing[1] += first_row;
    stack.nodes.add(own.nodes.position[n], own.nodes.mass[n], crossing);
    if (with_flat) stack.nodes.flat_position.push_back(own.flat_positions()[n]);
  }
}

void add_elements(const Mesh& own, const MeshPly& at, Mesh& stack) {
  for (int e = 0; e < own.yarn_count(); ++e) {
    MeshYarn yarn = own.yarns.at(e);
    for (int& n : yarn.node) n += at.first_node;
    stack.yarns.add(yarn);
  }
  for (int c = 0; c < own.cells.size(); ++c) {
    const int begin = own.cells.offset[c], end = own.cells.offset[c + 1];
    std::vector<int> node(own.cells.node.begin() + begin, own.cells.node.begin() + end);
    for (int& n : node) n += at.first_node;
    const auto& [i, j] = own.cells.lattice[c];
    stack.cells.add(node, {own.cells.coefficient.begin() + begin, own.cells.coefficient.begin() + end},
                    own.cells.area[c], {i, j + at.first_row});
  }
  for (const MeshTie& tie : own.tie)
    stack.tie.push_back({tie.node + at.first_node, {tie.to[0] + at.first_node, tie.to[1] + at.first_node}, tie.share});
}

void add_sets(const Mesh& own, int first_node, Mesh& stack) {
  for (const NodeSet& set : own.sets) {
    auto found = std::find_if(stack.sets.begin(), stack.sets.end(),
                              [&](const NodeSet& other) { return other.name == set.name; });
    if (found == stack.sets.end()) found = stack.sets.insert(stack.sets.end(), {set.name, {}});
    for (const int n : set.node) found->node.push_back(n + first_node);
  }
}

Range range_of(const Mesh& stack, std::size_t ply, int MeshPly::*first, int count) {
  if (stack.ply.empty()) return {0, count};
  return {stack.ply[ply].*first, ply + 1 < stack.ply.size() ? stack.ply[ply + 1].*first : count};
}

std::vector<int> numbers(const Mesh& stack, int MeshPly::*first, int count) {
  std::vector<int> number(count, 0);
  for (std::size_t k = 1; k < stack.ply.size(); ++k) {
    const Range range = range_of(stack, k, first, count);
    std::fill(number.begin() + range.first, number.begin() + range.last, static_cast<int>(k));
  }
  return number;
}

// The frame with its corners `by` nodes further on.
MeshFrame moved(MeshFrame frame, int by) {
  if (frame.present())
    for (int& corner : frame.corner) corner += by;
  return frame;
}

int tie_count(const Mesh& mesh) {
  return static_cast<int>(mesh.tie.size());
}

}  // namespace

Mesh joined_mesh(const std::vector<NamedMesh>& plies) {
  Mesh stack;
  stack.spacing = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  stack.thickness = std::numeric_limits<double>::infinity();
  const bool with_flat = std::any_of(plies.begin(), plies.end(),
                                     [](const NamedMesh& ply) { return !ply.mesh->nodes.flat_position.empty(); });
  int row = 0;
  for (const auto& [name, mesh] : plies) {
    const Mesh& own = *mesh;
    const MeshPly at{.name = name,
                     .first_node = stack.node_count(),
                     .first_yarn = stack.yarn_count(),
                     .first_cell = stack.cells.size(),
                     .first_tie = tie_count(stack),
                     .first_row = row,
                     .spacing = own.spacing,
                     .lattice_size = own.lattice_size,
                     .thickness = own.thickness,
                     .frame = moved(own.frame, stack.node_count())};
    add_nodes(own, row, with_flat, stack);
    add_elements(own, at, stack);
    add_sets(own, at.first_node, stack);
    for (std::size_t f = 0; f < 2; ++f) stack.spacing[f] = std::min(stack.spacing[f], own.spacing[f]);
    stack.thickness = std::min(stack.thickness, own.thickness);
    stack.lattice_size = {std::max(stack.lattice_size[0], own.lattice_size[0]), row + own.lattice_size[1]};
    stack.ply.push_back(at);
    row += own.lattice_size[1] + rows_between;
  }
  return stack;
}

Mesh ply_mesh(const Mesh& stack, std::size_t ply) {
  const MeshPly& at = stack.ply[ply];
  const Range nodes = nodes_of_ply(stack, ply), yarns = yarns_of_ply(stack, ply), cells = cells_of_ply(stack, ply);
  Mesh own;
  for (int n = nodes.first; n < nodes.last; ++n) {
    std::array<int, 2> crossing = stack.nodes.crossing[n];
    if (crossing[0] >= 0) crossing[1] -= at.first_row;
    own.nodes.add(stack.nodes.position[n], stack.nodes.mass[n], crossing);
    if (!stack.nodes.flat_position.empty()) own.nodes.flat_position.push_back(stack.nodes.flat_position[n]);
  }
  for (int e = yarns.first; e < yarns.last; ++e) {
    MeshYarn yarn = stack.yarns.at(e);
    for (int& n : yarn.node) n -= nodes.first;
    own.yarns.add(yarn);
  }
  for (int c = cells.first; c < cells.last; ++c) {
    const int begin = stack.cells.offset[c], end = stack.cells.offset[c + 1];
    std::vector<int> node(stack.cells.node.begin() + begin, stack.cells.node.begin() + end);
    for (int& n : node) n -= nodes.first;
    const auto& [i, j] = stack.cells.lattice[c];
    own.cells.add(node, {stack.cells.coefficient.begin() + begin, stack.cells.coefficient.begin() + end},
                  stack.cells.area[c], {i, j - at.first_row});
  }
  const Range ties = range_of(stack, ply, &MeshPly::first_tie, tie_count(stack));
  for (int t = ties.first; t < ties.last; ++t) {
    const MeshTie& tie = stack.tie[t];
    own.tie.push_back({tie.node - nodes.first, {tie.to[0] - nodes.first, tie.to[1] - nodes.first}, tie.share});
  }
  for (const NodeSet& set : stack.sets) {
    NodeSet part{set.name, {}};
    for (const int n : set.node)
      if (n >= nodes.first && n < nodes.last) part.node.push_back(n - nodes.first);
    if (!part.node.empty()) own.sets.push_back(std::move(part));
  }
  own.spacing = at.spacing;
  own.lattice_size = at.lattice_size;
  own.thickness = at.thickness;
  own.frame = moved(at.frame, -nodes.first);
  own.first_shown = at.first_node;
  return own;
}

Range nodes_of_ply(const Mesh& stack, std::size_t ply) {
  return range_of(stack, ply, &MeshPly::first_node, stack.node_count());
}
Range yarns_of_ply(const Mesh& stack, std::size_t ply) {
  return range_of(stack, ply, &MeshPly::first_yarn, stack.yarn_count());
}
Range cells_of_ply(const Mesh& stack, std::size_t ply) {
  return range_of(stack, ply, &MeshPly::first_cell, stack.cells.size());
}

std::vector<int> ply_of_nodes(const Mesh& stack) {
  return numbers(stack, &MeshPly::first_node, stack.node_count());
}
std::vector<int> ply_of_yarns(const Mesh& stack) {
  return numbers(stack, &MeshPly::first_yarn, stack.yarn_count());
}
std::vector<int> ply_of_cells(const Mesh& stack) {
  return numbers(stack, &MeshPly::first_cell, stack.cells.size());
}

// Elements and ties of a ply name its own nodes only; its crossings lie in its own rows.
std::string check_plies(const Mesh& stack) {
  const auto rises = [&](int MeshPly::*first, int count) {
    int least = 0;
    for (const MeshPly& ply : stack.ply) {
      if (ply.*first < least || ply.*first > count) return false;
      least = ply.*first;
    }
    return stack.ply.front().*first == 0;
  };
  if (stack.ply.empty()) return "";
  if (!rises(&MeshPly::first_node, stack.node_count()) || !rises(&MeshPly::first_yarn, stack.yarn_count()) ||
      !rises(&MeshPly::first_cell, stack.cells.size()) || !rises(&MeshPly::first_tie, tie_count(stack)) ||
      !rises(&MeshPly::first_row, stack.lattice_size[1]))
    return "the plies' first nodes, elements, ties or rows do not rise from 0 on";
  for (std::size_t k = 0; k < stack.ply.size(); ++k) {
    const MeshPly& ply = stack.ply[k];
    const Range nodes = nodes_of_ply(stack, k), yarns = yarns_of_ply(stack, k), cells = cells_of_ply(stack, k);
    const Range ties = range_of(stack, k, &MeshPly::first_tie, tie_count(stack));
    const auto is_own = [&](int n) { return n >= nodes.first && n < nodes.last; };
    bool own = nodes.first < nodes.last && cells.first < cells.last;
    for (int e = yarns.first; e < yarns.last; ++e)
      own = own && is_own(stack.yarns.node[e][0]) && is_own(stack.yarns.node[e][1]);
    for (int entry = stack.cells.offset[cells.first]; entry < stack.cells.offset[cells.last]; ++entry)
      own = own && is_own(stack.cells.node[entry]);
    for (int t = ties.first; t < ties.last; ++t)
      own = own && is_own(stack.tie[t].node) && is_own(stack.tie[t].to[0]) && is_own(stack.tie[t].to[1]);
    if (ply.frame.present()) own = own && std::all_of(ply.frame.corner.begin(), ply.frame.corner.end(), is_own);
    if (!own) return fmt::format("ply {} ('{}') is empty or names nodes of another", k, ply.name);
    if (const std::string wrong = ply_mesh(stack, k).check(); !wrong.empty())
      return fmt::format("ply {} ('{}'): {}", k, ply.name, wrong);
  }
  return "";
}

}  // namespace weaveform
