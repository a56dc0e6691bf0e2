#include "app/stages/chosen_duration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "app/stages/checked_model.hpp"
#include "core/error.hpp"
#include "core/keys/advice.hpp"
#include "core/keys/key_value.hpp"
#include "mesher/automatic/take.hpp"
#include "mesher/resolve/resolve.hpp"
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
// A last trial on a mesh twice as fine sets the duration right, where it is an eighth of the run's work at most.
constexpr double finest_correction = 2.0;  // of coarsening
// Where a ply of the trials' mesh has so few cells, shares move by up to a half to the next one. Without a last trial,
// which would be as dear as the run, they are kept that much lower: the run had 1.1, 1.3 and 1.6 times the share of the
// trials, on meshes of 192, 260 (a ply) and 166 cells (tutorial/forming.toml, hemisphere_two_plies.toml,
// recipes/own_outline.toml).
constexpr int few_cells = 300;
constexpr double margin_of_few = 0.6 / 0.9;  // of the share allowed otherwise
constexpr int most_duration_trials = 6;      // for each course
constexpr int most_failures = 2;             // of them: what breaks eight times as slowly too, breaks at any speed
constexpr double near_enough = 1.5;          // times the duration: from a trial within it the share is scaled
constexpr double longest_leap = 8.0;         // times the duration, from one trial to the next
// times the smooth step's duration that the gentle course may take: inertia then is at its end a tenth of its greatest
// share, and not most of it (docs/stability.md)
constexpr double worth_its_end = 1.1;
constexpr int trial_rows = 200;  // of history: the share is read off them, however few the scene wants
constexpr double margin = 0.9;   // of the share asked: a finer mesh may have a little more

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

// The trials of one choice, and what they have come to so far.
class DurationTrials {
public:
  DurationTrials(double allowed, const std::function<bool()>& stop) : allowed_(allowed), stop_(stop) {}

  // None when no trial came to its end; a share of 0 when nothing moves that could be slower. Throws Interrupted.
  std::optional<ChosenDuration> try_on(Resolved model);

  // A last trial on a finer mesh, which sets the duration right. Throws Interrupted.
  void correct(ChosenDuration& chosen, Resolved finer);

  // s; as the last trial had it; 0 before.
  [[nodiscard]] double so_far() const { return so_far_; }

private:
  std::optional<DurationTrial> run(Resolved& model, double duration);
  std::optional<DurationTrial> approach(Resolved& model, double duration);

  double allowed_;
  std::function<bool()> stop_;
  int count_ = 0;
  double so_far_ = 0.0;  // s
};

// None when the fabric does not survive so fast a loading.
std::optional<DurationTrial> DurationTrials::run(Resolved& model, double duration) {
  ++count_;
  give_duration(model, duration);
  try {
    SolveResult result = solve(model, {}, {.threads = 1, .quiet = true, .stop_requested = stop_});
    const double share = inertia_share(model.scene, result.history, result.statistics.damping_per_s).share;
    DurationTrial trial{duration, std::abs(share), std::move(result.history)};
    so_far_ = trial.duration_for(allowed_);
    return trial;
  } catch (const PhysicsError&) {
    return std::nullopt;
  }
}

// From a first duration to one near that of the share allowed. None when none came to its end.
std::optional<DurationTrial> DurationTrials::approach(Resolved& model, double duration) {
  std::optional<DurationTrial> latest;
  int failures = 0;
  for (int n = 0; n < most_duration_trials && failures < most_failures; ++n) {
    auto trial = run(model, duration);
    if (!trial) {
      ++failures;
      duration *= longest_leap;
      continue;
    }
    latest = std::move(trial);
    if (latest->share == 0.0) break;
    const double times = std::sqrt(latest->share / allowed_);
    if (times <= near_enough && times >= 1.0 / near_enough) break;
    duration *= std::clamp(times, 1.0 / longest_leap, longest_leap);
  }
  return latest;
}

std::optional<ChosenDuration> DurationTrials::try_on(Resolved model) {
  ChosenDuration chosen{.cells = {model.mesh.cells.size()}};
  const auto own = approach(model, automatic_duration(model));
  chosen.trials = count_;
  if (!own || own->share == 0.0) return own ? std::optional(chosen) : std::nullopt;
  chosen.duration = own->duration_for(allowed_);
  chosen.share = own->share_in(chosen.duration);
  const auto tools = without_speed(model.scene);
  if (tools.empty()) return chosen;
  const SpeedTable speed = gentle_course(own->history, tools.front());  // all make the same part of their way at a time
  give_speed(model, tools, speed);
  const auto gentle = approach(model, chosen.duration);
  chosen.trials = count_;
  if (!gentle || gentle->duration_for(allowed_) > worth_its_end * chosen.duration) return chosen;
  chosen.smooth_duration = std::exchange(chosen.duration, gentle->duration_for(allowed_));
  chosen.share = gentle->share_in(chosen.duration);
  chosen.tools = tools;
  chosen.speed = speed;
  return chosen;
}

void DurationTrials::correct(ChosenDuration& chosen, Resolved finer) {
  give_speed(finer, chosen.tools, chosen.speed);
  chosen.cells.push_back(finer.mesh.cells.size());
  const auto trial = run(finer, chosen.duration);
  chosen.trials = count_;
  if (!trial || trial->share == 0.0) return;
  chosen.duration = trial->duration_for(allowed_);
  chosen.share = trial->share_in(chosen.duration);
}

// None where so coarse a mesh is too small or does not fit the blank or its tools.
std::optional<Resolved> trial_model(const Scene& scene, const std::string& scene_file,
                                    const std::vector<std::string>& overrides, double factor) {
  auto coarser = overrides;
  for (const std::string& coarsening : coarsened(scene, factor)) coarser.push_back(coarsening);
  coarser.emplace_back("analysis.perturbation=0.0");  // a perturbed run is two runs
  coarser.push_back(fmt::format("output.history={}", trial_rows));
  try {
    Resolved model = checked_model(scene_file, coarser, false, Look::for_first_complaint);
    if (factor > 1.0 && model.mesh.cells.size() < least_cells) return std::nullopt;
    return model;
  } catch (const InputError&) {
    if (factor == 1.0) throw;
    return std::nullopt;
  }
}

double allowed_share(const Scene& scene) {
  return margin * *scene.analysis.inertia;
}

void require_motion(const ChosenDuration& chosen, const Scene& scene) {
  if (chosen.share == 0.0)
    throw InputError(
        fmt::format("{}: analysis.inertia asks for a duration by the inertia of what moves, and nothing does but by "
                    "gravity or not at all; give analysis.duration",
                    scene.file));
}

// The share of the trials by margin_of_few.
void keep_lower(ChosenDuration& chosen) {
  const double slower = 1.0 / std::sqrt(margin_of_few);
  const double before = chosen.duration;
  chosen.duration = std::stod(fmt::format("{:.3g}", rounded_up(before * slower, 3)));
  chosen.smooth_duration *= slower;
  chosen.share *= std::pow(before / chosen.duration, 2);
}

[[noreturn]] void throw_without_trial(const Scene& scene) {
  throw PhysicsError(fmt::format(
      "{}: no trial came to its end at which a duration for analysis.inertia could be read; give analysis.duration",
      scene.file));
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

std::optional<ChosenDuration> choose_duration(const std::string& scene_file, const std::vector<std::string>& overrides,
                                              const std::function<bool()>& stop) {
  if (!leaves_open(read_scene(scene_file, overrides), duration_key)) return std::nullopt;
  const Scene scene = read_taken_scene(scene_file, overrides);
  const int plies = std::max(1, static_cast<int>(scene.ply.size()));
  for (const double factor : trial_factors) {
    auto model = trial_model(scene, scene_file, overrides, factor);
    if (!model) continue;
    DurationTrials trials(allowed_share(scene), stop);
    try {
      auto chosen = trials.try_on(std::move(*model));
      if (!chosen) continue;
      require_motion(*chosen, scene);
      if (0.5 * factor >= finest_correction) {
        if (auto finer = trial_model(scene, scene_file, overrides, 0.5 * factor))
          trials.correct(*chosen, std::move(*finer));
      } else if (factor > 1.0 && chosen->cells.front() < few_cells * plies) {
        keep_lower(*chosen);
      }
      return chosen;
    } catch (const Interrupted&) {
      throw TrialsStopped(trials.so_far());
    }
  }
  throw_without_trial(scene);
}

std::optional<ChosenDuration> choose_duration(const Resolved& model, const std::function<bool()>& stop) {
  if (!leaves_open(model.scene, duration_key)) return std::nullopt;
  Resolved trial = without_perturbation(model);
  change_scenes(trial, [](Scene& scene) { scene.output.history = trial_rows; });
  DurationTrials trials(allowed_share(model.scene), stop);
  const auto chosen = trials.try_on(std::move(trial));
  if (!chosen) throw_without_trial(model.scene);
  require_motion(*chosen, model.scene);
  return chosen;
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
