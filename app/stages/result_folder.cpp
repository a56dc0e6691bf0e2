#include "app/stages/result_folder.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <system_error>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/version/version.hpp"
#include "fabric/card/card.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/scene/scene_name.hpp"
#include "mesher/tools/tool.hpp"

namespace weaveform {

namespace fs = std::filesystem;

namespace {

// What the stages leave in a result folder (solver/result/result.hpp, post/post.hpp, post/output/drape_result.hpp).
constexpr std::array solve_files = {"result.pvd", "history.csv", "solve.json", "checkpoint.bin",
                                    "checkpoint_clean.bin"};
constexpr std::array post_files = {"contours.vtp",   "summary.json",  "meridians.csv", "meridians.svg",
                                   "outline.csv",    "outline.vtp",   "wrinkles.vtp",  "punch_force.svg",
                                   "sphere_net.csv", "sphere_net.svg"};
constexpr std::array other_files = {"drape.vtu", "drape.json", "flat_pattern.csv", "accuracy.md"};
constexpr const char* frame_names = "frames/frame_[0-9][0-9][0-9][0-9]*.vtu";

bool is_frame(const std::string& name) {
  constexpr std::string_view begin = "frame_", end = ".vtu";
  if (!name.starts_with(begin) || !name.ends_with(end) || name.size() < begin.size() + end.size() + 4) return false;
  const std::string number = name.substr(begin.size(), name.size() - begin.size() - end.size());
  return number.find_first_not_of("0123456789") == std::string::npos;
}

// Whether running the folder's own copy writes the same copy again.
bool stays_as_it_is(const Scene& scene, const fs::path& copy) {
  return is_our_folder(copy.parent_path()) &&
         scene_to_toml(read_scene(copy)) == scene_to_toml(with_absolute_paths(scene));
}

}  // namespace

fs::path default_result_folder(const fs::path& scene_file) {
  return fs::path("results") / scene_file.stem();
}

std::vector<fs::path> input_files(const Scene& scene) {
  std::vector<fs::path> files = {scene.file};
  if (!is_builtin_card(scene.fabric.material)) files.push_back(card_path(scene.fabric.material, scene.file));
  if (!scene.blank.outline.empty()) files.push_back(fs::path(scene.file).parent_path() / scene.blank.outline);
  for (const auto& tool : scene.tools)
    if (!tool.file.empty()) files.push_back(tool_path(tool.file, scene.file));
  return files;
}

OutputClaim later_claim(const fs::path& directory, const Scene& scene) {
  OutputClaim claim = post_claim(directory, scene);
  claim.names.emplace_back(frame_names);
  claim.names.insert(claim.names.end(), solve_files.begin(), solve_files.end());
  claim.names.insert(claim.names.end(), other_files.begin(), other_files.end());
  return claim;
}

OutputClaim post_claim(const fs::path& directory, const Scene& scene) {
  return {.directory = directory,
          .names = std::vector<std::string>(post_files.begin(), post_files.end()),
          .inputs = input_files(scene)};
}

OutputClaim result_claim(const fs::path& directory, const Scene& scene) {
  OutputClaim claim = later_claim(directory, scene);
  claim.names.insert(claim.names.end(), {"mesh.vtu", "scene.toml"});
  std::error_code missing;
  const fs::path copy = directory / "scene.toml";
  if (fs::equivalent(copy, scene.file, missing) && !missing && stays_as_it_is(scene, copy))
    claim.inputs.erase(claim.inputs.begin());
  return claim;
}

void clear_folder(const fs::path& directory) {
  remove_results(directory);
  fs::remove(directory / "mesh.vtu");
}

void remove_results(const fs::path& directory) {
  for (const char* name : solve_files) fs::remove(directory / name);
  for (const char* name : post_files) fs::remove(directory / name);
  for (const char* name : other_files) fs::remove(directory / name);
  const fs::path frames = directory / "frames";
  if (!fs::is_directory(fs::symlink_status(frames))) return;
  for (const auto& entry : fs::directory_iterator(frames))
    if (is_frame(entry.path().filename().string())) fs::remove(entry.path());
}

void write_scene_copy(const Scene& scene, const fs::path& directory, const std::string& name) {
  write_text_whole(directory / "scene.toml",
                   fmt::format("# {}: {}\n{}\n{}", written_mark, version_line(),
                               scene_name_line(name.empty() ? scene.file : name), scene_to_toml(scene)));
}

std::string scene_name_of(const fs::path& directory) {
  return scene_name_in(read_text_file(directory / "scene.toml"));
}

void require_file(const fs::path& directory, const std::string& name, const std::string& made_by) {
  if (fs::exists(directory / name)) return;
  throw FileError(fmt::format("{}: not found; make it with '{}'", (directory / name).string(), made_by));
}

}  // namespace weaveform
