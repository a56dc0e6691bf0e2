#include "solver/state/packed.hpp"

#include <algorithm>
#include <cmath>

namespace weaveform {
namespace {

int whole_vectors(int count) {
  return (count + vector_width - 1) / vector_width * vector_width;
}

void index_nodes(const Mesh& mesh, PackedMesh& packed) {
  packed.stride = whole_vectors(mesh.lattice_size[0] + 1);
  packed.rows = mesh.lattice_size[1];
  packed.nodes = packed.lattice_nodes();
  std::vector<char> marked(packed.lattice_nodes(), 0);
  packed.packed_of_mesh.resize(mesh.node_count());
  for (int n = 0; n < mesh.node_count(); ++n) {
    const auto [i, j] = mesh.nodes.crossing[n];
    const int index = i >= 0 ? j * packed.stride + i : packed.nodes++;
    packed.packed_of_mesh[n] = index;
    if (i >= 0) marked[index] = 1;
  }
  packed.nodes = whole_vectors(std::max(packed.nodes, packed.lattice_nodes() + 1));  // a row's padding reads one beyond
  packed.node_runs = runs_of(marked, packed.stride, packed.rows);
  packed.mass.assign(packed.nodes, 1.0);
  for (int n = 0; n < mesh.node_count(); ++n) packed.mass[packed.packed_of_mesh[n]] = mesh.nodes.mass[n];
}

// A yarn element is of the lattice when it joins neighbouring crossings at the regular distance.
bool is_lattice_yarn(const Mesh& mesh, int e) {
  const auto [a, b] = mesh.yarns.node[e];
  const auto& ca = mesh.nodes.crossing[a];
  const auto& cb = mesh.nodes.crossing[b];
  const bool warp = mesh.yarns.family[e] == Family::warp;
  const double length = mesh.spacing[warp ? 0 : 1];
  return ca[0] >= 0 && cb[0] >= 0 && cb[0] - ca[0] == (warp ? 1 : 0) && cb[1] - ca[1] == (warp ? 0 : 1) &&
         mesh.yarns.jaw[e] == 0.0 && mesh.yarns.softening[e] == 1.0 &&
         std::abs(mesh.yarns.rest_length[e] - length) < 1e-9 * length;
}

void place_yarns(const Mesh& mesh, PackedMesh& packed) {
  packed.warp_section.assign(packed.lattice_nodes(), 0.0);
  packed.weft_section.assign(packed.lattice_nodes(), 0.0);
  std::vector<char> warp(packed.lattice_nodes(), 0), weft(packed.lattice_nodes(), 0);
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const int n0 = packed.packed_of_mesh[mesh.yarns.node[e][0]], n1 = packed.packed_of_mesh[mesh.yarns.node[e][1]];
    const bool is_warp = mesh.yarns.family[e] == Family::warp;
    if (is_lattice_yarn(mesh, e)) {
      (is_warp ? packed.warp_section : packed.weft_section)[n0] = mesh.yarns.section[e];
      (is_warp ? warp : weft)[n0] = 1;
      continue;
    }
    if (mesh.yarns.softening[e] == 0.0) continue;  // a tied free end carries nothing
    auto& loose = packed.loose_yarns[is_warp ? 0 : 1];
    loose.node0.push_back(n0);
    loose.node1.push_back(n1);
    loose.length.push_back(mesh.yarns.rest_length[e] + mesh.yarns.jaw[e]);
    loose.jaw.push_back(mesh.yarns.jaw[e]);
    loose.section.push_back(mesh.yarns.section[e] * mesh.yarns.softening[e]);
  }
  for (auto& loose : packed.loose_yarns) {
    loose.count = static_cast<int>(loose.length.size());
    const int whole = whole_vectors(loose.count);
    loose.node0.resize(whole, 0);
    loose.node1.resize(whole, 0);
    loose.length.resize(whole, 1.0);
    loose.jaw.resize(whole, 0.0);
    loose.section.resize(whole, 0.0);
  }
  packed.warp_runs = runs_of(warp, packed.stride, packed.rows);
  packed.weft_runs = runs_of(weft, packed.stride, packed.rows);
}

void place_cells(const Mesh& mesh, PackedMesh& packed) {
  packed.cell_area.assign(packed.lattice_nodes(), 0.0);
  std::vector<char> marked(packed.lattice_nodes(), 0);
  for (int c = 0; c < mesh.cells.size(); ++c) {
    const int begin = mesh.cells.offset[c], end = mesh.cells.offset[c + 1];
    if (is_full_quad(mesh, c)) {
      const int index = mesh.cells.lattice[c][1] * packed.stride + mesh.cells.lattice[c][0];
      packed.cell_area[index] = mesh.cells.area[c];
      marked[index] = 1;
      continue;
    }
    auto& loose = packed.loose_cells;
    std::array<int, LooseCells::width> node{};
    std::array<double, LooseCells::width> warp{}, weft{};
    node.fill(packed.packed_of_mesh[mesh.cells.node[begin]]);
    for (int a = begin; a < end; ++a) {
      node[a - begin] = packed.packed_of_mesh[mesh.cells.node[a]];
      warp[a - begin] = mesh.cells.coefficient[a][0];
      weft[a - begin] = mesh.cells.coefficient[a][1];
    }
    loose.node.push_back(node);
    loose.warp_coefficient.push_back(warp);
    loose.weft_coefficient.push_back(weft);
    loose.area.push_back(mesh.cells.area[c]);
  }
  auto& loose = packed.loose_cells;
  loose.count = static_cast<int>(loose.area.size());
  const int whole = whole_vectors(loose.count);
  loose.node.resize(whole, {});
  loose.warp_coefficient.resize(whole, {});
  loose.weft_coefficient.resize(whole, {});
  loose.area.resize(whole, 0.0);
  packed.cell_runs = runs_of(marked, packed.stride, packed.rows);
}

}  // namespace

RowRuns runs_of(const std::vector<char>& marked, int stride, int rows) {
  RowRuns result;
  for (int j = 0; j < rows; ++j) {
    result.first.push_back(static_cast<int>(result.run.size()));
    const char* row = marked.data() + static_cast<std::size_t>(j) * stride;
    for (int i = 0; i < stride;) {
      if (row[i] == 0) {
        ++i;
        continue;
      }
      const int begin = i;
      while (i < stride && row[i] != 0) ++i;
      result.run.push_back({begin, i});
    }
  }
  result.first.push_back(static_cast<int>(result.run.size()));
  return result;
}

Run padded(Run run) {
  if (run.begin >= run.end) return run;
  return {run.begin / vector_width * vector_width, (run.end + vector_width - 1) / vector_width * vector_width};
}

RowRuns padded_runs(const RowRuns& runs) {
  RowRuns result;
  for (std::size_t j = 0; j + 1 < runs.first.size(); ++j) {
    const auto first = result.run.size();
    result.first.push_back(static_cast<int>(first));
    for (int r = runs.first[j]; r < runs.first[j + 1]; ++r) {
      const Run wide = padded(runs.run[r]);
      if (result.run.size() > first && result.run.back().end >= wide.begin)
        result.run.back().end = wide.end;
      else
        result.run.push_back(wide);
    }
  }
  result.first.push_back(static_cast<int>(result.run.size()));
  return result;
}

bool is_full_quad(const Mesh& mesh, int c) {
  const int begin = mesh.cells.offset[c], count = mesh.cells.offset[c + 1] - begin;
  if (count != 4) return false;
  const auto corner = mesh.cells.lattice[c];
  constexpr int di[4] = {0, 1, 1, 0}, dj[4] = {0, 0, 1, 1};
  for (int a = 0; a < 4; ++a) {
    const auto& crossing = mesh.nodes.crossing[mesh.cells.node[begin + a]];
    if (crossing[0] != corner[0] + di[a] || crossing[1] != corner[1] + dj[a]) return false;
  }
  return true;
}

Run PackedMesh::span(int row) const {
  const int first = node_runs.first[row], last = node_runs.first[row + 1];
  return first == last ? Run{} : Run{node_runs.run[first].begin, node_runs.run[last - 1].end};
}

PackedMesh pack_mesh(const Mesh& mesh) {
  PackedMesh packed;
  packed.spacing = mesh.spacing;
  index_nodes(mesh, packed);
  place_yarns(mesh, packed);
  place_cells(mesh, packed);
  return packed;
}

}  // namespace weaveform
