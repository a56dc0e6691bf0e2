#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/stack.hpp"

namespace weaveform {

namespace {

constexpr double above_zero = std::numeric_limits<double>::min();

// The lattice is a box around its crossings, which a narrow blank on the bias fills badly; but not this badly.
constexpr std::size_t places_per_node = 1000, places_of_any = 1000000;

struct Numbers {
  const char* what;
  const std::vector<double>& value;
  double least;
};

std::string wrong_numbers(const std::vector<Numbers>& all) {
  for (const Numbers& numbers : all)
    for (std::size_t k = 0; k < numbers.value.size(); ++k)
      if (!(numbers.value[k] >= numbers.least) || !std::isfinite(numbers.value[k]))
        return fmt::format("{} {} is {}", numbers.what, k, numbers.value[k]);
  return "";
}

struct Length {
  const char* what;
  std::size_t size;
};

std::string wrong_lengths(std::size_t wanted, const char* of, const std::vector<Length>& lengths) {
  for (const Length& length : lengths)
    if (length.size != wanted) return fmt::format("{} {}, but {} {}", wanted, of, length.size, length.what);
  return "";
}

// `what` number k names a node that is not there, or one of them twice.
template <class List>
std::string wrong_nodes(const char* what, std::size_t k, const List& list, int nodes) {
  for (auto n = list.begin(); n != list.end(); ++n) {
    if (*n < 0 || *n >= nodes) return fmt::format("{} {} names node {} of {}", what, k, *n, nodes);
    if (std::find(list.begin(), n, *n) != n) return fmt::format("{} {} names node {} twice", what, k, *n);
  }
  return "";
}

template <std::size_t size>
std::string wrong_tuples(const char* what, const std::vector<std::array<double, size>>& list) {
  for (std::size_t k = 0; k < list.size(); ++k)
    for (const double x : list[k])
      if (!std::isfinite(x)) return fmt::format("{} {} has a component that is {}", what, k, x);
  return "";
}

std::string wrong_ties(const Mesh& mesh) {
  for (std::size_t k = 0; k < mesh.tie.size(); ++k) {
    const MeshTie& tie = mesh.tie[k];
    if (!std::isfinite(tie.share)) return fmt::format("the tie of node {} has a share of {}", tie.node, tie.share);
    const std::array<int, 3> named = {tie.node, tie.to[0], tie.to[1]};
    const std::string wrong = wrong_nodes("tie", k, named, mesh.node_count());
    if (!wrong.empty()) return wrong;
  }
  return mesh.frame.present() ? wrong_nodes("frame", 0, mesh.frame.corner, mesh.node_count()) : "";
}

// Sets rise, so that no node is in one twice.
std::string wrong_sets(const Mesh& mesh) {
  for (const NodeSet& set : mesh.sets)
    for (std::size_t k = 0; k < set.node.size(); ++k) {
      if (set.node[k] < 0 || set.node[k] >= mesh.node_count())
        return fmt::format("set '{}' names node {} of {}", set.name, set.node[k], mesh.node_count());
      if (k > 0 && set.node[k] <= set.node[k - 1])
        return fmt::format("the nodes of set '{}' do not rise: {} after {}", set.name, set.node[k], set.node[k - 1]);
    }
  return "";
}

// Lattice indices outside the lattice would send the solver out of its arrays.
std::string wrong_lattice(const Mesh& mesh) {
  const auto [width, height] = mesh.lattice_size;
  const std::size_t nodes = mesh.nodes.position.size();
  if (width < 1 || height < 1 ||
      static_cast<std::size_t>(width) * static_cast<std::size_t>(height) > places_per_node * nodes + places_of_any)
    return fmt::format("a lattice of {} x {} for {} nodes", width, height, nodes);
  std::vector<bool> taken(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), false);
  for (std::size_t n = 0; n < nodes; ++n) {
    const auto& [i, j] = mesh.nodes.crossing[n];
    if (i == -1 && j == -1) continue;
    if (i < 0 || j < 0 || i >= width || j >= height)
      return fmt::format("node {} lies at crossing ({}, {}) of a lattice of {} x {}", n, i, j, width, height);
    const std::size_t place =
        static_cast<std::size_t>(i) + static_cast<std::size_t>(j) * static_cast<std::size_t>(width);
    if (taken[place]) return fmt::format("node {} lies at crossing ({}, {}), where another does", n, i, j);
    taken[place] = true;
  }
  for (std::size_t c = 0; c < mesh.cells.lattice.size(); ++c) {
    const auto& [i, j] = mesh.cells.lattice[c];
    if (i < -1 || j < -1 || i >= width || j >= height)
      return fmt::format("cell {} lies at ({}, {}) of a lattice of {} x {}", c, i, j, width, height);
  }
  return "";
}

}  // namespace

std::string MeshNodes::check() const {
  const std::size_t count = position.size();
  const std::string wrong = wrong_lengths(count, "nodes",
                                          {{"masses", mass.size()},
                                           {"crossings", crossing.size()},
                                           {"flat positions", flat_position.empty() ? count : flat_position.size()}});
  if (!wrong.empty()) return wrong;
  for (const auto& found :
       {wrong_tuples("the position of node", position), wrong_tuples("the flat position of node", flat_position),
        wrong_numbers({{"mass of node", mass, 0.0}})})
    if (!found.empty()) return found;
  return "";
}

std::string MeshYarns::check(int nodes) const {
  const std::string wrong = wrong_lengths(node.size(), "yarn elements",
                                          {{"families", family.size()},
                                           {"rest lengths", rest_length.size()},
                                           {"sections", section.size()},
                                           {"numbers of yarns", yarns.size()},
                                           {"jaws", jaw.size()},
                                           {"softenings", softening.size()}});
  if (!wrong.empty()) return wrong;
  for (std::size_t e = 0; e < node.size(); ++e)
    if (const std::string found = wrong_nodes("yarn element", e, node[e], nodes); !found.empty()) return found;
  return wrong_numbers({{"rest length of yarn element", rest_length, above_zero},
                        {"section of yarn element", section, 0.0},
                        {"number of yarns of element", yarns, 0.0},
                        {"jaw of yarn element", jaw, 0.0},
                        {"softening of yarn element", softening, 0.0}});
}

std::string MeshCells::check(int nodes) const {
  std::string wrong = wrong_lengths(
      area.size(), "cells", {{"offsets after the first", offset.size() - 1}, {"lattice places", lattice.size()}});
  if (wrong.empty()) wrong = wrong_lengths(node.size(), "cell entries", {{"coefficients", coefficient.size()}});
  if (wrong.empty() && (offset.front() != 0 || offset.back() != static_cast<int>(node.size())))
    wrong = fmt::format("the cells' offsets span {} to {}, not 0 to {}", offset.front(), offset.back(), node.size());
  for (std::size_t c = 0; c < area.size() && wrong.empty(); ++c) {
    if (offset[c] < 0 || offset[c + 1] > offset.back()) return fmt::format("cell {} lies outside the entries", c);
    const int count = offset[c + 1] - offset[c];
    if (count < 3 || count > 6) return fmt::format("cell {} has {} nodes", c, count);
    wrong = wrong_nodes("cell", c, std::span(node).subspan(offset[c], count), nodes);
  }
  if (wrong.empty()) wrong = wrong_numbers({{"area of cell", area, above_zero}});
  if (wrong.empty()) wrong = wrong_tuples("the coefficient of cell entry", coefficient);
  return wrong;
}

std::string Mesh::check() const {
  std::string wrong = nodes.check();
  const int count = static_cast<int>(nodes.position.size());
  if (wrong.empty()) wrong = yarns.check(count);
  if (wrong.empty()) wrong = cells.check(count);
  const std::vector<double> whole = {spacing[0], spacing[1], thickness};
  if (wrong.empty()) wrong = wrong_numbers({{"spacing or thickness", whole, above_zero}});
  if (wrong.empty()) wrong = wrong_ties(*this);
  if (wrong.empty()) wrong = wrong_sets(*this);
  if (wrong.empty()) wrong = wrong_lattice(*this);
  if (wrong.empty()) wrong = check_plies(*this);
  return wrong;
}

}  // namespace weaveform
