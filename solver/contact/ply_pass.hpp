// The nodes of one ply against the surface of another: where their feet are, and what acts there.
//
// A node whose foot is off the other ply has no spring. Feet stay on the cell they are on until they have left it by a
// thousandth, so that none goes back and forth over a line; at the ply's edge until they have left it by a twentieth.
//
// Culling as in contact.hpp: a block of nodes that is clear of the surface is not looked at until both plies can have
// moved so far. Blocks are looked at in parallel, each in a chunk that has its own list of what the other ply takes,
// and the lists are added in order.
#pragma once

#include <array>
#include <vector>

#include "solver/contact/ply_face.hpp"
#include "solver/contact/ply_kernel.hpp"
#include "solver/contact/ply_surface.hpp"

namespace weaveform {

// What the nodes of a chunk give back: zero but from `begin` to `end`.
struct PlyReturn {
  Components force;  // N; per packed node of the other ply; empty until something touches
  int begin = 0, end = 0;
};

class PlyPassState {
public:
  // `law`'s tables must outlive the pass.
  PlyPassState(const PlyFace& own, PlyFace& other, const PlyPassLaw& law, double frequency);

  // Finds every node's foot, from nothing. mm: the least gap between the two, negative inside; with `depths` (per packed
  // node) each one's depth, -infinity where there is none.
  double search(std::vector<double>* depths = nullptr);
  // Gives up what search and look need: a pass that sleeps has no arrays.
  void forget();
  [[nodiscard]] bool awake() const { return !facet_.empty(); }
  void wake();  // arrays without content, to be read from an archive

  // Whether the block can touch now; called before look for each of its blocks at each step.
  [[nodiscard]] bool is_near(int block) const { return far_[block] <= own_.way + other_.way; }
  // Forces of a block: added to own state().force, and to `back`. `inverse_time` as in ply_kernel.hpp.
  void look(int block, const BlockNormals& normals, double inverse_time, bool look_for_lost, PlyReturn& back);
  void pass_over(int block) { measured_[block] = 0; }

  // Of all blocks that touched in the last step, in order.
  [[nodiscard]] PlyPassSums sums() const;
  [[nodiscard]] bool any_clear() const;
  // The node that is deepest now.
  [[nodiscard]] int deepest() const;

  [[nodiscard]] const PlyFace& own() const { return own_; }
  [[nodiscard]] const PlyFace& other() const { return other_; }
  [[nodiscard]] const PlyPassLaw& law() const { return law_; }

  // Row sums of the springs, N/mm, per packed node of either ply; `stiffest` (MPa/mm) of a measured pressure.
  void add_stiffness_bound(double fabric_frequency, double stiffest, Doubles& own_bound, Doubles& other_bound) const;

  // At a node, for output.
  [[nodiscard]] double path(int node) const { return path_[node]; }
  [[nodiscard]] Vec3 slip(int node) const;  // mm; zero without a foot
  struct Press {
    double normal = 0.0, tangential = 0.0;  // N
    double pressure = 0.0;                  // MPa
    FrictionState friction = FrictionState::none;
  };
  [[nodiscard]] Press press(int node) const;

  void archive(Archive& archive);

private:
  void turn_on(int node, const SurfacePlace& place, double depth);
  void turn_off(int node);
  void set_corners(int node);
  [[nodiscard]] double depth_at(int node, const SurfacePlace& place, const Vec3& normal) const;
  [[nodiscard]] SurfacePlace place_of(int node) const { return {facet_[node], place_[0][node], place_[1][node]}; }
  void move_feet(int block);
  void find_again(int block);
  [[nodiscard]] double clearance(int block, double depth) const;
  void give_back(int block, const double (&back)[4][3][ply_nodes_at_a_time], PlyReturn& into) const;
  void find_lost(int block);

  const PlyFace& own_;
  PlyFace& other_;
  PlyPassLaw law_;
  double frequency_;
  double touch_;  // mm; depth from which something acts

  Doubles stiffness_;  // N/mm; 0 where no node is, or its foot is off the surface
  std::vector<int> facet_;
  std::array<std::vector<int>, 4> corner_;
  std::array<Doubles, 2> place_, anchor_;
  Doubles depth_;
  Components drag_;
  Doubles path_, normal_, tangential_;
  std::vector<int> origin_facet_;
  std::array<Doubles, 2> origin_;

  std::vector<double> far_;  // mm; per block: how far the plies' ways may grow until it can touch
  std::vector<char> clear_, measured_;
  std::vector<int> off_;  // nodes of the block whose feet are off
  std::vector<PlyPassSums> sums_;
};

}  // namespace weaveform
