// The stages of the chain, scene -> mesh -> solve -> post, as the commands call them. Each leaves its files in the
// result folder and the next one takes them from there (solver/result/result_folder.hpp): from the disk, or from memory
// in the process that wrote them, which is the same bit for bit.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/stages/room.hpp"
#include "core/log/listener.hpp"
#include "mesher/resolve/resolved.hpp"
#include "post/post.hpp"
#include "solver/result/result_folder.hpp"
#include "solver/solve.hpp"

namespace weaveform {

// Of `warnings` those on a subject (what stands before the first colon) that `said` has no line about.
[[nodiscard]] std::vector<std::string> not_said(const std::vector<std::string>& warnings,
                                                const std::vector<std::string>& said);

// What the run is expected to take. Throws InputError when the disk of `directory` or the hours
// allowed are too few for the run, unless `yes`.
ExpectedRun require_room(const Resolved& model, const std::filesystem::path& directory, bool yes);

// mesh: DIR/mesh.vtu and DIR/scene.toml, in a folder that is claimed, cleared of an older run. `scene_name` as in
// write_scene_copy. Gives the folder, open, with all that is known of it.
ResultFolder write_model(Resolved model, const std::filesystem::path& directory, const Listener& listener,
                         const std::string& scene_name = "");

// run --resume: the folder's scene and mesh as they are when they are those of `model`, or made when the run was
// stopped before they were. Throws InputError, with what differs, when DIR/scene.toml is another scene: an analysis
// goes on only as it began, but for keys that change nothing in the history (solver/analysis/identity.hpp).
ResultFolder go_on_with_model(Resolved model, const std::filesystem::path& directory, const Listener& listener);

// solve: adds frames, history and statistics. What duration and speeds the folder's scene leaves to trials is chosen
// first, and put into it (app/stages/chosen_duration.hpp). With options.resume, a finished run is left alone, and one
// that left no checkpoint begins again; both are said. Room is asked for as above, unless `yes`. Throws what solve
// throws.
void solve_folder(ResultFolder& folder, const SolveOptions& options, const Listener& listener, bool yes);

}  // namespace weaveform
