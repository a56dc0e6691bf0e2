// A ply as contact with others knows it: its surface, its nodes that can touch, and their normals.
//
// Only nodes with a mass touch; they go in blocks of neighbours in a row, each padded to whole vectors. What contact keeps
// of every node lies in one array by block: block b owns entries at .. at + lanes - 1, of which the first `count` are its
// nodes, first .. first + count - 1 in the packed order.
#pragma once

#include <string>
#include <vector>

#include "solver/contact/ply_arms.hpp"
#include "solver/contact/ply_kernel.hpp"
#include "solver/contact/ply_law.hpp"
#include "solver/contact/ply_surface.hpp"
#include "solver/contact/rounded_edges.hpp"
#include "solver/contact/sheared_thickness.hpp"
#include "solver/ply/ply.hpp"

namespace weaveform {

struct PlyBlock {
  int first = 0, count = 0;
  int at = 0, lanes = 0;
};

// Places and normals of the nodes of a block.
struct BlockFrame {
  const double* x[3];  // mm
  PlyNormals normals;
  alignas(64) double copy[3][ply_nodes_at_a_time];  // of places, where the state's own array ends too early
};

class PlyFace {
public:
  // `sheared`: how the ply thickens (sheared_thickness.hpp); null: not at all.
  PlyFace(Ply& ply, std::string name, ShearedThickness* sheared = nullptr);

  [[nodiscard]] Ply& ply() const { return ply_; }
  [[nodiscard]] State& state() const { return ply_.state(); }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const PlySurface& surface() const { return surface_; }
  [[nodiscard]] const RoundedEdges& edges() const { return edges_; }
  [[nodiscard]] RoundedEdges& edges() { return edges_; }
  [[nodiscard]] const TouchingPly& touching() const { return touching_; }
  [[nodiscard]] bool thickens() const { return sheared_ != nullptr; }
  [[nodiscard]] ShearedThickness* sheared() const { return sheared_; }
  // Where another ply thickens: w and dE/dw per packed node, of a ply that does not 1 and of no consequence.
  void make_swell();
  [[nodiscard]] const Doubles& swell() const { return thickens() ? sheared_->swell() : even_swell_; }
  [[nodiscard]] Doubles& load() { return thickens() ? sheared_->load() : even_load_; }
  [[nodiscard]] int nodes() const { return ply_.packed().nodes; }
  [[nodiscard]] const std::vector<PlyBlock>& blocks() const { return blocks_; }
  [[nodiscard]] int lanes() const { return static_cast<int>(area_.size()); }
  [[nodiscard]] int lane_of(int packed) const { return lane_of_[packed]; }  // -1: does not touch
  [[nodiscard]] int node_of(int lane) const { return node_of_[lane]; }      // packed; -1: padding
  [[nodiscard]] const Doubles& mass() const { return mass_; }               // tonne; per lane, 0 where no node is
  [[nodiscard]] const Doubles& area() const { return area_; }               // mm^2; likewise
  [[nodiscard]] const NodeArms& arms(int packed) const { return arms_.of(packed); }
  // Cuts the blocks into parts that one thread takes at a time: all but the first begin at these.
  void set_chunks(std::vector<int> first_blocks);
  // The lanes at the ends of a node's arms, -1 where there is none, it is the node itself, or another chunk's: who asks in
  // the middle of a step would find it as it was or as it is.
  [[nodiscard]] std::array<int, 4> lanes_beside(int lane) const;
  [[nodiscard]] int shown_node(int packed) const { return mesh_of_packed_[packed]; }  // for messages

  [[nodiscard]] Vec3 position(int packed) const;
  [[nodiscard]] Vec3 normal(int packed) const;  // of any length
  // a and b; in a mirror plane as both sides have them.
  [[nodiscard]] std::array<Vec3, 2> between_neighbours(int packed) const;
  void frame(int block, BlockFrame& frame) const;
  // mm/s; greatest speed of the block's nodes.
  [[nodiscard]] double speed(int block) const;

  // What a block takes of all its passes: forces on its nodes at once, those on their neighbours (G_a and G_b,
  // ply_kernel.hpp) when those of all blocks are there: a part of the nodes then takes its forces from them, and the
  // whole ply the rest.
  void take(int block, const BlockFrame& frame, const PlyPull& pull);
  void take_nothing(int block);  // levers of the step before are gone
  [[nodiscard]] bool has_levers() const;
  void take_levers(int first, int end);
  void take_irregular_levers();

  double way = 0.0;  // mm; no node has moved further since the start

private:
  void make_blocks();
  void find_irregular();

  Ply& ply_;
  std::string name_;
  ShearedThickness* sheared_;
  Doubles even_swell_, even_load_;
  PlySurface surface_;
  RoundedEdges edges_;
  PlyArms arms_;
  std::vector<int> irregular_, first_irregular_;  // nodes whose arms are not their lattice neighbours; per block
  std::array<Doubles, 6> lever_;                  // N; a row before and behind the packed nodes', 0 at irregular nodes
  std::vector<std::array<double, 6>> irregular_lever_;  // N
  std::vector<char> has_levers_;                        // per block; above 0 somewhere
  std::vector<PlyBlock> blocks_;
  std::vector<int> chunk_at_;  // lanes at which all chunks but the first begin
  std::vector<int> lane_of_, node_of_;
  Doubles mass_, area_;
  std::vector<int> mesh_of_packed_;
  TouchingPly touching_;
};

}  // namespace weaveform
