#include "solver/result/beside.hpp"

#include <algorithm>
#include <iterator>

namespace weaveform {

namespace {

// Cells at each node, in rising order.
struct CellsAtNodes {
  std::vector<int> offset;
  std::vector<int> cell;
};

CellsAtNodes cells_at_nodes(const Mesh& mesh) {
  CellsAtNodes at;
  at.offset.assign(mesh.node_count() + 1, 0);
  for (const int node : mesh.cells.node) ++at.offset[node + 1];
  for (int node = 0; node < mesh.node_count(); ++node) at.offset[node + 1] += at.offset[node];
  at.cell.resize(mesh.cells.node.size());
  std::vector<int> next(at.offset.begin(), at.offset.end() - 1);
  for (int cell = 0; cell < mesh.cells.size(); ++cell)
    for (int entry = mesh.cells.offset[cell]; entry < mesh.cells.offset[cell + 1]; ++entry)
      at.cell[next[mesh.cells.node[entry]]++] = cell;
  return at;
}

}  // namespace

CellsBeside cells_beside_yarns(const Mesh& mesh) {
  const CellsAtNodes at = cells_at_nodes(mesh);
  const auto first = [&](int node) { return at.cell.begin() + at.offset[node]; };
  const auto last = [&](int node) { return at.cell.begin() + at.offset[node + 1]; };
  CellsBeside beside;
  beside.offset.reserve(mesh.yarn_count() + 1);
  beside.cell.reserve(2 * static_cast<std::size_t>(mesh.yarn_count()));
  for (const auto& [a, b] : mesh.yarns.node) {
    std::set_intersection(first(a), last(a), first(b), last(b), std::back_inserter(beside.cell));
    if (beside.cell.size() == static_cast<std::size_t>(beside.offset.back()))
      std::set_union(first(a), last(a), first(b), last(b), std::back_inserter(beside.cell));
    beside.offset.push_back(static_cast<int>(beside.cell.size()));
  }
  return beside;
}

std::vector<double> mean_on_yarns(const CellsBeside& beside, const std::vector<double>& on_cells) {
  std::vector<double> mean(beside.offset.size() - 1, 0.0);
  for (std::size_t yarn = 0; yarn < mean.size(); ++yarn) {
    const int begin = beside.offset[yarn], end = beside.offset[yarn + 1];
    for (int k = begin; k < end; ++k) mean[yarn] += on_cells[beside.cell[k]];
    if (end > begin) mean[yarn] /= end - begin;
  }
  return mean;
}

std::vector<double> mean_on_cells(const CellsBeside& beside, const std::vector<double>& on_yarns, int cell_count) {
  std::vector<double> mean(cell_count, 0.0);
  std::vector<int> yarns(cell_count, 0);
  for (std::size_t yarn = 0; yarn < on_yarns.size(); ++yarn)
    for (int k = beside.offset[yarn]; k < beside.offset[yarn + 1]; ++k) {
      mean[beside.cell[k]] += on_yarns[yarn];
      ++yarns[beside.cell[k]];
    }
  for (int cell = 0; cell < cell_count; ++cell)
    if (yarns[cell] > 0) mean[cell] /= yarns[cell];
  return mean;
}

}  // namespace weaveform
