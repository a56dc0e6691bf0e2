// The middle surface of a ply as others touch it: the bilinear quads of the lattice and the triangles of the cells that
// the outline cuts.
//
// Every place on it has coordinates (u, v) of the material, which it keeps however the ply moves: those of the lattice,
// crossing (i, j) at u = i, v = j. On a facet they are linear in its own (xi, eta) of ply_kernel.hpp. Who slides over the
// fabric goes from facet to facet by them, without a search.
#pragma once

#include <array>
#include <vector>

#include "core/vector/vector.hpp"
#include "mesher/mesh/mesh.hpp"
#include "solver/state/packed.hpp"
#include "solver/state/state.hpp"

namespace weaveform {

// A place on the surface.
struct SurfacePlace {
  int facet = -1;  // -1: nowhere
  double xi = 0.0, eta = 0.0;
};

// S, and its slopes along xi and eta.
struct SurfaceFrame {
  Vec3 point = {0.0, 0.0, 0.0}, s1 = {0.0, 0.0, 0.0}, s2 = {0.0, 0.0, 0.0};  // mm
};

class PlySurface {
public:
  PlySurface(const Mesh& mesh, const PackedMesh& packed);

  // Facets below lattice_nodes are quads, numbered like their first node, those from there on triangles.
  [[nodiscard]] int facets() const { return lattice_nodes_ + static_cast<int>(triangle_.size()); }
  [[nodiscard]] bool exists(int facet) const { return facet >= lattice_nodes_ || is_quad_[facet] != 0; }
  [[nodiscard]] bool is_triangle(int facet) const { return facet >= lattice_nodes_; }
  // Packed nodes at (0, 0), (1, 0), (0, 1), (1, 1); of a triangle the fourth is the first.
  [[nodiscard]] std::array<int, 4> corners(int facet) const;

  [[nodiscard]] Vec2 material(const SurfacePlace& place) const;                // (u, v)
  [[nodiscard]] SurfacePlace on_facet(int facet, const Vec2& material) const;  // inside it or not
  // A vector of (xi, eta) on one facet as one on another.
  [[nodiscard]] Vec2 carried_over(const Vec2& vector, int from, int to) const;

  // How far the place is out of its facet, in the facet's coordinates; 0 or less inside.
  [[nodiscard]] double outside(const SurfacePlace& place) const;
  // The place itself inside its facet, else one on its edge: of a triangle not quite the nearest.
  [[nodiscard]] SurfacePlace held_inside(const SurfacePlace& place) const;
  // cells; from the place to that one, 0 inside.
  [[nodiscard]] double away(const SurfacePlace& place) const;
  // The facet at these coordinates; nowhere where the ply has none.
  [[nodiscard]] SurfacePlace find(const Vec2& material) const;
  // The same, or the place on the nearest facet within two cells; nowhere beyond.
  [[nodiscard]] SurfacePlace near(const Vec2& material) const;

  [[nodiscard]] SurfaceFrame frame(const SurfacePlace& place, const Components& position) const;
  // Moves the place to where the line through x along `normal` meets the surface around its facet, from facet to facet;
  // where that leads off the ply, the place is on the last one, outside it. False where the line runs along the surface,
  // or the way is too long.
  bool follow(SurfacePlace& place, const Vec3& x, const Vec3& normal, const Components& position) const;

private:
  struct Triangle {
    std::array<int, 3> node;
    Vec2 origin, first, second;  // (u, v) of the first corner, and from it to the other two
  };
  void add_triangles(const Mesh& mesh, const PackedMesh& packed);
  void sort_triangles();
  [[nodiscard]] bool has_quad(int i, int j) const {  // at crossing (i, j)
    return i >= 0 && j >= 0 && i < stride_ && j < rows_ && is_quad_[j * stride_ + i] != 0;
  }
  [[nodiscard]] int square(int i, int j) const;  // -1 outside the table

  int stride_, rows_, lattice_nodes_;
  std::vector<char> is_quad_;
  std::vector<Triangle> triangle_;
  int wide_ = 0, high_ = 0;             // squares of the table below, from (-1, -1) on
  std::vector<int> first_, in_square_;  // triangles that reach into a square
};

}  // namespace weaveform
