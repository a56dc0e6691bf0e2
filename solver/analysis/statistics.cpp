// What an analysis cost and how far it can be trusted, of its last row or frame.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/files/digest.hpp"
#include "mesher/mesh/stack.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/ply/strain_error.hpp"

namespace weaveform {
namespace {

void name_run(const Mesh& whole, int cells_solved, int parts, SolveStatistics& s) {
  s.mesh_digest = mesh_digest(whole);
  s.cells = whole.cells.size();
  s.nodes = whole.node_count();
  s.yarns = whole.yarn_count();
  s.symmetry = parts == 4 ? "quarter" : parts == 2 ? "half" : "none";
  s.cells_solved = cells_solved;
}

void judge_fields(const Resolved& model, const Fields& fields, SolveStatistics& s) {
  for (std::size_t k = 0; k < model.plies(); ++k) {
    const Range cells = cells_of_ply(model.mesh, k);
    for (int c = cells.first; c < std::min(cells.last, static_cast<int>(fields.shear_angle.size())); ++c) {
      const double degrees = std::abs(fields.shear_angle[c]) * 180.0 / std::numbers::pi;
      s.max_shear_angle_deg = std::max(s.max_shear_angle_deg, degrees);
      s.cells_beyond_card += degrees > model.of_ply(k).card.shear.valid_to_deg ? 1 : 0;
    }
  }
  for (const double strain : fields.yarn_strain) s.max_yarn_strain = std::max(s.max_yarn_strain, strain);
  s.folded_cells_at_end = static_cast<int>(std::count(fields.folded.begin(), fields.folded.end(), true));
}

void judge_contact(const World& world, SolveStatistics& s) {
  if (world.tools() == nullptr) return;
  double thinnest = world.ply(0).mesh().thickness;
  for (std::size_t k = 1; k < world.size(); ++k) thinnest = std::min(thinnest, world.ply(k).mesh().thickness);
  s.contact_penetration = world.tools()->greatest_depth() / thinnest;
  s.friction_work_mJ = world.parts() * world.tools()->friction_work();
  s.contact_damping_work_mJ = world.parts() * world.tools()->damping_work();
}

std::vector<PairStatistics> pair_statistics(const World& world, const std::vector<MeshPly>& plies) {
  std::vector<PairStatistics> all;
  for (const PairReading& pair : whole_pairs(world)) {
    const bool neighbours = pair.upper == pair.lower + 1;
    if (!neighbours && pair.greatest_depth <= 0.0) continue;  // they never touched, and need not
    all.push_back({.lower = plies[pair.lower].name,
                   .upper = plies[pair.upper].name,
                   .contact_area_mm2 = pair.area,
                   .force_N = pair.force,
                   .friction_force_N = pair.friction_force,
                   .max_penetration_mm = pair.greatest_depth,
                   .max_slip_mm = pair.greatest_slip,
                   .mean_slip_mm = pair.mean_slip,
                   .max_pressure_MPa = pair.greatest_pressure,
                   .stored_energy_mJ = pair.stored,
                   .friction_work_mJ = pair.friction_work,
                   .damping_work_mJ = pair.damping_work});
  }
  return all;
}

double greatest_strain_error(const Resolved& model, const Fields& fields) {
  if (model.ply.empty()) return yarn_strain_error(model.mesh, model.card, model.scene.model, fields.yarn_strain);
  double greatest = 0.0;
  for (std::size_t k = 0; k < model.ply.size(); ++k) {
    const Resolved& ply = model.ply[k];
    greatest = std::max(greatest, yarn_strain_error(ply.mesh, ply.card, ply.scene.model,
                                                    fields_of_ply(fields, model.mesh, k).yarn_strain));
  }
  return greatest;
}

// 1; greatest of the plies that are shells.
double rotary_inertia_scale(const World& world, double none) {
  double greatest = none;
  for (std::size_t k = 0; k < world.size(); ++k)
    if (const Shell* shell = world.ply(k).shell()) greatest = std::max(greatest, shell->inertia_scale());
  return greatest;
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
  const Fields& fields = outputs_.fields();
  SolveStatistics s;
  s.finished = false;
  s.time_s = fields.time;
  s.program = options_.program;
  s.scene = options_.scene_name;
  s.scene_digest = digest_of(identity());
  std::string cards;
  for (std::size_t k = 0; k < model_.plies(); ++k) cards += card_to_toml(model_.of_ply(k).card);
  s.card_digest = digest_of(cards);
  name_run(whole_, cells_solved(), world_.parts(), s);
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
  s.bending_friction_work_mJ = world_.balance().bending_friction;
  s.bending_energy_mJ = world_.balance().bending;
  s.hourglass_energy_mJ = world_.balance().hourglass;
  s.rotary_inertia_scale = rotary_inertia_scale(world_, s.rotary_inertia_scale);
  judge_fields(model_, fields, s);
  s.folded_cells = verdict_.folded();
  s.threads = team_.threads();
  judge_contact(world_, s);
  s.contact_wall_s = contact_wall();
  s.added_mass_t = added_mass(whole_, scene_);
  s.yarn_strain_error = greatest_strain_error(model_, fields);
  s.pairs = pair_statistics(world_, whole_.ply);
  return s;
}

}  // namespace weaveform
