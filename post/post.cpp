#include "post/post.hpp"

#include <fmt/format.h>

#include "post/forming/forming.hpp"
#include "post/measure/bias_comparison.hpp"
#include "post/output/contours.hpp"
#include "post/output/summary.hpp"
#include "post/trust/warnings.hpp"

namespace weaveform {

namespace {

std::string unfinished_warning(const SolveStatistics& s) {
  return fmt::format(
      "this run is not finished: everything here is of t = {:.4g} s of {:.4g} s ({:.3g} %); go on with "
      "--resume",
      s.time_s, s.duration_s, s.duration_s > 0.0 ? 100.0 * s.time_s / s.duration_s : 0.0);
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
  Evaluation evaluation{compute_fields(mesh, card, scene.model, last.time, position), {}};
  const Fields& end = evaluation.end;
  Summary& summary = evaluation.summary;
  summary.statistics = statistics;
  summary.grip = summarise_grips(scene, history);
  summary.tool = summarise_tools(scene, history);
  summary.measure = summarise_measures(scene, history);
  if (const auto specimen = find_bias_extension(scene))
    summary.bias = compare_bias_extension(*specimen, scene, card, mesh, end, history);
  if (scene.frame) summary.frame = compare_shear_frame(scene, card, history);
  summary.forming = evaluate_forming(scene, mesh, model.tools, end, history);
  summary.folds = find_folds(scene, mesh, end.position);
  summary.warning = warnings({scene, card, mesh, model.tools, model.extent(), end, history, summary});
  if (!statistics.finished) summary.warning.insert(summary.warning.begin(), unfinished_warning(statistics));
  return evaluation;
}

PostAnswers post_process(ResultFolder& folder) {
  return post_process(folder, evaluate(folder));
}

PostAnswers post_process(ResultFolder& folder, const Evaluation& evaluation) {
  const auto& [end, summary] = evaluation;
  const Mesh& mesh = folder.model().mesh;
  const std::filesystem::path& directory = folder.directory();
  write_contours(shear_angle_isolines(mesh, end, folder.scene().output.contour_step), directory / file_name::contours);
  if (summary.forming) write_forming(*summary.forming, mesh, end, directory);
  write_summary(summary, directory / file_name::summary);
  return {summary_table(summary), summary.warning};
}

FileNames post_files() {
  return joined({{file_name::contours, file_name::summary}, forming_files()});
}

}  // namespace weaveform
