#include "post/post.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "mesher/scene/reader.hpp"
#include "post/forming/forming.hpp"
#include "post/measure/bias_comparison.hpp"
#include "post/output/contours.hpp"
#include "post/output/summary.hpp"
#include "post/trust/warnings.hpp"
#include "solver/result/result.hpp"

namespace weaveform {

namespace {

namespace fs = std::filesystem;

void require(const fs::path& directory) {
  for (const char* name : {"scene.toml", "mesh.vtu", "result.pvd", "history.csv", "solve.json"})
    if (!fs::is_regular_file(directory / name))
      throw FileError(
          fmt::format("{}: no such file; solve the scene into this folder first", (directory / name).string()));
}

constexpr double rounding = 1.0 + 1e-12;  // of times

// Fields of the last frame listed up to the time of the statistics; computed anew from its positions, so that post and
// solver share one formula.
Fields last_fields(const fs::path& directory, const Mesh& mesh, const Card& card, const ModelSpec& model,
                   const SolveStatistics& statistics) {
  std::vector<FrameFile> frames = list_frames(directory);
  if (!statistics.finished)  // killed between a frame and its statistics
    std::erase_if(frames, [&](const FrameFile& frame) { return frame.time > rounding * statistics.time_s; });
  if (frames.empty())
    throw InputError(fmt::format("{}: lists no frame; solve again", (directory / "result.pvd").string()));
  const std::vector<Vec3> position = read_frame_positions(frames.back().file);
  if (static_cast<int>(position.size()) != mesh.node_count())
    throw InputError(fmt::format("{}: {} nodes, but mesh.vtu has {}; the folder mixes two runs, solve again",
                                 frames.back().file.string(), position.size(), mesh.node_count()));
  return compute_fields(mesh, card, model, frames.back().time, position);
}

// Rows up to the last frame; of a run under way, or one that was stopped, the file may go on a little.
History history_until(const fs::path& directory, double time, const SolveStatistics& statistics) {
  const fs::path file = directory / "history.csv";
  if (statistics.finished) return read_history(file);
  History history = read_history(file, HistoryEnd::may_be_torn);
  std::erase_if(history.row, [&](const auto& row) { return row.front() > rounding * time; });
  if (history.row.empty())
    throw FileError(fmt::format("{}: the run was stopped before its first row; go on with --resume", file.string()));
  return history;
}

std::string unfinished_warning(const SolveStatistics& s) {
  return fmt::format(
      "this run is not finished: everything here is of t = {:.4g} s of {:.4g} s ({:.3g} %); go on with "
      "--resume",
      s.time_s, s.duration_s, s.duration_s > 0.0 ? 100.0 * s.time_s / s.duration_s : 0.0);
}

}  // namespace

std::string post_process(const fs::path& directory) {
  require(directory);
  const Scene scene = read_scene(directory / "scene.toml");
  const Card card = load_card(scene.fabric.material, scene.file);
  const Mesh mesh = read_mesh(directory / "mesh.vtu");
  const SolveStatistics statistics = read_statistics(directory / "solve.json");
  const Fields end = last_fields(directory, mesh, card, scene.model, statistics);
  const History history = history_until(directory, end.time, statistics);

  write_contours(shear_angle_isolines(mesh, end, scene.output.contour_step), directory / "contours.vtp");

  Summary summary;
  summary.statistics = statistics;
  summary.grip = summarise_grips(scene, history);
  summary.tool = summarise_tools(scene, history);
  summary.measure = summarise_measures(scene, history);
  if (const auto specimen = find_bias_extension(scene))
    summary.bias = compare_bias_extension(*specimen, scene, card, mesh, end, history);
  if (scene.frame) summary.frame = compare_shear_frame(scene, card, history);
  summary.forming = evaluate_forming(scene, mesh, end, history);
  if (summary.forming) write_forming(*summary.forming, mesh, end, directory);
  summary.folds = find_folds(scene, mesh, end.position);
  summary.warning = warnings({scene, card, mesh, end, history, summary});
  if (!statistics.finished) summary.warning.insert(summary.warning.begin(), unfinished_warning(statistics));
  write_summary(summary, directory / "summary.json");
  return summary_table(summary);
}

}  // namespace weaveform
