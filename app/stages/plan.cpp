#include "app/stages/plan.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>

#include "app/stages/checked_model.hpp"
#include "app/stages/chosen_duration.hpp"
#include "core/error.hpp"
#include "mesher/automatic/take.hpp"
#include "mesher/scene/overrides.hpp"
#include "solver/solve.hpp"

namespace weaveform {
namespace {

constexpr std::array factors = {8.0, 4.0, 2.0, 1.0, 0.5};  // from coarse to fine: memory only grows
constexpr int trial_steps = 400, least_trial_steps = 4;
// Some seconds: a trial has no more, and levels with less are run to their end. Work, not time, so that a plan's steps are
// the same on any machine.
constexpr double trial_cell_steps = 4e7;

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// How many more steps than duration over flat step a whole run took; 1 when it failed.
double shortening(const Resolved& model, int threads) {
  try {
    const auto flat = solve(model, {}, {.threads = threads, .quiet = true, .most_steps = 1});
    const auto whole = solve(model, {}, {.threads = threads, .quiet = true});
    return static_cast<double>(whole.statistics.steps) * flat.statistics.step_s / whole.statistics.duration_s;
  } catch (const PhysicsError&) {
    return 1.0;
  }
}

// mm; of warp and weft.
std::pair<double, double> yarn_lengths(const Mesh& mesh) {
  double warp = 0.0, weft = 0.0;
  for (int e = 0; e < mesh.yarn_count(); ++e)
    (mesh.yarns.family[e] == Family::warp ? warp : weft) += mesh.yarns.yarns[e] * mesh.yarns.rest_length[e];
  return {warp, weft};
}

PlanRow measured_row(const Resolved& model, int threads) {
  PlanRow row;
  std::tie(row.warp_length, row.weft_length) = yarn_lengths(model.mesh);
  for (std::size_t k = 0; k < model.ply.size(); ++k) {
    const Mesh& mesh = model.ply[k].mesh;
    const auto [warp, weft] = yarn_lengths(mesh);
    row.ply.push_back({model.mesh.ply[k].name, mesh.cells.size(), warp, weft});
  }
  const long most_steps =
      std::clamp(static_cast<int>(trial_cell_steps / model.mesh.cells.size()), least_trial_steps, trial_steps);
  const auto trial = solve(model, {}, {.threads = threads, .quiet = true, .most_steps = most_steps});
  const auto& s = trial.statistics;
  row.cells = s.cells;
  row.solved = s.cells_solved;
  row.step = s.step_s;
  row.steps = s.duration_s / s.step_s;
  row.seconds = s.wall_s / static_cast<double>(s.steps);  // per step; times the steps once they are known
  row.megabytes = peak_megabytes();
  return row;
}

}  // namespace

std::vector<PlanRow> make_plan(const std::string& scene_file, const std::vector<std::string>& overrides, int threads) {
  const Scene asked = read_taken_scene(scene_file, overrides);
  const auto with_its_duration = with_duration(overrides, choose_duration(scene_file, overrides));
  std::vector<PlanRow> rows;
  std::vector<double> shorter;  // of each row; of one that takes long, that of the finest that does not
  double known = 1.0;
  for (const double factor : factors) {
    auto with_factor = with_its_duration;
    for (const std::string& coarsening : coarsened(asked, factor)) with_factor.push_back(coarsening);
    with_factor.emplace_back("analysis.perturbation=0.0");  // a perturbed run is two runs
    PlanRow row;
    try {
      const Resolved model = checked_model(scene_file, with_factor, false, Look::for_first_complaint);
      row = measured_row(model, threads);
      if (row.solved * row.steps < trial_cell_steps) known = shortening(model, threads);
    } catch (const InputError& error) {
      row.refused = error.complaints().front();
    }
    row.factor = factor;
    rows.push_back(std::move(row));
    shorter.push_back(known);
  }
  if (std::all_of(rows.begin(), rows.end(), [](const PlanRow& row) { return !row.refused.empty(); }))
    throw InputError(rows.back().refused);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    rows[r].steps *= shorter[r];
    rows[r].seconds *= rows[r].steps;
  }
  return rows;
}

std::string plan_table(const std::vector<PlanRow>& rows) {
  std::string text =
      "coarsening     cells    solved   warp m   weft m   flat step s        steps   solve time s   memory MB\n";
  for (const auto& row : rows) {
    if (!row.refused.empty()) {
      text += fmt::format("{:>9g}x  no mesh: {}\n", row.factor, row.refused);
      continue;
    }
    text += fmt::format("{:>9g}x {:>9} {:>9} {:>8.2f} {:>8.2f} {:>13.3e} {:>12.0f} {:>14.2g} {:>11.0f}\n", row.factor,
                        row.cells, row.solved, 1e-3 * row.warp_length, 1e-3 * row.weft_length, row.step, row.steps,
                        row.seconds, row.megabytes);
    for (const PlanRow::Ply& ply : row.ply)
      text += fmt::format("{:>10.10} {:>9} {:>9} {:>8.2f} {:>8.2f}\n", ply.name, ply.cells, "", 1e-3 * ply.warp_length,
                          1e-3 * ply.weft_length);
  }
  return text;
}

nlohmann::ordered_json plan_json(const std::vector<PlanRow>& rows) {
  auto list = nlohmann::ordered_json::array();
  for (const PlanRow& row : rows) {
    if (!row.refused.empty())
      list.push_back({{"coarsening_factor", row.factor}, {"no_mesh", row.refused}});
    else
      list.push_back({{"coarsening_factor", row.factor},
                      {"cells", row.cells},
                      {"cells_solved", row.solved},
                      {"warp_length_mm", row.warp_length},
                      {"weft_length_mm", row.weft_length},
                      {"flat_step_s", row.step},
                      {"steps", row.steps},
                      {"wall_s", row.seconds},
                      {"memory_MB", row.megabytes}});
    for (const PlanRow::Ply& ply : row.ply)
      list.back()["plies"][ply.name] = {
          {"cells", ply.cells}, {"warp_length_mm", ply.warp_length}, {"weft_length_mm", ply.weft_length}};
  }
  return list;
}

}  // namespace weaveform
