#include "mesher/mesh/mesh_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

namespace weaveform {

namespace {

constexpr double above_zero = std::numeric_limits<double>::min();

// The lattice is a box around its crossings, which a narrow blank on the bias fills badly; but not this badly.
constexpr std::size_t places_per_node = 1000, places_of_any = 1000000;

struct Check {
  const char* what;
  const std::vector<double>& value;
  double least;
};

std::string wrong_numbers(const Mesh& mesh) {
  const MeshYarns& yarns = mesh.yarns;
  const std::vector<double> whole = {mesh.spacing[0], mesh.spacing[1], mesh.thickness};
  const std::vector<Check> checks = {{"rest length of yarn element", yarns.rest_length, above_zero},
                                     {"section of yarn element", yarns.section, 0.0},
                                     {"number of yarns of element", yarns.yarns, 0.0},
                                     {"jaw of yarn element", yarns.jaw, 0.0},
                                     {"softening of yarn element", yarns.softening, 0.0},
                                     {"area of cell", mesh.cells.area, above_zero},
                                     {"mass of node", mesh.nodes.mass, 0.0},
                                     {"spacing or thickness", whole, above_zero}};
  for (const Check& check : checks)
    for (std::size_t k = 0; k < check.value.size(); ++k)
      if (!(check.value[k] >= check.least) || !std::isfinite(check.value[k]))
        return fmt::format("{} {} is {}", check.what, k, check.value[k]);
  return "";
}

template <std::size_t size>
std::string wrong_tuples(const char* what, const std::vector<std::array<double, size>>& list) {
  for (std::size_t k = 0; k < list.size(); ++k)
    for (const double x : list[k])
      if (!std::isfinite(x)) return fmt::format("{} {} has a component that is {}", what, k, x);
  return "";
}

std::string wrong_shares(const Mesh& mesh) {
  for (const MeshTie& tie : mesh.tie)
    if (!std::isfinite(tie.share)) return fmt::format("the tie of node {} has a share of {}", tie.node, tie.share);
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

std::string what_is_wrong(const Mesh& mesh) {
  for (const auto& wrong :
       {wrong_numbers(mesh), wrong_tuples("the position of node", mesh.nodes.position),
        wrong_tuples("the flat position of node", mesh.nodes.flat_position),
        wrong_tuples("the coefficient of cell entry", mesh.cells.coefficient), wrong_shares(mesh), wrong_lattice(mesh)})
    if (!wrong.empty()) return wrong;
  return "";
}

}  // namespace weaveform
