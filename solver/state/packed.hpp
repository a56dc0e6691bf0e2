// The mesh as the inner loop sees it: crossings in rows with constant neighbour offsets, cut into runs where the
// outline trims them, and a small general list for the rest (yarn ends and cut cells).
//
//   node (i, j) of the lattice  ->  index j * stride + i ;  yarn ends follow behind the last row
//   warp element (i,j)-(i+1,j), weft element (i,j)-(i,j+1) and cell (i,j) are stored under their first node's index
#pragma once

#include <array>
#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace weaveform {

// Elements begin <= i < end of one lattice row.
struct Run {
  int begin = 0;
  int end = 0;
};

// Runs of every row: row j owns run[first[j]] .. run[first[j+1]-1].
struct RowRuns {
  std::vector<int> first;
  std::vector<Run> run;
};

// Cuts the marked indices of each row (j * stride + i) into runs.
[[nodiscard]] RowRuns runs_of(const std::vector<char>& marked, int stride, int rows);

// Rounded out to whole vectors, so that short rows leave no scalar rest: the elements in between have no section, area
// or yarns, stand between nodes that may coincide, and come to zero. Kernels that take such runs keep their divisors
// above `least_square`.
[[nodiscard]] RowRuns padded_runs(const RowRuns& runs);
[[nodiscard]] Run padded(Run run);
constexpr double least_square = 1e-12;  // mm^2; far below any element's length squared
inline constexpr int vector_width = 8;  // doubles; rows start on a multiple of it

// Yarn elements with an end on the outline (mesh.hpp: jaw, softening). Filled up to whole vectors with what has no
// section, of length 1, from node 0 to node 0; likewise the cells below, without area.
struct LooseYarns {
  std::vector<int> node0, node1;
  std::vector<double> length;   // mm; L0 + jaw
  std::vector<double> jaw;      // mm
  std::vector<double> section;  // mm^2; section * softening
  int count = 0;                // of elements
  [[nodiscard]] int size() const { return count; }
};

// Cells that the outline cuts, padded to six nodes (unused entries: coefficient 0 on the first node).
struct LooseCells {
  static constexpr int width = 6;
  std::vector<std::array<int, width>> node;
  std::vector<std::array<double, width>> warp_coefficient, weft_coefficient;  // 1/mm
  std::vector<double> area;                                                   // mm^2
  int count = 0;                                                              // of cells
  [[nodiscard]] int size() const { return count; }
};

struct PackedMesh {
  int stride = 0;  // doubles per row, a multiple of the vector width
  int rows = 0;    // rows of crossings
  int nodes = 0;   // stride * rows + yarn ends, in whole vectors, and at least one more than the rows
  std::array<double, 2> spacing = {0.0, 0.0};          // mm
  RowRuns node_runs, warp_runs, weft_runs, cell_runs;  // weft and cell runs of row j join rows j and j+1
  std::vector<double> warp_section, weft_section;      // mm^2; per first node, 0 where there is none
  std::vector<double> cell_area;                       // mm^2; per first node
  std::array<LooseYarns, 2> loose_yarns;               // warp, weft
  LooseCells loose_cells;
  std::vector<double> mass;         // tonne; 1 where no node is
  std::vector<int> packed_of_mesh;  // packed index of each mesh node
  [[nodiscard]] int lattice_nodes() const { return stride * rows; }
  // Whether the element from packed node a to b is one of its row's runs.
  [[nodiscard]] bool is_lattice_yarn(int family, int a, int b) const {
    const auto& section = family == 0 ? warp_section : weft_section;
    return a < lattice_nodes() && b - a == (family == 0 ? 1 : stride) && section[a] > 0.0;
  }
  // Range of i that row j's nodes span; {0, 0} when empty.
  [[nodiscard]] Run span(int row) const;
};

// A cell is of the lattice when its nodes are the four crossings around it; its directions are then those of the
// centre.
[[nodiscard]] bool is_full_quad(const Mesh& mesh, int cell);

[[nodiscard]] PackedMesh pack_mesh(const Mesh& mesh);

}  // namespace weaveform
