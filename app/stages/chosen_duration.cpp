#include "app/stages/chosen_duration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/stages/checked_model.hpp"
#include "core/error.hpp"
#include "core/keys/key_value.hpp"
#include "mesher/automatic/take.hpp"
#include "mesher/scene/overrides.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/scene/taken.hpp"
#include "post/trust/inertia.hpp"
#include "solver/analysis/loading.hpp"
#include "solver/solve.hpp"

namespace weaveform {
namespace {

constexpr std::array trial_factors = {8.0, 4.0, 2.0, 1.0};  // of coarsening, coarsest first
constexpr int least_cells = 150;  // of a trial's mesh: coarser ones bear too few chords for their loads to mean much
constexpr int most_duration_trials = 6;
constexpr double near_enough = 1.5;   // times the duration: from a trial within it the share is scaled
constexpr double longest_leap = 8.0;  // times the duration, from one trial to the next
constexpr double margin = 0.9;        // of the share asked: a finer mesh may have a little more

void give_duration(Resolved& model, double duration) {
  model.scene.analysis.duration = duration;
  for (Resolved& ply : model.ply) ply.scene.analysis.duration = duration;
}

// 1; none when the fabric does not survive so fast a loading.
std::optional<double> share_at(Resolved& model, double duration) {
  give_duration(model, duration);
  try {
    const SolveResult result = solve(model, {}, {.threads = 1, .quiet = true});
    return std::abs(inertia_share(model.scene, result.history, result.statistics.damping_per_s).share);
  } catch (const PhysicsError&) {
    return std::nullopt;
  }
}

double rounded_up_to_three(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2.0);
  return std::ceil(value / unit * (1.0 - 1e-12)) * unit;
}

// None when no trial came to an end.
std::optional<ChosenDuration> try_on(Resolved model, double asked) {
  const double allowed = margin * asked;
  double duration = automatic_duration(model);
  for (int trial = 1; trial <= most_duration_trials; ++trial) {
    const auto share = share_at(model, duration);
    if (!share) {
      duration *= longest_leap;
      continue;
    }
    if (*share == 0.0) return ChosenDuration{duration, 0.0, model.mesh.cells.size(), trial};
    const double times = std::sqrt(*share / allowed);
    const double next = duration * std::clamp(times, 1.0 / longest_leap, longest_leap);
    if ((times <= near_enough && times >= 1.0 / near_enough) || trial == most_duration_trials) {
      const double chosen = rounded_up_to_three(next);
      return ChosenDuration{chosen, *share * std::pow(duration / chosen, 2), model.mesh.cells.size(), trial};
    }
    duration = next;
  }
  return std::nullopt;
}

// None where so coarse a mesh is too small or does not fit the blank or its tools.
std::optional<Resolved> trial_model(const Scene& scene, const std::string& scene_file,
                                    const std::vector<std::string>& overrides, double factor) {
  auto coarser = overrides;
  for (const std::string& coarsening : coarsened(scene, factor)) coarser.push_back(coarsening);
  coarser.emplace_back("analysis.perturbation=0.0");  // a perturbed run is two runs
  coarser.emplace_back("output.history=200");         // the share is read off the rows, however few the scene wants
  try {
    Resolved model = checked_model(scene_file, coarser, false, Look::for_first_complaint);
    if (factor > 1.0 && model.mesh.cells.size() < least_cells) return std::nullopt;
    return model;
  } catch (const InputError&) {
    if (factor == 1.0) throw;
    return std::nullopt;
  }
}

std::string reason(const ChosenDuration& chosen) {
  return fmt::format("inertia is {:.2g} % of the loads: from {} on a mesh of {} cells", 100.0 * chosen.share,
                     chosen.trials == 1 ? "a trial" : fmt::format("{} trials", chosen.trials), chosen.cells);
}

}  // namespace

std::optional<ChosenDuration> choose_duration(const std::string& scene_file,
                                              const std::vector<std::string>& overrides) {
  if (!leaves_open(read_scene(scene_file, overrides), duration_key)) return std::nullopt;
  const Scene scene = read_taken_scene(scene_file, overrides);
  const AnalysisSpec& analysis = scene.analysis;
  for (const double factor : trial_factors) {
    auto model = trial_model(scene, scene_file, overrides, factor);
    const auto chosen = model ? try_on(std::move(*model), *analysis.inertia) : std::nullopt;
    if (!chosen) continue;
    if (chosen->share > 0.0) return chosen;
    throw InputError(
        fmt::format("{}: analysis.inertia asks for a duration by the inertia of what moves, and nothing does but by "
                    "gravity or not at all; give analysis.duration",
                    scene.file));
  }
  throw PhysicsError(fmt::format(
      "{}: no trial came to its end at which a duration for analysis.inertia could be read; give analysis.duration",
      scene.file));
}

void set_duration(Resolved& model, const std::optional<ChosenDuration>& chosen) {
  if (!chosen) return;
  give_duration(model, chosen->duration);
  model.scene.taken.push_back({duration_key, toml_text(chosen->duration).value_or(""), reason(*chosen), ""});
}

std::vector<std::string> with_duration(std::vector<std::string> overrides,
                                       const std::optional<ChosenDuration>& chosen) {
  if (chosen) overrides.push_back(fmt::format("analysis.duration={:.17g}", chosen->duration));
  return overrides;
}

}  // namespace weaveform
