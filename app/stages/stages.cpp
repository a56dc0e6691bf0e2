#include "app/stages/stages.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "app/console.hpp"
#include "app/stages/result_folder.hpp"
#include "app/stages/room.hpp"
#include "app/study/measure.hpp"
#include "core/error.hpp"
#include "core/version/version.hpp"
#include "mesher/lattice/build.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "mesher/outline/blank_outline.hpp"
#include "mesher/scene/idle.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/symmetry/find_symmetry.hpp"
#include "mesher/tools/out_of_reach.hpp"
#include "mesher/tools/tool.hpp"
#include "post/post.hpp"
#include "solver/analysis/identity.hpp"

namespace weaveform {

namespace fs = std::filesystem;

Model build_model(const fs::path& scene_file, const std::vector<std::string>& overrides, bool yes) {
  Model model;
  model.scene = read_scene(scene_file, overrides);
  model.card = load_card(model.scene.fabric.material, model.scene.file);
  require_memory(model.scene, model.card, yes);
  model.mesh = build_mesh(model.scene, model.card);
  (void)find_symmetry(model.scene, model.card, model.mesh);  // complains of one that is asked for in vain
  return model;
}

std::vector<std::string> early_warnings(const Model& model) {
  std::vector<std::string> found = idle_parts(model.scene);
  for (std::string& line : outline_notes(model.scene)) found.push_back(std::move(line));
  for (std::string& line : tool_notes(model.scene, model.mesh)) found.push_back(std::move(line));
  for (std::string& line : tools_out_of_reach(model.scene, model.mesh)) found.push_back(std::move(line));
  return found;
}

void log_warnings(const std::vector<std::string>& warnings, const std::vector<std::string>& said) {
  // what a line is about stands before its first colon; numbers known better after the run may follow
  const auto subject = [](const std::string& line) { return line.substr(0, line.find(": ")); };
  for (const std::string& line : warnings) {
    const auto is_same = [&](const std::string& other) { return subject(other) == subject(line); };
    if (std::none_of(said.begin(), said.end(), is_same)) log_line("warning: " + line);
  }
}

std::string require_room(const Model& model, const fs::path& directory, bool yes) {
  require_disk(model.scene, model.mesh, directory, yes);
  return require_time(model.scene, model.card, model.mesh, yes);
}

std::string describe(const Model& model) {
  const Mesh& mesh = model.mesh;
  std::string line = fmt::format(
      "mesh: {} cells, {} yarn elements, {} nodes; spacing {:.4g} mm along the warp, {:.4g} mm along the weft",
      mesh.cells.size(), mesh.yarn_count(), mesh.node_count(), mesh.spacing[0], mesh.spacing[1]);
  // The spacing along one family is that of the other family's lines.
  const std::array<double, 2>& asked = model.scene.blank.coarsening;
  const std::array<double, 2> real = {mesh.spacing[1] / model.card.yarn[0].interval,
                                      mesh.spacing[0] / model.card.yarn[1].interval};
  const auto differs = [&](std::size_t f) { return std::abs(real[f] - asked[f]) > 1e-9 * asked[f]; };
  if (differs(0) || differs(1))
    line += fmt::format("; fitted to the grips: coarsening {:.4g} (warp), {:.4g} (weft) instead of {:.4g}, {:.4g}",
                        real[0], real[1], asked[0], asked[1]);
  return line;
}

void log_start(const std::string& command, const Scene& scene, bool verbose) {
  log_line(fmt::format("{}: {} {}", version_line(), command, scene.file));
  if (verbose) log_line(scene_to_toml(scene));
}

void log_end(const fs::path& directory, const std::string& what_to_open) {
  log_line(fmt::format("written to {}: {}", directory.string(), what_to_open));
}

void write_model(const Model& model, const fs::path& directory, const std::string& scene_name) {
  if (has_checkpoint(directory))
    log_warning(fmt::format("{}: held a run that was not finished; it is begun anew, where --resume would have gone on",
                            directory.string()));
  clear_folder(directory);
  // The folder's copy may be read from anywhere, so nothing in it may hang on where the original lies.
  write_scene_copy(with_absolute_paths(model.scene), directory, scene_name);
  write_mesh(model.mesh, directory / "mesh.vtu");
}

Scene scene_of(const fs::path& directory) {
  require_file(directory, "scene.toml", "weaveform mesh SCENE --output DIR");
  return read_scene(directory / "scene.toml");
}

void go_on_with_model(const Model& model, const fs::path& directory, bool quiet) {
  if (!fs::exists(directory / "scene.toml") || !fs::exists(directory / "mesh.vtu")) {
    if (!quiet)
      log_line(fmt::format("{}: holds no run to go on from; starting from the beginning", directory.string()));
    return write_model(model, directory);
  }
  const auto lines = differences(scene_identity(scene_of(directory)), scene_identity(model.scene), "this run");
  if (lines.empty() && !has_checkpoint(directory) && !is_finished(directory)) return write_model(model, directory);
  if (lines.empty()) return write_scene_copy(with_absolute_paths(model.scene), directory);
  std::vector<std::string> complaints;
  for (const auto& line : lines)
    complaints.push_back(
        fmt::format("{}: {}; start anew without --resume, or go on as it began with 'weaveform solve {} "
                    "--resume'",
                    model.scene.file, line, directory.string()));
  throw InputError(complaints);
}

void solve_folder(const fs::path& directory, const SolveOptions& options, bool yes) {
  const Scene scene = scene_of(directory);
  require_file(directory, "mesh.vtu", "weaveform mesh SCENE --output DIR");
  const Card card = load_card(scene.fabric.material, scene.file);
  const Mesh mesh = read_mesh(directory / "mesh.vtu");
  if (!yes) (void)require_room({scene, card, mesh}, directory, yes);
  if (!options.quiet) log_line(describe(find_symmetry(scene, card, mesh)));
  SolveOptions how = options;
  how.program = version_line();
  how.scene_name = scene_name_of(directory);
  if (how.resume && !has_checkpoint(directory)) {
    const bool finished = is_finished(directory);
    if (!options.quiet)
      log_line(fmt::format(
          "{}: {}", directory.string(),
          finished ? "this run is finished already" : "no checkpoint was written yet; starting from the beginning"));
    if (finished) return;
    how.resume = false;
  }
  if (!how.resume) remove_results(directory);
  solve(mesh, scene, card, directory, how);
}

std::string post_folder(const fs::path& directory, const std::vector<std::string>& said) {
  require_file(directory, "result.pvd", "weaveform solve DIR");
  std::string table = post_process(directory);
  log_warnings(study::warnings_of(directory), said);
  return table;
}

}  // namespace weaveform
