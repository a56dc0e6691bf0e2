// What cells with a history (element/incremental_cell.hpp) remember: one array per member of CellHistory.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "mesher/scene/scene.hpp"
#include "solver/lattice/law_shapes.hpp"
#include "solver/state/packed.hpp"
#include "solver/state/state.hpp"

namespace weaveform {

// The histories of all cells of one kind, at the last two calls: read from one, written to the other.
class HistoryStore {
public:
  void allocate(int cells) {
    for (auto& side : side_)
      for (auto& array : side) array.assign(cells, 0.0);
  }
  void swap() { std::swap(side_[0], side_[1]); }
  [[nodiscard]] std::array<Doubles, cell_history_size>& current() { return side_[0]; }
  [[nodiscard]] HistoryArrays arrays() {
    HistoryArrays result{};
    for (int k = 0; k < cell_history_size; ++k) {
      result.before[k] = side_[0][k].data();
      result.after[k] = side_[1][k].data();
    }
    return result;
  }
  // Those of the row at `offset` are written to `spare`.
  [[nodiscard]] HistoryArrays arrays_beside(int offset, std::vector<Doubles>& spare) {
    HistoryArrays result = arrays();
    for (int k = 0; k < cell_history_size; ++k) result.after[k] = spare[k].data();
    result.after_origin = offset;
    return result;
  }

private:
  std::array<std::array<Doubles, cell_history_size>, 2> side_;
};

struct CellHistories {
  HistoryStore lattice, listed;
};

// Histories that begin with the directions of the start state and, where a cell starts sheared, with the stress of its
// angle (element/sheared_start.hpp). `thickness` in mm.
[[nodiscard]] CellHistories start_histories(const PackedMesh& packed, const ShearLawShape& shear,
                                            const ModelSpec& model, double thickness, const State& start);

}  // namespace weaveform
