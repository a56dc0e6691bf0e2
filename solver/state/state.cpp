#include "solver/state/state.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <bit>
#include <cstdint>

namespace weaveform {

void* allocate_lines(std::size_t bytes) {
  void* memory = ::operator new(bytes, cache_line);
#ifdef MADV_HUGEPAGE
  constexpr std::size_t large_page = std::size_t{1} << 21;
  constexpr std::uintptr_t page = 4096;
  if (bytes >= 2 * large_page) {
    const auto from = (std::bit_cast<std::uintptr_t>(memory) + page - 1) / page * page;
    const auto end = (std::bit_cast<std::uintptr_t>(memory) + bytes) / page * page;
    (void)madvise(std::bit_cast<void*>(from), end - from, MADV_HUGEPAGE);  // a wish: whoever refuses it costs time only
  }
#endif
  return memory;
}

namespace {

// A node that does not exist stands with the node before it in the row, so that no block of nodes is wider than its
// fabric (contact judges blocks as a whole).
void place_absent(const PackedMesh& packed, State& state) {
  std::vector<char> exists(packed.nodes, 0);
  for (const int n : packed.packed_of_mesh) exists[n] = 1;
  const int first = *std::min_element(packed.packed_of_mesh.begin(), packed.packed_of_mesh.end());
  for (int n = 0, before = first; n < packed.nodes; ++n) {
    if (exists[n] != 0) before = n;
    for (auto& component : state.position) component[n] = component[before];
  }
}

}  // namespace

State initial_state(const PackedMesh& packed, const Mesh& mesh) {
  State state;
  for (int c = 0; c < 3; ++c) {
    state.position[c].assign(packed.nodes, 0.0);
    state.velocity[c].assign(packed.nodes, 0.0);
    state.force[c].assign(packed.nodes, 0.0);
    for (int n = 0; n < mesh.node_count(); ++n) state.position[c][packed.packed_of_mesh[n]] = mesh.nodes.position[n][c];
  }
  place_absent(packed, state);
  return state;
}

void archive_state(Archive& archive, State& state, double duration) {
  constexpr std::int64_t most_steps = std::int64_t{1} << 53;
  for (auto& component : state.position) archive.numbers("a position", component);
  for (auto& component : state.velocity) archive.numbers("a velocity", component);
  for (auto& component : state.force) archive.numbers("a force", component);
  archive.number("a time", state.time, {0.0, duration});
  archive.count("a number of steps", state.step, 0, most_steps);
}

std::vector<std::array<double, 3>> mesh_positions(const PackedMesh& packed, const State& state) {
  std::vector<std::array<double, 3>> result(packed.packed_of_mesh.size());
  for (std::size_t n = 0; n < result.size(); ++n)
    for (int c = 0; c < 3; ++c) result[n][c] = state.position[c][packed.packed_of_mesh[n]];
  return result;
}

}  // namespace weaveform
