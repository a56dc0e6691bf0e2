#include "app/result_folder.hpp"

#include <fmt/core.h>

#include <array>
#include <fstream>
#include <string_view>
#include <system_error>

#include "app/version.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/files.hpp"
#include "mesher/scene/reader.hpp"

namespace weaveform {

namespace fs = std::filesystem;

namespace {

// First words of every scene.toml that Weaveform writes; by them it knows its own copy again.
constexpr std::string_view scene_copy_mark = "# Written by weaveform";

// What solve and post leave in a result folder (solver/result/result.hpp, post/post.hpp).
constexpr std::array result_files = {
    "result.pvd",     "history.csv",    "solve.json",  "contours.vtp", "summary.json",    "checkpoint.bin",
    "meridians.csv",  "meridians.svg",  "outline.csv", "outline.vtp",  "wrinkles.vtp",    "punch_force.svg",
    "sphere_net.csv", "sphere_net.svg", "drape.vtu",   "drape.json",   "flat_pattern.csv"};

bool written_by_weaveform(const fs::path& scene_copy) {
  std::ifstream file(scene_copy);
  std::string line;
  return std::getline(file, line) && line.starts_with(scene_copy_mark);
}

void remove_frames(const fs::path& frames) {
  if (!fs::is_directory(frames)) return;
  for (const auto& entry : fs::directory_iterator(frames)) {
    const fs::path name = entry.path().filename();
    if (name.string().starts_with("frame_") && name.extension() == ".vtu") fs::remove(entry.path());
  }
}

}  // namespace

fs::path default_result_folder(const fs::path& scene_file) {
  return fs::path("results") / scene_file.stem();
}

void prepare_folder(const fs::path& directory) {
  const fs::path scene_copy = directory / "scene.toml";
  if (fs::exists(scene_copy) && !written_by_weaveform(scene_copy))
    throw InputError(fmt::format("{}: not written by weaveform and would be lost; choose another --output folder",
                                 scene_copy.string()));
  std::error_code trouble;
  fs::create_directories(directory, trouble);
  if (trouble || !fs::is_directory(directory)) {
    const std::string reason = trouble ? trouble.message() : "a file of that name is in the way";
    throw FileError(
        fmt::format("{}: cannot make this folder ({}); choose another --output", directory.string(), reason));
  }
  remove_results(directory);
  fs::remove(directory / "mesh.vtu");
}

void remove_results(const fs::path& directory) {
  for (const char* name : result_files) fs::remove(directory / name);
  remove_frames(directory / "frames");
}

void write_scene_copy(const Scene& scene, const fs::path& directory) {
  write_text_whole(directory / "scene.toml",
                   fmt::format("{}: {}\n{}", scene_copy_mark, version_line(), scene_to_toml(scene)));
}

void require_file(const fs::path& directory, const std::string& name, const std::string& made_by) {
  if (fs::exists(directory / name)) return;
  throw FileError(fmt::format("{}: not found; make it with '{}'", (directory / name).string(), made_by));
}

}  // namespace weaveform
