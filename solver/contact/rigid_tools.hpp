// The scene's rigid tools in motion, and what the plies that touch them do to each. A half or quarter of the fabric
// meets a half or quarter of a tool; readings are those of the whole.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/vector/vector.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "mesher/tools/tool.hpp"
#include "solver/contact/contact_kernel.hpp"
#include "solver/contact/tool_motion.hpp"
#include "solver/state/actor.hpp"
#include "solver/state/tool_reading.hpp"

namespace weaveform {

// Where the step follows the strains that yarns reach (reach.hpp), tools as light as the blank would set it; four times
// the blank's mass still follows at a hundred times the speed of a forming process.
inline constexpr double tool_mass_reached = 4.0;
// tonne; of a pushed tool whose mass the scene leaves open, from the blank's (mass scaling included). Heavy enough that
// the many springs on it do not set the step, light enough to follow at hundreds of times the speed of any forming
// process.
[[nodiscard]] inline double default_tool_mass(const AnalysisSpec& analysis, double blank_mass) {
  return (analysis.step_bound == StepBound::reached ? tool_mass_reached : 1.0) * blank_mass;
}

// A ply on its contact springs.
struct SprungPly {
  double mass = 0.0;              // tonne
  double frequency = 0.0;         // 1/s; omega of the springs
  double fabric_frequency = 0.0;  // 1/s; the greatest of the ply's own
  // s; contact that knows the curve between nodes (curved_contact.hpp) comes on in this time. None: it does not.
  std::optional<double> curved_after;
};

// How a spring to a pushed tool is shared between node and tool: k (u - U)^2 <= (1 + e) k u^2 + (1 + 1/e) k U^2.
inline constexpr double coupling_split = 0.1;

// Sums over what touches one tool.
struct ToolLoad {
  Vec3 force = {0.0, 0.0, 0.0};  // N; of the tool on the fabric
  double area = 0.0;             // mm^2
  double energy = 0.0;           // mJ; stored in the springs
  double friction_work = 0.0;    // mJ; lost so far
  double damping_work = 0.0;     // mJ; likewise
  double deepest = 0.0;          // mm
};

void archive_load(Archive& archive, ToolLoad& load);

struct MovingTool {
  Tool tool;
  ToolMotion motion;
  double way = 0.0;              // mm; so far, back and forth
  double reaction_before = 0.0;  // N; at the step before
  ToolLoad load;
  [[nodiscard]] double reaction() const;  // N; force along the direction
  [[nodiscard]] Placement place() const;
  [[nodiscard]] ContactTool contact_tool() const;
};

class RigidTools {
public:
  // `tools` in the scene's order; `symmetry` of the plies; `least_spacing` (mm) of their cells, that no tool may pass in
  // one step; `duration` of the travel (s). Throws InputError when a pushed tool is too light for the step.
  RigidTools(std::vector<Tool> tools, const Scene& scene, const MeshSymmetry& symmetry, double least_spacing,
             double duration, const std::vector<SprungPly>& plies);

  // Moves them to `time`; the first call only notes it. Throws PhysicsError when a tool moves more than a cell.
  void advance(double time);
  // s; length of the step that the last advance made, 0 for the first.
  [[nodiscard]] double step_made() const { return step_made_; }
  // Takes what the plies did to them since: one list for each ply, in the order of the tools.
  void gather(const std::vector<const std::vector<ToolLoad>*>& loads);

  [[nodiscard]] std::vector<MovingTool>& tools() { return tools_; }
  [[nodiscard]] const std::vector<MovingTool>& tools() const { return tools_; }
  // At the time of the last gather.
  [[nodiscard]] const std::vector<ToolReading>& readings() const { return readings_; }
  [[nodiscard]] StoredEnergy stored_energy() const;
  [[nodiscard]] EnergyFlow energy_flow() const;
  // s; of the lightest pushed tool on the springs of all nodes.
  [[nodiscard]] double longest_step() const;
  // mJ so far, of what is solved.
  [[nodiscard]] double friction_work() const;
  [[nodiscard]] double damping_work() const;  // normal contact damping and the guides of pushed tools
  [[nodiscard]] double greatest_depth() const { return greatest_depth_; }  // mm; so far
  void archive(Archive& archive);

private:
  void read_instruments();

  std::vector<MovingTool> tools_;
  std::vector<SprungPly> plies_;
  std::vector<SymmetryPlane> planes_;
  int parts_;             // of which this is one: the mesh's symmetry
  double least_spacing_;  // mm
  std::vector<ToolReading> readings_;
  bool started_ = false;
  double time_ = 0.0, step_made_ = 0.0;  // s
  double greatest_depth_ = 0.0;          // mm
};

}  // namespace weaveform
