#include "post/post.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/vector/angle.hpp"
#include "core/vector/append.hpp"
#include "mesher/scene/taken.hpp"
#include "post/forming/forming.hpp"
#include "post/measure/bias_comparison.hpp"
#include "post/output/contours.hpp"
#include "post/output/summary.hpp"
#include "post/trust/assumptions.hpp"
#include "post/trust/warnings.hpp"
#include "solver/result/stack_fields.hpp"

namespace weaveform {

namespace {

std::string unfinished_warning(const SolveStatistics& s) {
  return fmt::format(
      "this run is not finished: everything here is of t = {:.4g} s of {:.4g} s ({:.3g} %); go on with "
      "--resume",
      s.time_s, s.duration_s, s.duration_s > 0.0 ? 100.0 * s.time_s / s.duration_s : 0.0);
}

// Forming has looked at them already, for it knows the tools.
Waves waves_of(const Resolved& ply, const Fields& end, const std::optional<Forming>& forming) {
  return forming ? forming->waves : evaluate_waves(ply.scene.model, ply.mesh, end, nullptr);
}

// Of a stack each ply by itself.
PlySummary summarise_ply(const Resolved& model, std::size_t number, const Fields& end, const History& history) {
  const Resolved& ply = model.ply[number];
  PlySummary summary;
  summary.name = model.mesh.ply[number].name;
  summary.material = ply.card.name;
  summary.cells = ply.mesh.cells.size();
  const int most = most_sheared_cell(end);
  summary.max_shear_angle = std::abs(end.shear_angle[most]) * degrees_per_radian;
  summary.at = cell_centre(ply.mesh.cells, most, end.position);
  for (const double strain : end.yarn_strain) summary.max_yarn_strain = std::max(summary.max_yarn_strain, strain);
  summary.folded = static_cast<int>(std::count(end.folded.begin(), end.folded.end(), true));
  for (const double angle : end.shear_angle)
    summary.beyond_card += std::abs(angle) * degrees_per_radian > ply.card.shear.valid_to_deg ? 1 : 0;
  summary.forming = evaluate_forming(ply.scene, ply.mesh, ply.tools, end, history);
  summary.folds = find_folds(ply.scene, ply.mesh, end.position);
  summary.waves = waves_of(ply, end, summary.forming);
  return summary;
}

// Numbers of cells and nodes in a ply's lines are the ply's own.
void evaluate_plies(const Resolved& model, const Fields& end, const History& history, Summary& summary) {
  std::vector<std::string> of_plies;
  for (std::size_t k = 0; k < model.ply.size(); ++k) {
    const Resolved& ply = model.ply[k];
    const Fields own = fields_of_ply(end, model.mesh, k);
    summary.ply.push_back(summarise_ply(model, k, own, history));
    Summary of_ply;
    of_ply.statistics = summary.statistics;
    of_ply.forming = summary.ply.back().forming;
    of_ply.folds = summary.ply.back().folds;
    of_ply.waves = summary.ply.back().waves;
    const FinishedRun run{ply.scene, ply.card, ply.mesh, ply.tools, ply.extent(), own, history, of_ply};
    for (const std::string& line : warnings(run, WarningsOf::one_ply)) of_plies.push_back(name_before(model, k) + line);
    for (TakenSummary& taken : judge_taken(run)) {
      if (taken.taken.key == duration_key && k > 0) continue;  // every ply's, and the same
      taken.taken = of_stack(std::move(taken.taken), summary.ply.back().name);
      summary.taken.push_back(std::move(taken));
    }
  }
  summary.warning = warnings({model.scene, model.card, model.mesh, model.tools, model.extent(), end, history, summary},
                             WarningsOf::whole_run);
  append(summary.warning, of_plies);
}

std::vector<Isoline> isolines_of(const Resolved& model, const Fields& end) {
  const double step = model.scene.output.contour_step;
  if (model.ply.empty()) return shear_angle_isolines(model.mesh, end, step);
  std::vector<Isoline> all;
  for (std::size_t k = 0; k < model.ply.size(); ++k)
    for (Isoline& line : shear_angle_isolines(model.ply[k].mesh, fields_of_ply(end, model.mesh, k), step)) {
      line.ply = static_cast<int>(k);
      all.push_back(std::move(line));
    }
  return all;
}

// A specimen, or a stack of them in the same grips.
std::optional<BiasComparison> compare_with_bias_extension(const Resolved& model, const Fields& end,
                                                          const History& history) {
  std::vector<const Scene*> scenes;
  for (std::size_t k = 0; k < model.plies(); ++k) scenes.push_back(&model.of_ply(k).scene);
  const auto specimen = find_bias_extension(scenes);
  if (!specimen) return std::nullopt;
  std::vector<BiasPly> plies;
  for (std::size_t k = 0; k < model.plies(); ++k) {
    const Resolved& ply = model.of_ply(k);
    plies.push_back({ply.scene, ply.card, ply.mesh, model.ply.empty() ? end : fields_of_ply(end, model.mesh, k)});
  }
  return compare_bias_extension(*specimen, model.scene, plies, history);
}

// What forming says of a ply stands in its own folder.
void write_forming_of_plies(const Resolved& model, const Evaluation& evaluation,
                            const std::filesystem::path& directory) {
  remove_files(directory, ply_files());
  for (std::size_t k = 0; k < model.ply.size(); ++k) {
    const PlySummary& ply = evaluation.summary.ply[k];
    if (!ply.forming) continue;
    write_forming(*ply.forming, model.ply[k].mesh, fields_of_ply(evaluation.end, model.mesh, k),
                  ply_folder(directory, ply.name));
  }
}

std::vector<const Card*> cards_of(const Resolved& model) {
  std::vector<const Card*> cards;
  for (std::size_t k = 0; k < model.plies(); ++k) cards.push_back(&model.of_ply(k).card);
  return cards;
}

}  // namespace

Evaluation evaluate(ResultFolder& folder) {
  const Scene& scene = folder.scene();
  const SolveStatistics& statistics = folder.statistics();
  const FrameFile& last = folder.frames().back();
  const std::vector<Vec3> position = folder.positions(last);
  const History& history = folder.history();
  const Resolved& model = folder.model();
  const Card& card = model.card;
  const Mesh& mesh = model.mesh;
  // computed anew from the positions, so that post and solver share one formula
  Evaluation evaluation{compute_fields(model, last.time, position), {}};
  const Fields& end = evaluation.end;
  Summary& summary = evaluation.summary;
  summary.statistics = statistics;
  summary.grip = summarise_grips(scene, history);
  summary.tool = summarise_tools(scene, history);
  summary.measure = summarise_measures(scene, history);
  if (scene.frame) summary.frame = compare_shear_frame(model.of_ply(0).scene, cards_of(model), history);
  summary.bias = compare_with_bias_extension(model, end, history);
  if (model.ply.empty()) {
    summary.forming = evaluate_forming(scene, mesh, model.tools, end, history);
    summary.folds = find_folds(scene, mesh, end.position);
    summary.waves = waves_of(model, end, summary.forming);
    const FinishedRun run{scene, card, mesh, model.tools, model.extent(), end, history, summary};
    summary.warning = warnings(run);
    summary.taken = judge_taken(run);
  } else {
    evaluate_plies(model, end, history, summary);
  }
  if (!statistics.finished) summary.warning.insert(summary.warning.begin(), unfinished_warning(statistics));
  return evaluation;
}

PostAnswers post_process(ResultFolder& folder) {
  return post_process(folder, evaluate(folder));
}

PostAnswers post_process(ResultFolder& folder, const Evaluation& evaluation) {
  const auto& [end, summary] = evaluation;
  const Resolved& model = folder.model();
  const std::filesystem::path& directory = folder.directory();
  write_contours(isolines_of(model, end), directory / file_name::contours, !model.ply.empty());
  if (summary.forming) write_forming(*summary.forming, model.mesh, end, directory);
  if (!model.ply.empty()) write_forming_of_plies(model, evaluation, directory);
  write_summary(summary, directory / file_name::summary);
  return {summary_table(summary), summary.warning};
}

FileNames ply_files() {
  return in_ply_folders(forming_files());
}

FileNames post_files() {
  return joined({{file_name::contours, file_name::summary}, forming_files(), ply_files()});
}

}  // namespace weaveform
