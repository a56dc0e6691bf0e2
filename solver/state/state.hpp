// The moving state in the order of PackedMesh: one contiguous, cache-line aligned array per component.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "solver/state/archive.hpp"
#include "solver/state/packed.hpp"

namespace weaveform {

inline constexpr std::align_val_t cache_line{64};

// Aligned to cache lines. Large ones ask the system for large pages, which it gives where it has them
// (/sys/kernel/mm/transparent_hugepage): a row's dozen arrays lie on a dozen small pages otherwise.
[[nodiscard]] void* allocate_lines(std::size_t bytes);

template <class T>
struct CacheLineAllocator {
  using value_type = T;
  CacheLineAllocator() = default;
  template <class U>
  explicit CacheLineAllocator(const CacheLineAllocator<U>& /*other*/) {}
  T* allocate(std::size_t n) { return static_cast<T*>(allocate_lines(n * sizeof(T))); }
  void deallocate(T* p, std::size_t /*n*/) { ::operator delete(p, cache_line); }
  bool operator==(const CacheLineAllocator& /*other*/) const { return true; }
};

using Doubles = std::vector<double, CacheLineAllocator<double>>;
using Components = std::array<Doubles, 3>;

struct State {
  Components position;  // mm
  Components velocity;  // mm/s; half a step behind position (leapfrog)
  Components force;     // N; internal force on each node at `position`
  double time = 0.0;    // s
  std::int64_t step = 0;
};

// Nodes absent from the mesh stand where the node before them in the lattice starts, and never move.
[[nodiscard]] State initial_state(const PackedMesh& packed, const Mesh& mesh);
// Positions, velocities, forces, time (up to `duration`, s) and step.
void archive_state(Archive& archive, State& state, double duration);
[[nodiscard]] std::vector<std::array<double, 3>> mesh_positions(const PackedMesh& packed, const State& state);

}  // namespace weaveform
