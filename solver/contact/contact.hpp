// Contact of a ply's nodes, on both faces, with the scene's rigid tools (rigid_tools.hpp).
//
// Stiffness and step. Every node has k = omega^2 m with omega^2 a small share of the fabric's own greatest omega^2, so
// that k is a fixed part of m/step^2: stiff enough for penetrations of a few per cent of the thickness, yet together
// with its damping worth only some per cent of the step (add_stiffness_bound says exactly how much).
//
// Culling. Nodes go in groups of a vector's width; for each group and tool a clearance is kept that the group cannot have
// used up yet: the least gap when last measured less the greatest way of its nodes and of the tool since. A distance
// changes no faster than points move, so a group with clearance left touches nothing, and nothing more is computed; of
// those whose distances are, only what touches or did so at the step before has forces. Groups go in blocks, which
// threads share.
//
// A ply that thickens as it shears (model.contact_thickness, sheared_thickness.hpp) has its faces w times as far from its
// middle plane, and groups have less clearance by what w has grown.
//
// Blocks are summed in order: the same bits for any number of threads.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/contact/contact_kernel.hpp"
#include "solver/contact/curved_contact.hpp"
#include "solver/contact/rigid_tools.hpp"
#include "solver/contact/sheared_thickness.hpp"
#include "solver/state/actor.hpp"
#include "solver/state/contact_state.hpp"
#include "solver/state/packed.hpp"
#include "solver/state/team.hpp"

namespace weaveform {

// Of the fabric's greatest omega^2. A node of a fabric under tension sinks in by e h^2/(R s) at yarn strain e, spacing
// h and tool radius R, with s = 4 * share the stiffness against that of a yarn element: at 1 % strain less than half of
// what its chord cuts off the circle anyway, h^2/(8 R), and like that a matter of h^2.
inline constexpr double contact_stiffness_share = 0.05;
// Where the step follows the strains that yarns reach (reach.hpp), contact as stiff as that would set it. Half the
// stiffness sinks a node in by as much as its chord cuts off.
inline constexpr double contact_stiffness_reached = 0.5;

// 1/s; omega of the springs of a fabric whose own stable step is `fabric_step` (s).
[[nodiscard]] double contact_frequency(const AnalysisSpec& analysis, double fabric_step);

class Contact : public Actor {
public:
  // `ply` says how it hangs on its springs, `own` the tools with this ply's distance from them where it is not theirs,
  // `sheared` how it thickens (null: not at all). Throws InputError when the fabric starts inside a tool.
  Contact(const Mesh& mesh, const PackedMesh& packed, const State& start, const SprungPly& ply, RigidTools& tools,
          Team& team, const std::vector<Tool>* own = nullptr, ShearedThickness* sheared = nullptr);

  [[nodiscard]] std::string name() const override { return "contact"; }
  // The tools stand at state.time. Throws PhysicsError when a node has gone through a tool's surface by more than the
  // fabric's thickness.
  void add_forces(State& state, double step) override;
  void add_stiffness_bound(const std::vector<Vec3>& position, double fabric_frequency,
                           std::vector<double>& bound) const override;
  void archive(Archive& archive) override;

  // Of the last add_forces, in the order of the tools. (Their energies and works are told by RigidTools.)
  [[nodiscard]] const std::vector<ToolLoad>& loads() const { return loads_; }
  // Per mesh node, at the positions of the last add_forces (contact_state.hpp).
  [[nodiscard]] ContactState contact_state(const State& state) const;
  [[nodiscard]] double wall_s() const { return wall_s_; }  // spent in add_forces by this program

private:
  // What contact knows of the ply at one tool.
  struct Touch {
    ContactLaw law;
    Components anchor;              // mm; tool's frame
    Components drag;                // N; of the dampers, at the last step
    std::vector<double> clearance;  // mm; per group, > 0 where nothing can touch
    std::vector<char> held;         // per group: a node touched in the last add_forces
    std::vector<char> measured;     // per block, in the last add_forces
    std::vector<ContactSums> sums;  // per block, valid where measured
    std::vector<double> depth;      // mm; per block, greatest penetration, valid where measured
    std::vector<int> hint;          // per node, of triangles
    Components measured_at;         // mm; per node, of triangles: where its distance was last measured,
    Doubles far;                    // mm; that distance plus the tool's way so far then (-inf: never)
    CurvedContact::Memory curved;   // empty without
  };
  [[nodiscard]] Touch make_touch(const Tool& tool, double offset) const;
  void refuse_penetration(const State& start) const;
  void find_held(Touch& touch) const;
  // What a block's nodes have in common for all tools, found when the first one wants it.
  struct Common {
    double speed = -1.0;  // mm/s; greatest of its nodes
    ChordTurns turns;     // of the groups
    unsigned turned = 0;  // that have this bit
  };
  void treat_block(int block, State& state, double step);
  void treat_tool(std::size_t tool, int block, State& state, double step, Common& common);
  ContactGroups near_groups(Touch& touch, const MovingTool& tool, int first, const ContactNodes& nodes, double step,
                            Common& common) const;
  void measure(Touch& touch, const MovingTool& tool, const ContactNodes& nodes, int first, const ContactGroups& groups,
               Distances& distances) const;
  static void keep_touching(const Touch& touch, int first, double (&gap)[groups_in_block], double lift,
                            ContactGroups& groups);
  void lift(const Touch& touch, const State& state, int first, int count, const ContactGroups& groups, Common& common,
            Distances& distances, ChordTerms& terms) const;
  void triangle_distances(Touch& touch, const MovingTool& tool, const ContactNodes& nodes, int first,
                          const ContactGroups& groups, Distances& distances) const;
  static void sum_blocks(const Touch& touch, bool moved, ToolLoad& load);
  void check(std::size_t tool, const State& state) const;
  [[nodiscard]] ContactNodes block_nodes(int block, Touch& touch, State& state) const;
  [[nodiscard]] int group_count() const;
  [[nodiscard]] int block_count() const;
  void add_swollen_bound(const std::vector<Vec3>& position, double rate, std::vector<double>& bound) const;
  [[nodiscard]] double offset_at(const Touch& touch, int packed) const {  // mm
    return sheared_ == nullptr ? touch.law.offset : touch.law.offset * sheared_->swell()[packed];
  }

  const Mesh& mesh_;
  const PackedMesh& packed_;
  Team& team_;
  RigidTools& tools_;
  ShearedThickness* sheared_;
  double thickness_;  // mm
  double frequency_;  // 1/s; omega of the contact
  Doubles mass_;      // tonne; 0 where no node is
  Doubles area_;      // mm^2; of the fabric around each node
  std::vector<int> mesh_of_packed_;
  std::vector<int> part_;  // first block of each part that a thread takes at a time, and their number
  std::optional<CurvedContact> curved_;
  std::vector<Touch> touch_;     // one for each tool
  std::vector<ToolLoad> loads_;  // likewise
  double wall_s_ = 0.0;
};

}  // namespace weaveform
