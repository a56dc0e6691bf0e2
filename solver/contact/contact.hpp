// Contact of the fabric's nodes, on both faces, with the scene's rigid tools.
//
// Stiffness and step. Every node has k = omega^2 m with omega^2 a small share of the fabric's own greatest omega^2, so
// that k is a fixed part of m/step^2: stiff enough for penetrations of a few per cent of the thickness, yet together
// with its damping worth only some per cent of the step (add_stiffness_bound says exactly how much). A tool pushed by a
// force has the blank's mass unless the scene says otherwise: heavy enough that the many springs on it do not set the
// step, light enough to follow at hundreds of times the speed of any forming process.
//
// Culling. Nodes go in blocks; for each block and tool a clearance is kept that the block cannot have used up yet: the
// least gap when last measured less the greatest way of its nodes and of the tool since. A distance changes no faster
// than points move, so a block with clearance left touches nothing, and nothing more is computed.
//
// Blocks are summed in order: the same bits for any number of threads.
#pragma once

#include <string>
#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "mesher/tools/tool.hpp"
#include "solver/contact/contact_kernel.hpp"
#include "solver/contact/tool_motion.hpp"
#include "solver/state/contact_state.hpp"
#include "solver/state/force_term.hpp"
#include "solver/state/packed.hpp"
#include "solver/state/team.hpp"
#include "solver/state/tool_reading.hpp"

namespace weaveform {

// Of the fabric's greatest omega^2. A node of a fabric under tension sinks in by e h^2/(R s) at yarn strain e, spacing
// h and tool radius R, with s = 4 * share the stiffness against that of a yarn element: at 1 % strain less than half of
// what its chord cuts off the circle anyway, h^2/(8 R), and like that a matter of h^2.
inline constexpr double contact_stiffness_share = 0.05;
// Where the step follows the strains that yarns reach (reach.hpp), contact as stiff as that, and tools as light as the
// blank, would set it. Half the stiffness sinks a node in by as much as its chord cuts off; four times the blank's mass
// still follows at a hundred times the speed of a forming process.
inline constexpr double contact_stiffness_reached = 0.5, tool_mass_reached = 4.0;
// tonne; of a pushed tool whose mass the scene leaves open, from the blank's (mass scaling included).
[[nodiscard]] inline double default_tool_mass(const AnalysisSpec& analysis, double blank_mass) {
  return (analysis.step_bound == "reached" ? tool_mass_reached : 1.0) * blank_mass;
}
inline constexpr double contact_damping = 0.1;     // of critical, of a node on its contact spring
inline constexpr double contact_softening = 0.02;  // of the thickness: the depth over which the normal force sets in

class Contact : public ForceTerm {
public:
  // `duration` of the tools' travel (s); `fabric_step` is the stable step of the fabric alone (s). Throws InputError
  // when the fabric starts inside a tool, or a pushed tool is too light for the step. `tools` are the scene's.
  Contact(const Mesh& mesh, const Scene& scene, const std::vector<Tool>& tools, const PackedMesh& packed,
          const State& start, double duration, double fabric_step, Team& team);

  [[nodiscard]] std::string name() const override { return "contact"; }
  // Moves the tools to state.time first. Throws PhysicsError when a tool moves more than a cell in a step or a node
  // has gone through a tool's surface by more than the fabric's thickness.
  void add_forces(State& state, double step) override;
  [[nodiscard]] double stored_energy() const override;
  [[nodiscard]] double kinetic_energy() const override;
  [[nodiscard]] double dissipated() const override;
  [[nodiscard]] double external_work() const override;
  void add_stiffness_bound(const std::vector<Vec3>& position, double fabric_frequency,
                           std::vector<double>& bound) const override;
  // Of the lightest pushed tool on the springs of all nodes.
  [[nodiscard]] double longest_step() const override;
  [[nodiscard]] std::vector<double> memory() const override;
  void recall(const std::vector<double>& memory) override;

  // Of each tool in the scene's order, at the time of the last add_forces; of the whole, where the mesh is a half or
  // quarter of one (everything else is that of the mesh).
  [[nodiscard]] const std::vector<ToolReading>& readings() const { return readings_; }

  // Per mesh node, at the positions of the last add_forces (contact_state.hpp).
  [[nodiscard]] ContactState contact_state(const State& state) const;

  struct Cost {
    double penetration = 0.0;    // 1; greatest so far, as a fraction of the fabric's thickness
    double friction_work = 0.0;  // mJ
    double damping_work = 0.0;   // mJ; normal contact damping and the guides of pushed tools
    double wall_s = 0.0;         // spent in add_forces
  };
  [[nodiscard]] Cost cost() const;

private:
  // A tool with what contact knows of it.
  struct Partner {
    Partner(Tool its_tool, ToolMotion its_motion) : tool(std::move(its_tool)), motion(std::move(its_motion)) {}
    Tool tool;
    ToolMotion motion;
    ContactLaw law;
    Components anchor;              // mm; tool's frame
    std::vector<double> clearance;  // mm; per block, > 0 where nothing can touch
    std::vector<char> measured;     // per block, in the last add_forces
    std::vector<ContactSums> sums;  // per block, valid where measured
    std::vector<double> depth;      // mm; per block, greatest penetration, valid where measured
    std::vector<int> hint;          // per node, of triangles
    Components measured_at;         // mm; per node, of triangles: where its distance was last measured,
    Doubles far;                    // mm; that distance plus the tool's way so far then (-inf: never)
    double way = 0.0;               // mm; the tool's so far, back and forth
    Vec3 force = {0.0, 0.0, 0.0};   // N; on the fabric
    double area = 0.0, energy = 0.0, friction_work = 0.0, damping_work = 0.0, deepest = 0.0;
    [[nodiscard]] double reaction() const;  // N; force along the direction
    [[nodiscard]] Placement place() const;
    [[nodiscard]] ContactTool contact_tool() const;
  };
  // `free_mass` (tonne): of a pushed tool whose spec names none.
  Partner make_partner(const Tool& tool, const ToolSpec& spec, double duration, const State& start,
                       double free_mass) const;
  void refuse_penetration(const State& start) const;
  void move_tools(double time, double step);
  void treat_block(int block, State& state, double step);
  static void triangle_distances(Partner& partner, const ContactNodes& nodes, int first, Distances& distances);
  void sum_blocks(Partner& partner, double reaction_before);
  void read_instruments();
  void check(const Partner& partner, const State& state) const;
  [[nodiscard]] ContactNodes block_nodes(int block, Partner& partner, State& state) const;
  [[nodiscard]] int block_count() const;

  const PackedMesh& packed_;
  Team& team_;
  double thickness_;         // mm
  double least_spacing_;     // mm
  double frequency_;         // 1/s; omega of the contact
  double fabric_frequency_;  // 1/s; the fabric's greatest
  double blank_mass_ = 0.0;  // tonne
  int parts_;                // of which this is one: the mesh's symmetry
  std::vector<SymmetryPlane> planes_;
  Doubles mass_;  // tonne; 0 where no node is
  Doubles area_;  // mm^2; of the fabric around each node
  std::vector<int> mesh_of_packed_;
  std::vector<Partner> partners_;
  std::vector<ToolReading> readings_;
  bool started_ = false;
  double time_before_ = 0.0;     // s
  double greatest_depth_ = 0.0;  // mm
  double wall_s_ = 0.0;
};

}  // namespace weaveform
