#include "solver/contact/crossing_rings.hpp"

#include "mesher/symmetry/cut_part.hpp"

namespace weaveform {
namespace {

// The whole ply's lattice: which node of the part each crossing is or is the image of, and where there are quads.
struct WholeLattice {
  std::array<int, 2> size;
  std::vector<RingCrossing> crossing;
  std::vector<char> quad;  // by its first crossing

  explicit WholeLattice(const Ply& ply)
      : size(ply.whole().lattice_size),
        crossing(static_cast<std::size_t>(size[0]) * size[1]),
        quad(crossing.size(), 0) {
    const Mesh& whole = ply.whole();
    const auto& packed = ply.packed().packed_of_mesh;
    for (int n = 0; n < whole.node_count(); ++n) {
      const auto [i, j] = whole.nodes.crossing[n];
      if (i < 0) continue;
      const PartImage of = ply.part() != nullptr ? ply.part()->image[n] : PartImage{n, 0};
      crossing[number(i, j)] = {packed[of.node], of.planes};
    }
    for (int c = 0; c < whole.cells.size(); ++c)
      if (is_full_quad(whole, c)) quad[number(whole.cells.lattice[c][0], whole.cells.lattice[c][1])] = 1;
  }
  [[nodiscard]] bool has(int i, int j) const { return i >= 0 && j >= 0 && i < size[0] && j < size[1]; }
  [[nodiscard]] std::size_t number(int i, int j) const { return static_cast<std::size_t>(j) * size[0] + i; }
  [[nodiscard]] RingCrossing at(int i, int j) const { return has(i, j) ? crossing[number(i, j)] : RingCrossing{}; }
  [[nodiscard]] unsigned quad_at(int i, int j, unsigned bit) const {
    return has(i, j) && quad[number(i, j)] != 0 ? bit : 0;
  }
};

}  // namespace

CrossingRings::CrossingRings(const Ply& ply)
    : stride_(ply.packed().stride), quads_(ply.packed().lattice_nodes(), 0), special_(quads_.size(), -1) {
  const auto& planes = ply.mesh().symmetry.plane;
  for (unsigned which = 0; which < 1U << planes.size(); ++which) {
    mirror_.push_back(reflection(planes, which));
    Vec3 origin = {0.0, 0.0, 0.0};
    for (std::size_t k = 0; k < planes.size(); ++k)
      if ((which >> k & 1U) != 0) origin = mirrored_point(origin, planes[k]);
    origin_.push_back(origin);
  }
  const WholeLattice lattice(ply);
  for (int n = 0; n < ply.mesh().node_count(); ++n) {
    const auto [i, j] = ply.whole().nodes.crossing[ply.part() != nullptr ? ply.mesh().symmetry.whole_node[n] : n];
    if (i < 0) continue;
    const int node = ply.packed().packed_of_mesh[n];
    quads_[node] =
        static_cast<std::uint8_t>(lattice.quad_at(i - 1, j - 1, south_west) | lattice.quad_at(i, j - 1, south_east) |
                                  lattice.quad_at(i - 1, j, north_west) | lattice.quad_at(i, j, north_east));
    CrossingRing ring{};
    bool plain = true;
    for (int place = 0; place < 9; ++place) {
      const int column = place % 3 - 1, row = place / 3 - 1;
      RingCrossing& at = ring[static_cast<std::size_t>(place)];
      at = lattice.at(i + column, j + row);
      if (at.node < 0 || place == 4) at = {node, 0};
      plain = plain && at.planes == 0 && at.node == node + row * stride_ + column;
    }
    if (plain) continue;
    special_[node] = static_cast<int>(special_ring_.size());
    special_ring_.push_back(ring);
  }
}

}  // namespace weaveform
