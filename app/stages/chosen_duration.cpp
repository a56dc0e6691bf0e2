#include "app/stages/chosen_duration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "app/stages/checked_model.hpp"
#include "core/error.hpp"
#include "core/keys/advice.hpp"
#include "core/keys/key_value.hpp"
#include "mesher/automatic/take.hpp"
#include "mesher/scene/overrides.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/scene/taken.hpp"
#include "post/trust/gentle_course.hpp"
#include "post/trust/inertia.hpp"
#include "solver/analysis/loading.hpp"
#include "solver/solve.hpp"

namespace weaveform {
namespace {

constexpr std::array trial_factors = {8.0, 4.0, 2.0, 1.0};  // of coarsening, coarsest first
constexpr int least_cells = 150;  // of a trial's mesh: coarser ones bear too few chords for their loads to mean much
// A last trial on a mesh twice as fine sets the duration right, where it is an eighth of the run's work at most, or where
// the trials' mesh has so few cells that shares move by a half to the next one, and the run is short.
constexpr double finest_correction = 2.0;  // of coarsening
constexpr int few_cells = 300;             // of a ply
constexpr int most_duration_trials = 6;    // for each course
constexpr int most_failures = 2;           // of them: what breaks eight times as slowly too, breaks at any speed
constexpr double near_enough = 1.5;        // times the duration: from a trial within it the share is scaled
constexpr double longest_leap = 8.0;       // times the duration, from one trial to the next
// times the smooth step's duration that the gentle course may take: inertia then is at its end a tenth of its greatest
// share, and not most of it (docs/stability.md)
constexpr double worth_its_end = 1.1;
constexpr double margin = 0.9;  // of the share asked: a finer mesh may have a little more

template <class Change>
void change_scenes(Resolved& model, Change change) {
  change(model.scene);
  for (Resolved& ply : model.ply) change(ply.scene);
}

void give_duration(Resolved& model, double duration) {
  change_scenes(model, [&](Scene& scene) { scene.analysis.duration = duration; });
}

void give_speed(Resolved& model, const std::vector<std::string>& tools, const SpeedTable& speed) {
  change_scenes(model, [&](Scene& scene) {
    for (ToolSpec& tool : scene.tools)
      if (std::find(tools.begin(), tools.end(), tool.name) != tools.end()) tool.speed = speed;
  });
}

// Names of the tools that travel, where nothing else does and none has a speed of its own; else none.
std::vector<std::string> without_speed(const Scene& scene) {
  const auto travels = [](const auto& part) { return part.travel != 0.0; };
  if (scene.frame || std::any_of(scene.grip.begin(), scene.grip.end(), travels)) return {};
  std::vector<std::string> names;
  for (const ToolSpec& tool : scene.tools) {
    if (!travels(tool)) continue;
    if (!tool.speed.empty()) return {};
    names.push_back(tool.name);
  }
  return names;
}

// A trial that came to its end. Its share goes with 1/duration^2.
struct DurationTrial {
  double duration = 0.0, share = 0.0;  // s, 1
  History history;
  [[nodiscard]] double duration_for(double allowed) const {
    return std::stod(fmt::format("{:.3g}", rounded_up(duration * std::sqrt(share / allowed), 3)));
  }
  [[nodiscard]] double share_in(double other) const { return share * std::pow(duration / other, 2); }
};

// None when the fabric does not survive so fast a loading.
std::optional<DurationTrial> try_duration(Resolved& model, double duration) {
  give_duration(model, duration);
  try {
    SolveResult result = solve(model, {}, {.threads = 1, .quiet = true});
    const double share = inertia_share(model.scene, result.history, result.statistics.damping_per_s).share;
    return DurationTrial{duration, std::abs(share), std::move(result.history)};
  } catch (const PhysicsError&) {
    return std::nullopt;
  }
}

// From a first duration to one near that of the share allowed; adds to the number of trials. None when none came to its
// end.
std::optional<DurationTrial> approach(Resolved& model, double duration, double allowed, int& trials) {
  std::optional<DurationTrial> latest;
  int failures = 0;
  for (int n = 0; n < most_duration_trials && failures < most_failures; ++n) {
    ++trials;
    auto trial = try_duration(model, duration);
    if (!trial) {
      ++failures;
      duration *= longest_leap;
      continue;
    }
    latest = std::move(trial);
    if (latest->share == 0.0) break;
    const double times = std::sqrt(latest->share / allowed);
    if (times <= near_enough && times >= 1.0 / near_enough) break;
    duration *= std::clamp(times, 1.0 / longest_leap, longest_leap);
  }
  return latest;
}

// None when no trial came to its end; a share of 0 when nothing moves that could be slower.
std::optional<ChosenDuration> try_on(Resolved model, double allowed) {
  ChosenDuration chosen{.cells = {model.mesh.cells.size()}};
  const auto own = approach(model, automatic_duration(model), allowed, chosen.trials);
  if (!own || own->share == 0.0) return own ? std::optional(chosen) : std::nullopt;
  chosen.duration = own->duration_for(allowed);
  chosen.share = own->share_in(chosen.duration);
  const auto tools = without_speed(model.scene);
  if (tools.empty()) return chosen;
  const SpeedTable speed = gentle_course(own->history, tools.front());  // all make the same part of their way at a time
  give_speed(model, tools, speed);
  const auto gentle = approach(model, chosen.duration, allowed, chosen.trials);
  if (!gentle || gentle->duration_for(allowed) > worth_its_end * chosen.duration) return chosen;
  chosen.smooth_duration = std::exchange(chosen.duration, gentle->duration_for(allowed));
  chosen.share = gentle->share_in(chosen.duration);
  chosen.tools = tools;
  chosen.speed = speed;
  return chosen;
}

// A last trial on a finer mesh, which sets the duration right.
void correct(ChosenDuration& chosen, Resolved finer, double allowed) {
  give_speed(finer, chosen.tools, chosen.speed);
  ++chosen.trials;
  chosen.cells.push_back(finer.mesh.cells.size());
  const auto trial = try_duration(finer, chosen.duration);
  if (!trial || trial->share == 0.0) return;
  chosen.duration = trial->duration_for(allowed);
  chosen.share = trial->share_in(chosen.duration);
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

std::string reason_of_duration(const ChosenDuration& chosen) {
  std::string words =
      fmt::format("inertia is {:.2g} % of the loads: from {} on a mesh of {} cells", 100.0 * chosen.share,
                  chosen.trials == 1 ? "a trial" : fmt::format("{} trials", chosen.trials), chosen.cells.front());
  if (chosen.cells.size() > 1) words += fmt::format(", the last one of {}", chosen.cells.back());
  return words;
}

std::string reason_of_speed(const ChosenDuration& chosen) {
  return fmt::format(
      "kinetic energy rises and falls evenly along the way, to little at its end (docs/stability.md); the smooth step "
      "takes {:.3g} s for that share of inertia",
      chosen.smooth_duration);
}

}  // namespace

std::optional<ChosenDuration> choose_duration(const std::string& scene_file,
                                              const std::vector<std::string>& overrides) {
  if (!leaves_open(read_scene(scene_file, overrides), duration_key)) return std::nullopt;
  const Scene scene = read_taken_scene(scene_file, overrides);
  const double allowed = margin * *scene.analysis.inertia;
  const int plies = std::max(1, static_cast<int>(scene.ply.size()));
  for (const double factor : trial_factors) {
    auto model = trial_model(scene, scene_file, overrides, factor);
    auto chosen = model ? try_on(std::move(*model), allowed) : std::nullopt;
    if (!chosen) continue;
    if (chosen->share == 0.0)
      throw InputError(
          fmt::format("{}: analysis.inertia asks for a duration by the inertia of what moves, and nothing does but by "
                      "gravity or not at all; give analysis.duration",
                      scene.file));
    if (0.5 * factor >= finest_correction || (factor > 1.0 && chosen->cells.front() < few_cells * plies))
      if (auto finer = trial_model(scene, scene_file, overrides, 0.5 * factor))
        correct(*chosen, std::move(*finer), allowed);
    return chosen;
  }
  throw PhysicsError(fmt::format(
      "{}: no trial came to its end at which a duration for analysis.inertia could be read; give analysis.duration",
      scene.file));
}

void set_duration(Resolved& model, const std::optional<ChosenDuration>& chosen) {
  if (!chosen) return;
  give_duration(model, chosen->duration);
  model.scene.taken.push_back(
      {duration_key, toml_text(chosen->duration).value_or(""), reason_of_duration(*chosen), ""});
  give_speed(model, chosen->tools, chosen->speed);
  for (const std::string& tool : chosen->tools)
    model.scene.taken.push_back({speed_key(tool), toml_text(chosen->speed).value_or(""), reason_of_speed(*chosen), ""});
}

std::vector<std::string> with_duration(std::vector<std::string> overrides,
                                       const std::optional<ChosenDuration>& chosen) {
  if (!chosen) return overrides;
  overrides.push_back(fmt::format("analysis.duration={:.17g}", chosen->duration));
  for (const std::string& tool : chosen->tools)
    overrides.push_back(speed_key(tool) + "=" + toml_text(chosen->speed).value_or(""));
  return overrides;
}

}  // namespace weaveform
