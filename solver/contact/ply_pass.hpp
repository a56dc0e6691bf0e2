// The nodes of one ply against the surface of another: where their feet are, and what acts there.
//
// A node whose foot is off the other ply has no spring. At the ply's edge a foot stays on until it has left a whole cell
// by 0.3 of it, for there lies half a yarn more, and plies of one outline would else lose each other at every quiver.
//
// Culling as in contact.hpp: a block of nodes that is clear of the surface is not looked at until both plies can have
// moved so far. Its feet must be searched then, so that one that is clear for a few steps only counts as near. Blocks are looked at in parallel, each in a chunk that has its own list of what the other ply takes,
// and the lists are added in order.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "solver/contact/nearest_facet.hpp"
#include "solver/contact/ply_face.hpp"
#include "solver/contact/ply_kernel.hpp"
#include "solver/contact/ply_surface.hpp"
#include "solver/contact/rounded_edges.hpp"
#include "solver/state/contact_state.hpp"

namespace weaveform {

inline constexpr double cell_border = 1e-6;  // of a cell: a foot goes on to the next one when it is so far out
inline constexpr double no_depth = -std::numeric_limits<double>::infinity();  // mm; of what has no foot

// What the nodes of a chunk give back, per packed node of the other ply (ply_kernel.hpp, PlyGiveBack): zero outside the
// touched segments. Empty until something touches.
struct PlyReturn {
  Doubles force;
  std::vector<char> touched;
};

class PlyPassState {
public:
  // `law`'s tables and both plies must outlive the pass. `swollen`: a ply thickens, and both have a swell.
  PlyPassState(PlyFace& own, const PlyFace& other, const PlyPassLaw& law, double frequency, bool swollen);

  // Finds every node's foot: from where it was when the pass fell asleep, at first from nothing. mm: the least gap
  // between the two, negative inside; with `depths` (per packed node) each one's depth, -infinity where there is none.
  double search(std::vector<double>* depths = nullptr);
  void wake();    // arrays without content, to be read from an archive
  void forget();  // a pass that sleeps keeps nothing but where its feet were
  [[nodiscard]] bool awake() const { return !stiffness_.empty(); }

  // Whether the block can touch now.
  [[nodiscard]] bool is_near(int block) const { return far_[block] <= own_.way + other_.way; }
  // Forces of a block: added to what its nodes take, and to `back`. `inverse_time` as in ply_kernel.hpp. Whether there
  // are any.
  bool look(int block, const BlockFrame& frame, double inverse_time, PlyPull& pull, PlyReturn& back);
  void pass_over(int block) { measured_[block] = 0; }

  // Of all blocks that touched in the last step, in order.
  [[nodiscard]] PlyPassSums sums() const;
  [[nodiscard]] bool any_clear() const;
  // The packed node that is deepest now.
  [[nodiscard]] int deepest() const;

  [[nodiscard]] const PlyFace& own() const { return own_; }
  [[nodiscard]] const PlyFace& other() const { return other_; }
  [[nodiscard]] const PlyPassLaw& law() const { return law_; }

  // Row sums of the springs, N/mm, per packed node of either ply; `stiffest` (MPa/mm) of a measured pressure.
  void add_stiffness_bound(double fabric_frequency, double stiffest, Doubles& own_bound, Doubles& other_bound) const;

  // At a lane, for output.
  [[nodiscard]] double path(int lane) const { return path_[lane]; }
  [[nodiscard]] Vec3 slip(int lane) const;  // mm; zero without a foot
  struct Press {
    double normal = 0.0, tangential = 0.0;  // N
    double pressure = 0.0;                  // MPa
    FrictionState friction = FrictionState::none;
  };
  [[nodiscard]] Press press(int lane) const;

  void archive(Archive& archive);
  void archive_feet(Archive& archive);  // all that one asleep has

private:
  // Feet of a block where the other's surface is rounded.
  struct RoundedFeet {
    int count;
    std::array<int, ply_nodes_at_a_time> node;  // of the block
    std::array<EdgePlace, ply_nodes_at_a_time> edge;
    EdgeFeet at;
  };
  [[nodiscard]] SurfaceFrame frame_at(const SurfacePlace& place) const;
  void round_edges(int block, const PlyPassNodes& nodes, PlyFeet& feet, RoundedFeet& rounded);
  void find_rounded(int block, const PlyPassNodes& nodes, const PlyFeet& feet, RoundedFeet& rounded) const;
  void give_back_rounded(const RoundedFeet& rounded, const PlyPassNodes& nodes, PlyPassForces& forces,
                         PlyReturn& back) const;
  [[nodiscard]] std::vector<Doubles*> numbers();
  void turn_on(int lane, const SurfacePlace& place, double depth);
  void turn_off(int lane);
  void put(int lane, const SurfacePlace& place);
  void set_corner(int lane);
  [[nodiscard]] double reach_at(int lane, const SurfacePlace& place) const;
  [[nodiscard]] double depth_at(int lane, const SurfacePlace& place, const Vec3& normal) const;
  [[nodiscard]] SurfacePlace place_of(int lane) const { return {facet_[lane], place_[0][lane], place_[1][lane]}; }
  [[nodiscard]] SurfacePlace place_found(int lane, std::optional<NearestFacet>& nearest) const;
  [[nodiscard]] bool faces(int lane, const SurfacePlace& place) const;
  [[nodiscard]] bool may_come_back(int lane, const SurfacePlace& place) const;
  [[nodiscard]] bool holds_on(const SurfacePlace& place) const;
  [[nodiscard]] double thickness_sum(int lane, const std::array<int, 4>& corner, const double (&weight)[4]) const;
  void count_off(int block);
  void move_feet(int block, const PlyPassNodes& nodes, PlyFeet& feet, bool tidies);
  void carry_over(int lane, const SurfacePlace& from, const SurfacePlace& to, const Vec2& way);
  [[nodiscard]] SurfacePlace place_again(int lane) const;
  void find_again(int block);
  void find_lost(int block);
  [[nodiscard]] double clearance(int block, double depth, double least) const;
  [[nodiscard]] PlyPassNodes nodes_of(int block, const BlockFrame& frame);
  [[nodiscard]] bool is_on_triangle(int lane) const;
  [[nodiscard]] PlyPassNodes alone(int block, const PlyPassNodes& nodes, int i) const;
  double find_one(int block, const PlyPassNodes& nodes, PlyFeet& feet, int i);
  void press(int block, const PlyPassNodes& nodes, PlyFeet& feet, const RoundedFeet& rounded, double inverse_time,
             PlyPull& pull, PlyReturn& back);
  void make_room(PlyReturn& back) const;

  PlyFace& own_;
  const PlyFace& other_;
  PlyPassLaw law_;
  double frequency_;
  bool swollen_;
  double touch_;  // mm; depth from which something acts

  // per lane
  Doubles stiffness_;  // N/mm; 0 where no node is, or its foot is off the surface
  Doubles on_quads_;   // N/mm; the same, but 0 on triangles, which are looked at one by one
  std::vector<int> facet_;
  std::vector<long> corner_, first_corner_;  // packed node of a quad, 0 on triangles; of either
  std::array<Doubles, 2> place_, anchor_, origin_;
  Doubles depth_, path_;
  Components drag_;
  std::vector<int> origin_facet_;

  // per block
  std::vector<double> far_;  // mm; how far the plies' ways may grow until it can touch
  std::vector<char> clear_, measured_;
  std::vector<int> off_;        // nodes whose feet are off
  std::vector<int> triangles_;  // nodes whose feet are on triangles
  std::vector<PlyPassSums> sums_;
};

}  // namespace weaveform
