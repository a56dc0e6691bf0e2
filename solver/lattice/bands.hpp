// How a sweep goes over the lattice: in bands of neighbouring rows, each small enough for its element forces to stay in
// the first cache, and within a band in blocks of eight slots, so that the loops over elements take a band in one call
// and leave no scalar rest. Bands depend on the mesh alone; threads take whole ones.
#pragma once

#include <vector>

#include "solver/state/packed.hpp"

namespace weaveform {

// Numbers per row, row after row: those of row j are item[first[j]] .. item[first[j + 1] - 1].
template <class Item>
struct PerRow {
  std::vector<int> first = {0};
  std::vector<Item> item;
  void end_row() { first.push_back(static_cast<int>(item.size())); }
};

struct Bands {
  std::vector<int> first_row;  // of each band, and at last the number of rows
  // Packed indices of the first slots of blocks, none in two of a kind and none beyond its row's end. Slots between
  // elements, in a block, stand for elements without section or area, between nodes that may coincide; they come to zero.
  PerRow<int> nodes;    // that hold a row's nodes
  PerRow<int> warp;     // its warp elements
  PerRow<int> between;  // the weft elements and cells to the next row
  // Blocks over the slots that assembling reads and none of the above holds: element forces are cleared there before any
  // are computed. The first may begin one slot before its row.
  PerRow<int> warp_gaps;
  PerRow<int> between_gaps;
  int most_slots = 0;  // of one band, gaps included

  [[nodiscard]] int size() const { return static_cast<int>(first_row.size()) - 1; }
};

[[nodiscard]] Bands make_bands(const PackedMesh& packed);

// For `threads` threads, bands of about equal work: thread t has the bands first[t] to first[t + 1] - 1.
[[nodiscard]] std::vector<int> balanced_bands(const Bands& bands, int threads);

}  // namespace weaveform
