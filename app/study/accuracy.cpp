#include "app/study/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/study/cases.hpp"
#include "app/study/convergence_report.hpp"
#include "app/study/measure.hpp"
#include "app/study/runner.hpp"
#include "core/error.hpp"
#include "mesher/automatic/take.hpp"
#include "post/convergence/convergence.hpp"
#include "post/report/words.hpp"

namespace weaveform::study {

namespace fs = std::filesystem;

namespace {

constexpr double coarsest = 8.0;
constexpr double least_coarsening = 0.05, greatest_coarsening = 100.0;  // of blank.coarsening

struct SolvedLevel {
  double factor = 0.0;
  fs::path results;
  double size = 0.0, wall = 0.0;  // mm, s
  std::vector<double> value;      // of each measure
};

std::vector<double> factors(const Scene& scene, double finest) {
  std::vector<double> list;
  const auto allowed = [&](double factor) {
    const auto fits = [factor](const BlankSpec& blank) {
      const auto& c = blank.coarsening;
      return std::max(c[0], c[1]) * factor <= greatest_coarsening && std::min(c[0], c[1]) * factor >= least_coarsening;
    };
    return fits(scene.blank) &&
           std::all_of(scene.ply.begin(), scene.ply.end(), [&](const PlySpec& ply) { return fits(ply.blank); });
  };
  for (double factor = coarsest; factor >= finest * (1.0 - 1e-9); factor *= 0.5)
    if (allowed(factor)) list.push_back(factor);
  return list;
}

// "coarsening_x4_1c9f02ab": a person reads the level, and the digest keeps levels of different scenes apart.
std::string level_name(double factor, const std::string& text) {
  return fmt::format("coarsening_x{:g}_{}", factor, case_name(text).substr(0, 8));
}

std::optional<SolvedLevel> solve_level(const Scene& scene, double factor, const std::vector<std::string>& measures,
                                       const fs::path& folder, const AccuracyOptions& options, Outcome& outcome_now) {
  Scene coarser = scene;
  for (double& coarsening : coarser.blank.coarsening) coarsening *= factor;
  for (PlySpec& ply : coarser.ply)
    for (double& coarsening : ply.blank.coarsening) coarsening *= factor;
  const std::string text = case_text(coarser);
  Setting setting{"blank.coarsening",
                  fmt::format("[{}, {}]", coarser.blank.coarsening[0], coarser.blank.coarsening[1]),
                  std::nullopt,
                  {}};
  const Case one{level_name(factor, text), text, {setting}};
  RunOptions run;
  run.threads = options.threads;
  run.stop_requested = options.stop_requested;
  run_cases({one}, folder, run);
  const CaseFiles files = case_files(folder, one.name);
  const auto ended = outcome(files, text);
  outcome_now = ended.value_or(Outcome{1, "left no result"});
  if (outcome_now.exit_code != 0) {
    options.log(fmt::format("coarsening x {:g}: left out: {}", factor, outcome_now.error));
    return std::nullopt;
  }
  SolvedLevel level{factor, files.results, mesh_size(files.results), measure(files.results, "wall_s"), {}};
  options.log(fmt::format("coarsening x {:g}: spacing {:.4g} mm, solved in {:.3g} s", factor, level.size, level.wall));
  for (const std::string& name : measures) level.value.push_back(measure(files.results, name));
  return level;
}

// Forces are judged by the greatest of them: one near zero has no relative error of its own.
std::vector<double> scales(const std::vector<std::string>& measures, const SolvedLevel& finest) {
  const auto is_force = [](const std::string& name) { return name.find("force_N") != std::string::npos; };
  double greatest = 0.0;
  for (std::size_t m = 0; m < measures.size(); ++m)
    if (is_force(measures[m])) greatest = std::max(greatest, std::abs(finest.value[m]));
  std::vector<double> scale;
  for (const std::string& name : measures) scale.push_back(is_force(name) ? greatest : 0.0);
  return scale;
}

std::vector<Refinement> refinements(const std::vector<std::string>& measures, const std::vector<SolvedLevel>& levels) {
  std::vector<Refinement> all;
  const std::vector<double> scale = scales(measures, levels.back());
  for (std::size_t m = 0; m < measures.size(); ++m) {
    std::vector<Level> values;
    for (const SolvedLevel& level : levels) values.push_back({level.size, level.value[m]});
    all.push_back(refine(std::move(values), 2.0, scale[m]));
  }
  return all;
}

// Index, finest first, of the coarsest level that is within the tolerance for all measures; -1: none.
int coarsest_of_all(const std::vector<Refinement>& all, double tolerance) {
  int index = static_cast<int>(all.front().level.size()) - 1;
  for (const Refinement& one : all) index = std::min(index, coarsest_within(one, tolerance));
  return index;
}

std::string table_of(const std::vector<std::string>& measures, const std::vector<SolvedLevel>& levels,
                     const std::vector<Refinement>& all) {
  std::string text = "| coarsening | spacing | solve |";
  for (const std::string& name : measures) text += fmt::format(" {} | error at most |", measure_in_words(name));
  text += "\n|---:|---:|---:|";
  for (std::size_t m = 0; m < measures.size(); ++m) text += "---:|---:|";
  for (std::size_t l = 0; l < levels.size(); ++l) {
    text += fmt::format("\n| x {:g} | {:.4g} mm | {:.3g} s |", levels[l].factor, levels[l].size, levels[l].wall);
    for (std::size_t m = 0; m < measures.size(); ++m) {
      text += fmt::format(" {:.6g} |", levels[l].value[m]);
      text +=
          all.empty() ? " unknown |" : fmt::format(" {:.3g} % |", 100.0 * all[m].error_bound[levels.size() - 1 - l]);
    }
  }
  text += "\n";
  for (std::size_t m = 0; m < all.size(); ++m)
    text += fmt::format("{}: {}\n", measure_in_words(measures[m]), verdict(all[m]));
  return text;
}

nlohmann::ordered_json json_of(const std::vector<std::string>& measures, const std::vector<SolvedLevel>& levels,
                               const std::vector<Refinement>& all) {
  using Json = nlohmann::ordered_json;
  Json json = {{"levels", Json::array()}, {"verdicts", Json::object()}};
  for (std::size_t l = 0; l < levels.size(); ++l) {
    Json values = Json::object();
    for (std::size_t m = 0; m < measures.size(); ++m)
      values[measures[m]] = {
          {"value", levels[l].value[m]},
          {"error_bound", all.empty() ? Json(nullptr) : Json(all[m].error_bound[levels.size() - 1 - l])}};
    json["levels"].push_back({{"coarsening_factor", levels[l].factor},
                              {"mesh_size_mm", levels[l].size},
                              {"wall_s", levels[l].wall},
                              {"measures", values}});
  }
  for (std::size_t m = 0; m < all.size(); ++m) json["verdicts"][measures[m]] = verdict(all[m]);
  return json;
}

Accuracy accuracy_of(bool met, const SolvedLevel& taken, const std::vector<std::string>& measures,
                     const std::vector<SolvedLevel>& levels, const std::vector<Refinement>& all) {
  nlohmann::ordered_json json = {{"met", met}, {"coarsening_factor", taken.factor}};
  json.update(json_of(measures, levels, all));
  return {met, taken.factor, taken.results, table_of(measures, levels, all), std::move(json)};
}

}  // namespace

double parse_accuracy(const std::string& text) {
  std::string digits = text;
  const bool percent = digits.ends_with('%');
  if (percent) digits.pop_back();
  while (digits.ends_with(' ')) digits.pop_back();
  std::size_t read = 0;
  double value = -1.0;
  try {
    value = std::stod(digits, &read);
  } catch (const std::exception&) {
    read = std::string::npos;
  }
  if (percent) value /= 100.0;
  if (read != digits.size() || !(value > 0.0 && value < 1.0))
    throw InputError(fmt::format("--accuracy '{}' is no relative error; write for example 2% or 0.02", text));
  return value;
}

Accuracy find_accuracy(const fs::path& scene_file, const std::vector<std::string>& overrides, const fs::path& directory,
                       const AccuracyOptions& options) {
  const Scene scene = read_taken_scene(scene_file, overrides);
  const std::vector<std::string> measures = options.measures.empty() ? default_measures(scene) : options.measures;
  const fs::path folder = directory / report_name::levels;
  std::vector<SolvedLevel> levels;  // coarsest first
  std::vector<Refinement> all;
  Outcome last;
  for (const double factor : factors(scene, options.finest)) {
    const auto level = solve_level(scene, factor, measures, folder, options, last);
    if (!level) continue;
    // A coarser level that was fitted to the grips may have come out with the same mesh.
    if (!levels.empty() && std::abs(levels.back().size - level->size) < 1e-6 * level->size) levels.pop_back();
    levels.push_back(*level);
    if (levels.size() < 3) continue;
    all = refinements(measures, levels);
    const int index = coarsest_of_all(all, options.tolerance);
    if (index < 0) continue;
    const SolvedLevel& taken = levels[levels.size() - 1 - static_cast<std::size_t>(index)];
    return accuracy_of(true, taken, measures, levels, all);
  }
  if (levels.empty() || last.exit_code != 0)
    throw PhysicsError(
        fmt::format("the finest level failed, and without it nothing is known of the error: {}", last.error));
  return accuracy_of(false, levels.back(), measures, levels, all);
}

}  // namespace weaveform::study
