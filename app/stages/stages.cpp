#include "app/stages/stages.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "app/stages/chosen_duration.hpp"
#include "app/stages/claims.hpp"
#include "app/stages/room.hpp"
#include "core/error.hpp"
#include "core/version/version.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/scene/scene_copy.hpp"
#include "mesher/scene/taken.hpp"
#include "solver/analysis/identity.hpp"
#include "solver/analysis/loading.hpp"

namespace weaveform {

namespace fs = std::filesystem;

std::vector<std::string> not_said(const std::vector<std::string>& warnings, const std::vector<std::string>& said) {
  // what a line is about stands before its first colon; numbers known better after the run may follow
  const auto subject = [](const std::string& line) { return line.substr(0, line.find(": ")); };
  std::vector<std::string> left;
  for (const std::string& line : warnings) {
    const auto is_same = [&](const std::string& other) { return subject(other) == subject(line); };
    if (std::none_of(said.begin(), said.end(), is_same)) left.push_back(line);
  }
  return left;
}

ExpectedRun require_room(const Resolved& model, const fs::path& directory, bool yes) {
  require_disk(model.scene, model.mesh, directory, yes);
  return require_time(model, yes);
}

ResultFolder write_model(Resolved model, const fs::path& directory, const Listener& listener,
                         const std::string& scene_name) {
  if (has_checkpoint(directory))
    listener.warn(
        fmt::format("{}: held a run that was not finished; it is begun anew, where --resume would have gone on",
                    directory.string()));
  clear_folder(directory, model.scene);
  // The folder's copy may be read from anywhere, so nothing in it may hang on where the original lies.
  model.scene = with_absolute_paths(model.scene);
  write_scene_copy(model.scene, directory, scene_name);
  write_mesh(model.mesh, directory / file_name::mesh);
  return {directory, std::move(model)};
}

ResultFolder go_on_with_model(Resolved model, const fs::path& directory, const Listener& listener) {
  if (!fs::exists(directory / file_name::scene) || !fs::exists(directory / file_name::mesh)) {
    listener.log(fmt::format("{}: holds no run to go on from; starting from the beginning", directory.string()));
    return write_model(std::move(model), directory, listener);
  }
  ResultFolder there(directory);
  const auto lines = differences(scene_identity(there.scene()), scene_identity(model.scene), "this run");
  if (lines.empty() && !has_checkpoint(directory) && !is_finished(directory))
    return write_model(std::move(model), directory, listener);
  if (!lines.empty()) {
    std::vector<std::string> complaints;
    for (const auto& line : lines)
      complaints.push_back(
          fmt::format("{}: {}; start anew without --resume, or go on as it began with 'weaveform solve {} --resume'",
                      model.scene.file, line, directory.string()));
    throw InputError(complaints);
  }
  model.scene = with_absolute_paths(model.scene);
  write_scene_copy(model.scene, directory);
  // what was found around the mesh holds for the folder's own only when that is the same
  if (mesh_digest(there.mesh()) == mesh_digest(model.mesh)) return {directory, std::move(model)};
  return ResultFolder(directory);
}

namespace {

// Of a mesh from another code, and of a scene that was changed in its folder; the commands that make a mesh of a scene
// have chosen before.
void choose_what_folder_leaves_open(ResultFolder& folder, const SolveOptions& options, const Listener& listener) {
  const fs::path directory = folder.directory();
  if (options.resume && (has_checkpoint(directory) || is_finished(directory))) return;
  if (!leaves_open(folder.scene(), duration_key)) return;
  Resolved model = folder.model();
  listener.log(fmt::format("{}: left to trials on this mesh of {} cells, each about as long as the run", duration_key,
                           model.mesh.cells.size()));
  const std::size_t known = model.scene.taken.size();
  set_duration(model, choose_duration(model, options.stop_requested));
  const std::vector<std::string> lines = taken_lines(model.scene);
  for (std::size_t k = known; k < lines.size(); ++k) listener.log(lines[k]);
  write_scene_copy(model.scene, directory, scene_name_of(directory));
  folder = ResultFolder(directory, std::move(model));
}

}  // namespace

void solve_folder(ResultFolder& folder, const SolveOptions& options, const Listener& listener, bool yes) {
  if (!yes) (void)require_room(folder.model(), folder.directory(), yes);
  choose_what_folder_leaves_open(folder, options, listener);
  const fs::path& directory = folder.directory();
  const Resolved& model = folder.model();
  if (const std::string line = describe_automatic_duration(model); !line.empty()) listener.log(line);
  listener.log(describe(model.symmetry));
  SolveOptions how = options;
  how.program = version_line();
  how.scene_name = scene_name_of(directory);
  if (how.resume && !has_checkpoint(directory)) {
    const bool finished = is_finished(directory);
    listener.log(fmt::format(
        "{}: {}", directory.string(),
        finished ? "this run is finished already" : "no checkpoint was written yet; starting from the beginning"));
    if (finished) return;
    how.resume = false;
  }
  if (!how.resume) remove_results(directory);
  (void)solve(model, directory, how);
}

}  // namespace weaveform
