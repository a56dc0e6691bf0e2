// The one list of the statistics and their names in files (solve.json, summary.json).
#pragma once

#include "solver/result/result.hpp"

namespace weaveform {

// Calls visit(name, field) for each field of a SolveStatistics, const or not, in the order of its declaration.
template <class Statistics, class Visit>
void for_each_statistic(Statistics& s, Visit visit) {
  visit("finished", s.finished);
  visit("time_s", s.time_s);
  visit("program", s.program);
  visit("scene", s.scene);
  visit("scene_digest", s.scene_digest);
  visit("card_digest", s.card_digest);
  visit("mesh_digest", s.mesh_digest);
  visit("cells", s.cells);
  visit("nodes", s.nodes);
  visit("yarns", s.yarns);
  visit("symmetry", s.symmetry);
  visit("cells_solved", s.cells_solved);
  visit("steps", s.steps);
  visit("duration_s", s.duration_s);
  visit("wall_s", s.wall_s);
  visit("checkpoint_wall_s", s.checkpoint_wall_s);
  visit("cell_steps_per_s", s.cell_steps_per_s);
  visit("step_s", s.step_s);
  visit("step_set_by", s.step_set_by);
  visit("damping_per_s", s.damping_per_s);
  visit("energy_error", s.energy_error);
  visit("kinetic_to_internal", s.kinetic_to_internal);
  visit("damping_work_mJ", s.damping_work_mJ);
  visit("bending_friction_work_mJ", s.bending_friction_work_mJ);
  visit("bending_energy_mJ", s.bending_energy_mJ);
  visit("hourglass_energy_mJ", s.hourglass_energy_mJ);
  visit("rotary_inertia_scale", s.rotary_inertia_scale);
  visit("max_shear_angle_deg", s.max_shear_angle_deg);
  visit("max_yarn_strain", s.max_yarn_strain);
  visit("folded_cells", s.folded_cells);
  visit("folded_cells_at_end", s.folded_cells_at_end);
  visit("cells_beyond_card", s.cells_beyond_card);
  visit("yarn_strain_error", s.yarn_strain_error);
  visit("added_mass_t", s.added_mass_t);
  visit("perturbation_distance_mm", s.perturbation_distance_mm);
  visit("perturbation_returned", s.perturbation_returned);
  visit("contact_penetration", s.contact_penetration);
  visit("friction_work_mJ", s.friction_work_mJ);
  visit("contact_damping_work_mJ", s.contact_damping_work_mJ);
  visit("contact_wall_s", s.contact_wall_s);
  visit("threads", s.threads);
}

// The same for the pairs of plies, which are a list of their own, "pairs".
template <class Pair, class Visit>
void for_each_pair_statistic(Pair& s, Visit visit) {
  visit("lower", s.lower);
  visit("upper", s.upper);
  visit("contact_area_mm2", s.contact_area_mm2);
  visit("force_N", s.force_N);
  visit("friction_force_N", s.friction_force_N);
  visit("max_penetration_mm", s.max_penetration_mm);
  visit("max_slip_mm", s.max_slip_mm);
  visit("mean_slip_mm", s.mean_slip_mm);
  visit("max_pressure_MPa", s.max_pressure_MPa);
  visit("stored_energy_mJ", s.stored_energy_mJ);
  visit("friction_work_mJ", s.friction_work_mJ);
  visit("damping_work_mJ", s.damping_work_mJ);
}

}  // namespace weaveform
