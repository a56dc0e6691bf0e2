// A ply as contact with others knows it: its surface, its nodes that can touch, and their normals.
#pragma once

#include <string>
#include <vector>

#include "solver/contact/ply_kernel.hpp"
#include "solver/contact/ply_law.hpp"
#include "solver/contact/ply_surface.hpp"
#include "solver/ply/ply.hpp"

namespace weaveform {

// Normals of the nodes of a block.
struct BlockNormals {
  alignas(64) double n[3][ply_nodes_at_a_time];
};

class PlyFace {
public:
  PlyFace(Ply& ply, std::string name);

  [[nodiscard]] Ply& ply() const { return ply_; }
  [[nodiscard]] State& state() const { return ply_.state(); }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const PlySurface& surface() const { return surface_; }
  [[nodiscard]] const TouchingPly& touching() const { return touching_; }
  [[nodiscard]] const Doubles& mass() const { return mass_; }  // tonne; 0 where no node is, or it follows others
  [[nodiscard]] const Doubles& area() const { return area_; }  // mm^2
  [[nodiscard]] const std::vector<NodeArms>& arms() const { return arms_; }
  [[nodiscard]] int nodes() const { return static_cast<int>(mass_.size()); }
  [[nodiscard]] int blocks() const { return (nodes() + ply_nodes_at_a_time - 1) / ply_nodes_at_a_time; }
  [[nodiscard]] int block_size(int block) const;
  [[nodiscard]] int shown_node(int packed) const { return mesh_of_packed_[packed]; }  // for messages

  [[nodiscard]] Vec3 position(int node) const;
  [[nodiscard]] Vec3 normal(int node) const;  // of any length
  void normals(int block, BlockNormals& normals) const;
  // mm/s; greatest speed of the block's nodes.
  [[nodiscard]] double speed(int block) const;

  double way = 0.0;  // mm; no node has moved further since the start

private:
  Ply& ply_;
  std::string name_;
  PlySurface surface_;
  std::vector<NodeArms> arms_;
  std::vector<int> irregular_, first_irregular_;  // nodes whose arms are not their lattice neighbours; per block
  std::vector<std::vector<Vec3>> flat_;           // per packed node in a mirror plane: the planes' normals
  Doubles mass_, area_;
  std::vector<int> mesh_of_packed_;
  TouchingPly touching_;
};

}  // namespace weaveform
