// The stages of the chain, scene -> mesh -> solve -> post, as the commands call them. Each leaves its files in the
// result folder and the next one reads them from there, so `run` and the commands one by one give the same bits.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/solve.hpp"

namespace weaveform {

// A scene with everything it leads to, checked as far as it can be without running it.
struct Model {
  Scene scene;
  Card card;
  Mesh mesh;
};

// Reads the scene with its overrides, its card, and builds the mesh, for which there must be memory unless `yes`
// (app/stages/room.hpp). Throws InputError, FileError.
[[nodiscard]] Model build_model(const std::filesystem::path& scene_file, const std::vector<std::string>& overrides,
                                bool yes = false);

// What the model shows against itself before it is run (mesher/scene/idle.hpp, mesher/tools/out_of_reach.hpp).
[[nodiscard]] std::vector<std::string> early_warnings(const Model& model);

// "warning: ..." on standard error, also of a quiet command; left out are those on a subject (what stands before the
// first colon) that `said` has a line about.
void log_warnings(const std::vector<std::string>& warnings, const std::vector<std::string>& said = {});

// What the run is expected to take, as a line for the log. Throws InputError when the disk of `directory` or the hours
// allowed are too few for the run, unless `yes`.
std::string require_room(const Model& model, const std::filesystem::path& directory, bool yes);

// One line: how many cells, yarn elements and nodes, and at what spacing; with the coarsening that comes to where the
// lattice was fitted to the grips.
[[nodiscard]] std::string describe(const Model& model);

// Logs program and command; with `verbose` every value of the scene too, so that the log alone can be run again.
void log_start(const std::string& command, const Scene& scene, bool verbose);

// Says where the command's files are, and which of them to open next.
void log_end(const std::filesystem::path& directory, const std::string& what_to_open);

// The folder's own scene.
[[nodiscard]] Scene scene_of(const std::filesystem::path& directory);

// mesh: DIR/mesh.vtu and DIR/scene.toml, in a folder that is claimed, cleared of an older run. `scene_name` as in
// write_scene_copy.
void write_model(const Model& model, const std::filesystem::path& directory, const std::string& scene_name = "");

// run --resume: the folder's scene and mesh as they are when they are those of `model`, or made when the run was
// stopped before they were. Throws InputError, with what differs, when DIR/scene.toml is another scene: an analysis
// goes on only as it began, but for keys that change nothing in the history (solver/analysis/identity.hpp).
void go_on_with_model(const Model& model, const std::filesystem::path& directory, bool quiet);

// solve: reads DIR/scene.toml and DIR/mesh.vtu, adds frames, history and statistics. With options.resume, a finished
// run is left alone, and one that left no checkpoint begins again; both are said. Room is asked for as above, unless
// `yes`. Throws what solve throws.
void solve_folder(const std::filesystem::path& directory, const SolveOptions& options, bool yes);

// post: adds contours and summary; gives the table to print. The summary's warnings go to standard error, but for those
// in `said`.
[[nodiscard]] std::string post_folder(const std::filesystem::path& directory,
                                      const std::vector<std::string>& said = {});

}  // namespace weaveform
