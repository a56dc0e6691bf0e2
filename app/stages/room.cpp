#include "app/stages/room.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "app/stages/machine.hpp"
#include "core/error.hpp"
#include "mesher/lattice/expected_size.hpp"
#include "mesher/resolve/resolve.hpp"
#include "solver/analysis/loading.hpp"
#include "solver/bending/flexure.hpp"
#include "solver/element/yarn_law.hpp"
#include "solver/ply/reach.hpp"
#include "solver/solve.hpp"

namespace weaveform {
namespace {

// Measured, membranes and shells of 41,000 and 166,000 cells: 1.25 and 1.5 kB a cell. On disk, compressed: 173 B of a
// cell in a frame (1,200 cells, bias extension), 230 with tools (formed hemisphere), 50 to 115 in mesh.vtu.
constexpr double program_bytes = 7e7, cell_bytes = 1700.0, tool_bytes = 250.0;
constexpr double crossing_bytes = 64.0;  // of the lattice across the bounding box, fabric or not
constexpr double frame_bytes = 200.0, frame_bytes_with_tools = 260.0, mesh_bytes = 120.0;  // a cell
constexpr double frame_bytes_of_slip = 60.0;                                               // of a stack
constexpr double number_bytes = 20.0;                                                      // written
constexpr double most_crossings = 2e9;  // beyond, they cannot be numbered
// Cells times steps a second on one thread, for the first look: a fraction of what an undisturbed core of 2020 does.
// What comes near the limit by it is measured.
constexpr double membrane_rate = 8e6, bending_rate = 4e6, shell_rate = 1.5e6;
// A tool's contact over the step of a membrane: shapes, and triangles (the two of the tutorial's pan).
constexpr double shape_share = 0.2, triangles_share = 1.8;
constexpr double ply_contact_share = 0.6;  // of plies with each other, over the step of a membrane, at most
constexpr double far_off = 10.0;           // a setting so many times from what would be chosen is the first to look at
constexpr double nearly = 10.0;            // an estimate from the first step and a tabulated rate may be that wrong
constexpr int measured_steps = 60;

std::string where(const Scene& scene) {
  return scene.file.empty() ? "" : scene.file + ": ";
}

std::string amount(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.0f} MB", 1e-6 * bytes) : fmt::format("{:.3g} GB", 1e-9 * bytes);
}

std::string size_cause(const ExpectedSize& size) {
  if (!size.outlier.empty()) return fmt::format("the outline's {} lies far from all others; mend it", size.outlier);
  return fmt::format(
      "the blank is {:.4g} x {:.4g} mm with a yarn every {:.3g} and {:.3g} mm (the card's interval times "
      "blank.coarsening); raise blank.coarsening",
      size.extent[0], size.extent[1], size.spacing[0], size.spacing[1]);
}

// Of history.csv, about.
double expected_columns(const Scene& scene) {
  const auto plies = static_cast<double>(scene.ply.size());
  return 10.0 + 3.0 * static_cast<double>(scene.grip.size() + scene.tools.size()) +
         4.0 * static_cast<double>(scene.measure.size()) + plies + 4.0 * plies * plies;
}

double expected_memory(const Scene& scene, const ExpectedSize& size) {
  const double columns = expected_columns(scene);
  return program_bytes + crossing_bytes * size.crossings +
         (cell_bytes + tool_bytes * static_cast<double>(scene.tools.size())) * size.cells +
         2.0 * sizeof(double) * columns * scene.output.history;
}

// s; of a lattice of trusses whose crossings carry their share of the fabric's mass: 2/omega = sqrt(m/k).
double lattice_step(const Scene& scene, const Card& card, const Mesh& mesh) {
  const auto laws = yarn_laws(card, scene.model);
  const double mass = card.area_density() * mesh.spacing[0] * mesh.spacing[1] * scene.analysis.mass_scale;
  double step = HUGE_VAL;
  for (std::size_t f = 0; f < 2; ++f) {
    const double yarns = mesh.spacing[1 - f] / card.yarn[f].interval;
    const double stiffness =
        laws[f].stiffest(-torn_strain, torn_strain) * card.yarn[f].section * yarns / mesh.spacing[f];
    step = std::min(step, std::sqrt(mass / stiffness));
  }
  return scene.analysis.step_factor * step;
}

struct Solve {
  double duration = 0.0, step = 0.0;  // s
  int cells = 0;                      // of the part that symmetry leaves, once known
  double wall = 0.0;                  // s; of the steps tried
  [[nodiscard]] double steps() const { return duration / step; }
};

// The first step of an analysis knows all that sets it: tools, bending, a frame's members.
Solve first_steps(const Resolved& model, int steps) {
  const AnalysisSpec& asked = model.scene.analysis;
  std::optional<Resolved> clean;  // the mesh may be large: not copied without need
  if (asked.perturbation > 0.0 || (asked.step_check && asked.step_factor > 1.0)) {
    clean = without_perturbation(model);       // a perturbed analysis is two
    clean->scene.analysis.step_check = false;  // the run itself complains
  }
  const auto trial = solve(clean ? *clean : model, {}, {.threads = 1, .quiet = true, .most_steps = steps}).statistics;
  return {trial.duration_s, trial.step_s, trial.cells_solved, trial.wall_s};
}

// s; of a step on this machine, now, without what an analysis takes to begin, the shorter of two beginnings: one that the
// machine held up would leave no time to the steps, and let a run of weeks pass.
double measured_step(const Resolved& model, const Solve& first) {
  const Solve more = first_steps(model, measured_steps);
  const double beginning = std::min(first.wall, first_steps(model, 1).wall);
  return std::max(more.wall - beginning, 0.0) / (measured_steps - 1);
}

double expected_rate(const Scene& scene, const Card& card) {
  const Flexure flexure = choose_flexure(card, scene);
  const double rate = flexure.has_shell                              ? shell_rate
                      : flexure.bends_yarns || flexure.rotation_free ? bending_rate
                                                                     : membrane_rate;
  double contact = 0.0;
  for (const ToolSpec& tool : scene.tools)
    contact += tool.shape == ToolShape::triangles ? triangles_share : shape_share;
  return rate / (1.0 + contact);
}

std::string time_cause(const Resolved& model, const Solve& solve) {
  const Scene& scene = model.scene;
  const double chosen = automatic_duration(model);
  if (solve.duration > far_off * chosen)
    return fmt::format("the duration of {:.4g} s is {:.3g} times the {:.3g} s that would be chosen; lower {}",
                       solve.duration, solve.duration / chosen, chosen,
                       scene.analysis.loading_speed ? "it by a greater analysis.loading_speed" : "analysis.duration");
  if (scene.analysis.mass_scale * far_off < 1.0)
    return fmt::format("analysis.mass_scale = {:g} makes the fabric so light; leave it at 1 or above",
                       scene.analysis.mass_scale);
  if (scene.analysis.step_factor * far_off < 1.0)
    return fmt::format("analysis.step_factor = {:g} makes the step so small; 0.9 is stable",
                       scene.analysis.step_factor);
  if (solve.duration > far_off * 10.0)  // s; no process of forming is simulated that long
    return fmt::format("the duration chosen for this scene is {:.4g} s; look at its travels and lengths",
                       solve.duration);
  std::string advice = "raise blank.coarsening or analysis.mass_scale";
  if (scene.analysis.step_bound == StepBound::stiffest) advice += ", or leave analysis.step_bound at \"reached\"";
  return advice;
}

std::string duration_text(double seconds) {
  if (seconds < 90.0) return fmt::format("{:.2g} s", seconds);
  return seconds < 5400.0 ? fmt::format("{:.0f} min", seconds / 60.0) : fmt::format("{:.3g} h", seconds / 3600.0);
}

ExpectedRun expectation(const Resolved& model, const Solve& solve, double seconds) {
  ExpectedSize size;
  for (std::size_t k = 0; k < model.plies(); ++k) {
    const Resolved& ply = model.of_ply(k);
    const ExpectedSize own = expected_size(ply.scene.blank, ply.card, ply.outline);
    size.cells += own.cells;
    size.crossings += own.crossings;
  }
  return {model.mesh.cells.size(), solve.cells, solve.steps(), solve.step, seconds, expected_memory(model.scene, size)};
}

}  // namespace

std::string describe(const ExpectedRun& expected) {
  return fmt::format(
      "expected: {} cells to solve of {}, about {:.3g} steps of {:.3g} s, {} on one thread, {} of memory",
      expected.cells_solved, expected.cells, expected.steps, expected.step, duration_text(expected.wall),
      amount(expected.memory));
}

double require_memory(const Scene& scene, const Card& card, const BlankOutline& outline, bool yes, double besides) {
  const ExpectedSize size = expected_size(scene.blank, card, outline);
  const double bytes = besides + expected_memory(scene, size) - (besides > 0.0 ? program_bytes : 0.0);
  const bool too_many = !(size.crossings < most_crossings && size.cells < most_crossings);
  const double most = scene.analysis.most_memory ? 1e9 * *scene.analysis.most_memory : available_memory();
  if (!too_many && (yes || bytes <= most)) return bytes;
  throw InputError(fmt::format("{}about {:.3g} cells would take {} of memory{}, {}: {}{}", where(scene), size.cells,
                               amount(bytes), besides > 0.0 ? " with the plies before" : "",
                               too_many
                                   ? "and more crossings than can be numbered"
                                   : fmt::format("more than the {} {}", amount(most),
                                                 scene.analysis.most_memory ? "of analysis.most_memory" : "available"),
                               size_cause(size), too_many ? "" : ", or allow it with --yes or analysis.most_memory"));
}

void require_disk(const Scene& scene, const Mesh& mesh, const std::filesystem::path& directory, bool yes) {
  if (yes) return;
  const double columns = expected_columns(scene);
  const double cell =
      (scene.tools.empty() ? frame_bytes : frame_bytes_with_tools) + (scene.ply.empty() ? 0.0 : frame_bytes_of_slip);
  const double frame = cell * mesh.cells.size();
  const double bytes = mesh_bytes * mesh.cells.size() + frame * (scene.output.frames + 1.0) +
                       number_bytes * columns * scene.output.history;
  const double most = available_disk(directory);
  if (bytes <= most) return;
  throw InputError(fmt::format(
      "{}{} frames of {} and {} rows of history would take {} of disk, and {} has {}: lower output.frames or "
      "output.history, make room, or allow it with --yes",
      where(scene), scene.output.frames + 1, amount(frame), scene.output.history, amount(bytes),
      directory.empty() ? "the disk" : directory.string(), amount(most)));
}

ExpectedRun require_time(const Resolved& model, bool yes) {
  const Scene& scene = model.scene;
  const double limit = 3600.0 * scene.analysis.most_hours;
  double rate = HUGE_VAL;  // of the dearest ply
  Solve expected{choose_loading(model).duration, HUGE_VAL, model.mesh.cells.size()};
  for (std::size_t k = 0; k < model.plies(); ++k) {
    const Resolved& ply = model.of_ply(k);
    rate = std::min(rate, expected_rate(ply.scene, ply.card));
    expected.step = std::min(expected.step, lattice_step(ply.scene, ply.card, ply.mesh));
  }
  if (model.plies() > 1) rate /= 1.0 + ply_contact_share;
  double step_seconds = 0.0;
  const auto seconds = [&] {
    return expected.steps() * (step_seconds > 0.0 ? step_seconds : std::max(expected.cells, 100) / rate);
  };
  try {
    expected = first_steps(model, 1);
    if (!yes && seconds() * nearly > limit) step_seconds = measured_step(model, expected);
  } catch (const PhysicsError&) {
    // the run says it, with its place
  }
  if (yes || seconds() <= limit) return expectation(model, expected, seconds());
  throw InputError(fmt::format(
      "{}the solve would take about {:.3g} steps of {:.3g} s for {} cells, {:.3g} hours (analysis.most_hours is {:g}): "
      "{}; or allow it with --yes or analysis.most_hours",
      where(scene), expected.steps(), expected.step, expected.cells, seconds() / 3600.0, scene.analysis.most_hours,
      time_cause(model, expected)));
}

}  // namespace weaveform
