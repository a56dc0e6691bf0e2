#include "solver/lattice/bands.hpp"

#include <algorithm>

#include "solver/state/row_blocks.hpp"

namespace weaveform {
namespace {

// Computed in one call; twelve arrays of element forces take 24 kB of them.
constexpr int slots_of_a_band = 256;

using Marks = std::vector<char>;  // per slot of a row

Marks marked_runs(const RowRuns& runs, int j, int stride) {
  Marks marks(stride, 0);
  for (int r = runs.first[j]; r < runs.first[j + 1]; ++r)
    for (int i = runs.run[r].begin; i < runs.run[r].end; ++i) marks[i] = 1;
  return marks;
}

void mark_all(Marks& marks, const Marks& others) {
  for (std::size_t i = 0; i < marks.size(); ++i) marks[i] = static_cast<char>(marks[i] != 0 || others[i] != 0);
}

// Blocks from the first marked slot on that none holds yet; the last ones draw back from the row's end, for no mark
// stands in a row's last slots without room for a block before them.
std::vector<int> cover(const Marks& marks) {
  std::vector<int> blocks;
  const int size = static_cast<int>(marks.size());
  for (int i = 0; i < size;) {
    if (marks[i] == 0) {
      ++i;
      continue;
    }
    blocks.push_back(i);
    i += vector_width;
  }
  int limit = size;
  for (std::size_t b = blocks.size(); b-- > 0;) {
    blocks[b] = std::min(blocks[b], limit - vector_width);
    limit = blocks[b];
  }
  return blocks;
}

Marks held_by(const std::vector<int>& blocks, int stride) {
  Marks marks(stride, 0);
  for (const int first : blocks) std::fill_n(marks.begin() + first, vector_width, 1);
  return marks;
}

void append(const std::vector<int>& blocks, int start, PerRow<int>& to) {
  for (const int first : blocks) to.item.push_back(start + first);
  to.end_row();
}

// What assembling the nodes held by `nodes` reads of the row: their own slots and those before. Index 0 is the slot
// before the row's first.
Marks read_by(const Marks& nodes) {
  Marks read(nodes.size() + 1, 0);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i] != 0) read[i] = read[i + 1] = 1;
  return read;
}

void append_gaps(const Marks& read, const Marks& held, int start, PerRow<int>& gaps) {
  const int size = static_cast<int>(read.size());
  for (int i = 0; i < size;) {
    const bool is_gap = read[i] != 0 && (i == 0 || held[i - 1] == 0);
    if (is_gap) gaps.item.push_back(start + i - 1);
    i += is_gap ? vector_width : 1;
  }
  gaps.end_row();
}

}  // namespace

Bands make_bands(const PackedMesh& packed) {
  Bands bands;
  const auto nodes_of = [&](int j) {
    return j < packed.rows ? cover(marked_runs(packed.node_runs, j, packed.stride)) : std::vector<int>{};
  };
  auto nodes = nodes_of(0);
  for (int j = 0; j < packed.rows; ++j) {
    const int start = j * packed.stride;
    append(nodes, start, bands.nodes);
    const Marks here = held_by(nodes, packed.stride);
    const auto warp = cover(marked_runs(packed.warp_runs, j, packed.stride));
    append(warp, start, bands.warp);
    append_gaps(read_by(here), held_by(warp, packed.stride), start, bands.warp_gaps);

    Marks elements = marked_runs(packed.weft_runs, j, packed.stride);
    mark_all(elements, marked_runs(packed.cell_runs, j, packed.stride));
    const auto between = cover(elements);
    append(between, start, bands.between);
    nodes = nodes_of(j + 1);
    Marks read = read_by(here);
    mark_all(read, read_by(held_by(nodes, packed.stride)));
    append_gaps(read, held_by(between, packed.stride), start, bands.between_gaps);
  }
  int slots = 0;
  for (int j = 0; j < packed.rows; ++j) {
    const int row_slots = vector_width * (bands.nodes.first[j + 1] - bands.nodes.first[j]);
    if (bands.first_row.empty() || slots + row_slots > slots_of_a_band) {
      bands.first_row.push_back(j);
      slots = 0;
    }
    slots += row_slots;
  }
  bands.first_row.push_back(packed.rows);
  for (int b = 0; b < bands.size(); ++b)
    bands.most_slots = std::max(bands.most_slots, (bands.first_row[b + 1] - bands.first_row[b]) * packed.stride);
  return bands;
}

std::vector<int> balanced_bands(const Bands& bands, int threads) {
  std::vector<int> blocks;
  for (int b = 0; b < bands.size(); ++b)
    blocks.push_back(bands.nodes.first[bands.first_row[b + 1]] - bands.nodes.first[bands.first_row[b]]);
  return balanced_shares(blocks, threads);
}

}  // namespace weaveform
