// What an analysis cost and how far it can be trusted, of its last row or frame.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/files/digest.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/ply/strain_error.hpp"

namespace weaveform {
namespace {

void name_run(const Mesh& whole, const Mesh& solved, SolveStatistics& s) {
  s.mesh_digest = mesh_digest(whole);
  s.cells = whole.cells.size();
  s.nodes = whole.node_count();
  s.yarns = whole.yarn_count();
  const int parts = solved.symmetry.parts();
  s.symmetry = parts == 4 ? "quarter" : parts == 2 ? "half" : "none";
  s.cells_solved = solved.cells.size();
}

void judge_fields(const Fields& fields, const Card& card, SolveStatistics& s) {
  for (const double angle : fields.shear_angle) {
    const double degrees = std::abs(angle) * 180.0 / std::numbers::pi;
    s.max_shear_angle_deg = std::max(s.max_shear_angle_deg, degrees);
    s.cells_beyond_card += degrees > card.shear.valid_to_deg ? 1 : 0;
  }
  for (const double strain : fields.yarn_strain) s.max_yarn_strain = std::max(s.max_yarn_strain, strain);
  s.folded_cells_at_end = static_cast<int>(std::count(fields.folded.begin(), fields.folded.end(), true));
}

void judge_contact(const World& world, SolveStatistics& s) {
  if (world.tools() == nullptr) return;
  s.contact_penetration = world.tools()->greatest_depth() / world.ply(0).mesh().thickness;
  s.friction_work_mJ = world.parts() * world.tools()->friction_work();
  s.contact_damping_work_mJ = world.parts() * world.tools()->damping_work();
}

double added_mass(const Mesh& whole, const Scene& scene) {
  double added = 0.0;
  for (const double mass : whole.nodes.mass) added += mass * (1.0 - 1.0 / scene.analysis.mass_scale);
  if (scene.frame && !scene.frame->rigid)
    added += (scene.frame->mass_scale - 1.0) * 4.0 * scene.frame->density * scene.frame->section * scene.frame->length;
  return added;
}

}  // namespace

SolveStatistics Analysis::statistics() {
  const Ply& ply = world_.ply(0);
  const Fields& fields = outputs_.fields();
  SolveStatistics s;
  s.finished = false;
  s.time_s = fields.time;
  s.program = options_.program;
  s.scene = options_.scene_name;
  s.scene_digest = digest_of(identity());
  s.card_digest = digest_of(card_to_toml(card_));
  name_run(whole_, ply.mesh(), s);
  s.steps = world_.steps();
  s.duration_s = world_.duration();
  s.wall_s = wall();
  s.checkpoint_wall_s = clock_.spent();
  s.cell_steps_per_s = static_cast<double>(s.steps) * s.cells_solved / s.wall_s;
  s.step_s = world_.smallest_step();
  s.step_set_by = world_.step_set_by();
  s.damping_per_s = loading_.damping;
  s.energy_error = verdict_.worst_error();
  s.kinetic_to_internal = verdict_.worst_ratio();
  s.damping_work_mJ = world_.balance().damping;
  s.bending_energy_mJ = world_.balance().bending;
  s.hourglass_energy_mJ = world_.balance().hourglass;
  if (ply.shell() != nullptr) s.rotary_inertia_scale = ply.shell()->inertia_scale();
  judge_fields(fields, card_, s);
  s.folded_cells = verdict_.folded();
  s.threads = team_.threads();
  judge_contact(world_, s);
  s.contact_wall_s = contact_wall();
  s.added_mass_t = added_mass(whole_, scene_);
  s.yarn_strain_error = yarn_strain_error(whole_, card_, scene_.model, fields.yarn_strain);
  return s;
}

}  // namespace weaveform
