// Keys of the explicit analysis and of what is written.
#include "mesher/scene/scene_keys.hpp"

namespace weaveform {

const std::vector<Key<AnalysisSpec>>& analysis_keys() {
  static const std::vector<Key<AnalysisSpec>> keys = {
      key<&AnalysisSpec::duration>(
          {.name = "duration",
           .unit = "s",
           .limits = above(0, 1e9),
           .doc =
               "time over which grips and tools travel; left out: from the fabric's slowest shear wave, of tools so "
               "that none is faster than 1000 mm/s, or, where nothing acts but gravity, until the slowest sway has "
               "come to rest; \"auto\" written out where tools travel: by `inertia`, which is then 0.01 unless it is "
               "given too"}),
      key<&AnalysisSpec::loading_speed>({.name = "loading_speed",
                                         .unit = "mm/s",
                                         .limits = above(0, 1e9),
                                         .doc = "greatest speed of any grip; an alternative to `duration`"}),
      key<&AnalysisSpec::inertia>(
          {.name = "inertia",
           .unit = "1",
           .limits = between(1e-4, 0.5),
           .doc = "share of the loads that inertia and damping may be, e.g. 0.01. Without `duration` and "
                  "`loading_speed` the duration is chosen by it, from trials on coarser meshes, and with it the course "
                  "of the `speed` of tools that travel without one; with one of them the run warns beyond it; auto: "
                  "nothing is chosen by it and the run warns beyond 0.02"}),
      key<&AnalysisSpec::yarn_viscosity>(
          {.name = "yarn_viscosity",
           .unit = "1",
           .limits = between(0, 1),
           .doc =
               "axial viscosity of the yarns as a fraction of critical damping at their elements' highest frequency; "
               "keeps "
               "yarns that jump between tension and slackness from making energy out of rounding noise"}),
      key<&AnalysisSpec::step_factor>(
          {.name = "step_factor", .unit = "1", .limits = between(1e-4, 4), .doc = "fraction of the stable step"}),
      key<&AnalysisSpec::step_bound>(
          {.name = "step_bound",
           .doc = "stiffness of the yarns that the stable step is taken from: `reached`, the greatest at strains that "
                  "yarns have reached so far, watched at every step; `stiffest`, the law's greatest up to a true "
                  "strain of "
                  "0.5: two to eight times more steps where yarns decrimp (docs/accuracy.md)"}),
      key<&AnalysisSpec::precision>(
          {.name = "precision",
           .doc = "of what yarns and cells compute; `single` is faster and off by some 1e-7 of each element's force: "
                  "positions, their differences, motion, contact, bending and energies stay in double precision "
                  "(docs/accuracy.md). Not with the formulations that add up a cell's stress"}),
      key<&AnalysisSpec::bending_every>(
          {.name = "bending_every",
           .unit = "1",
           .limits = between(1, 16),
           .doc = "steps from one evaluation of bending to the next (of beams and rotation-free cells, which are far "
                  "softer "
                  "than yarns in tension); its force then acts as an impulse of so many steps. 4 takes bending off the "
                  "bill"}),
      key<&AnalysisSpec::mass_scale>(
          {.name = "mass_scale",
           .unit = "1",
           .limits = between(1e-4, 1e6),
           .doc =
               "factor on the fabric's mass, not on its weight: above 1 the step grows with its root, and inertia with "
               "it, as if loaded that much faster; the mass added is in the summary"}),
      key<&AnalysisSpec::contact_stiffness>(
          {.name = "contact_stiffness",
           .unit = "1",
           .limits = above(0, 1),
           .doc = "factor on the stiffness of contact: below 1 the fabric sinks further into the tools (the greatest "
                  "penetration is in the summary), and contact takes less of the step; auto: 0.5, and 1 with "
                  "`step_bound = \"stiffest\"`, but nowhere stiffer than the card's `through_thickness_stiffness`"}),
      key<&AnalysisSpec::curved_contact>(
          {.name = "curved_contact",
           .doc =
               "contact that knows the curve between its nodes: each yarn's kink at a node lifts it off the tool by "
               "kink * length / 24, so that chords have the length of the arc, and Coulomb's limit is that of a belt "
               "over the kink, exp(mu kink), along the kink's bisector (docs/contact.md)"}),
      key<&AnalysisSpec::step_check>({.name = "step_check", .doc = "stop when the step is above the stable one"}),
      key<&AnalysisSpec::damping>(
          {.name = "damping",
           .unit = "1/s",
           .limits = between(0, 1e9),
           .doc = "mass-proportional damping; auto: chosen from the duration; critical for the slowest "
                  "sway where nothing acts but gravity"}),
      key<&AnalysisSpec::energy_limit>({.name = "energy_limit",
                                        .unit = "1",
                                        .limits = above(0, 1),
                                        .doc = "the run fails when the energy-balance error passes this fraction"}),
      key<&AnalysisSpec::gravity>({.name = "gravity",
                                   .unit = "mm/s2",
                                   .limits = between(-1e10, 1e10),
                                   .doc = "acceleration of the fabric by its weight, world frame"}),
      key<&AnalysisSpec::perturbation>({.name = "perturbation",
                                        .unit = "mm",
                                        .limits = between(0, 1000),
                                        .doc = "random in-plane displacement of every free node at the start"}),
      key<&AnalysisSpec::perturbation_seed>(
          {.name = "perturbation_seed", .unit = "1", .limits = at_least(0), .doc = "same seed, same displacements"}),
      key<&AnalysisSpec::most_hours>(
          {.name = "most_hours",
           .unit = "h",
           .limits = above(0, 1e5),
           .doc = "a solve that is expected to take longer does not begin, unless `--yes` says so; expected from "
                  "cells, steps and, near the limit, the time that a few steps take here"}),
      key<&AnalysisSpec::most_memory>(
          {.name = "most_memory",
           .unit = "GB",
           .limits = above(0, 1e6),
           .doc = "the same for the memory that mesh and solve are expected to take; auto: what the machine has "
                  "available (and the limits set for the process allow)"}),
  };
  return keys;
}

const std::vector<Key<OutputSpec>>& output_keys() {
  static const std::vector<Key<OutputSpec>> keys = {
      key<&OutputSpec::frames>(
          {.name = "frames", .unit = "1", .limits = between(0, 10000), .doc = "result frames after the initial one"}),
      key<&OutputSpec::history>({.name = "history",
                                 .unit = "1",
                                 .limits = between(1, 1000000),
                                 .doc = "rows of history.csv after the initial one"}),
      key<&OutputSpec::contour_step>({.name = "contour_step",
                                      .unit = "deg",
                                      .limits = between(0.01, 90),
                                      .doc = "spacing of the shear-angle isolines"}),
      key<&OutputSpec::checkpoint_minutes>(
          {.name = "checkpoint_minutes",
           .unit = "min",
           .limits = between(0, 10000),
           .doc = "wall time between checkpoints, which `--resume` goes on from after a kill or a power cut; stretched "
                  "where writing them would take more than a hundredth of the time; 0: none but on signals"}),
  };
  return keys;
}

const std::vector<Key<MeasureSpec>>& measure_keys() {
  static const std::vector<Key<MeasureSpec>> keys = {
      key<&MeasureSpec::name>({.name = "name",
                               .required = true,
                               .identifier = true,
                               .doc = "heads the column `NAME.shear_angle_deg` of history.csv"}),
      key<&MeasureSpec::box>(
          {.name = "box",
           .unit = "mm",
           .limits = any_length,
           .doc = "the cells whose centre lies in xmin, ymin, xmax, ymax, blank frame, before forming"}),
      key<&MeasureSpec::relative_box>({.name = "relative_box",
                                       .unit = "1",
                                       .limits = between(-1e9, 1e9),
                                       .doc = "the same in units of the blank's width size[0], so that it follows the "
                                              "size; either this or `box`"}),
      key<&MeasureSpec::ply>({.name = "ply",
                              .identifier = true,
                              .doc = "of a stack: name of the ply whose cells they are; left out: all that have cells "
                                     "there, each in its own blank's frame"}),
  };
  return keys;
}

}  // namespace weaveform
