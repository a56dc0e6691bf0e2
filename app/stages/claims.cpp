#include "app/stages/claims.hpp"

#include <algorithm>
#include <system_error>

#include "app/study/accuracy.hpp"
#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "mesher/resolve/stack_laws.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/scene/scene_copy.hpp"
#include "mesher/tools/tool.hpp"
#include "post/dic/comparison/compare.hpp"
#include "post/dic/virtual/export.hpp"
#include "post/output/drape_result.hpp"
#include "post/post.hpp"
#include "post/report/result_report.hpp"
#include "solver/result/file_names.hpp"

namespace weaveform {

namespace fs = std::filesystem;

namespace {

// What comes of a mesh and stands in the folder itself.
FileNames later_files() {
  return joined({solve_files(), post_files(), report_files(), drape_files(), study::accuracy_files()});
}

// What is made of results, where the commands put it unless they are told otherwise.
FileNames files_beside_results() {
  return joined({below(dic::file_name::default_comparison, dic::comparison_files()),
                 below(dic::file_name::default_virtual, dic::virtual_files())});
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
  const auto take = [&](const FabricSpec& fabric, const BlankSpec& blank) {
    if (!is_builtin_card(fabric.material)) files.push_back(card_path(fabric.material, scene.file));
    if (!blank.outline.empty()) files.push_back(fs::path(scene.file).parent_path() / blank.outline);
  };
  take(scene.fabric, scene.blank);
  for (const PlySpec& ply : scene.ply) take(ply.fabric, ply.blank);
  for (const std::string& law : law_files(scene)) files.emplace_back(law);
  for (const auto& tool : scene.tools)
    if (!tool.file.empty()) files.push_back(tool_path(tool.file, scene.file));
  return files;
}

OutputClaim post_claim(const fs::path& directory, const Scene& scene) {
  return {.directory = directory, .names = post_files(), .inputs = input_files(scene)};
}

OutputClaim report_claim(const fs::path& directory, const Scene& scene) {
  return {.directory = directory, .names = report_files(), .inputs = input_files(scene)};
}

OutputClaim later_claim(const fs::path& directory, const Scene& scene) {
  return {.directory = directory, .names = later_files(), .inputs = input_files(scene)};
}

OutputClaim result_claim(const fs::path& directory, const Scene& scene) {
  OutputClaim claim = later_claim(directory, scene);
  claim.names.insert(claim.names.end(), {file_name::mesh, file_name::scene});
  std::error_code missing;
  const fs::path copy = directory / file_name::scene;
  if (fs::equivalent(copy, scene.file, missing) && !missing && stays_as_it_is(scene, copy))
    claim.inputs.erase(claim.inputs.begin());
  return claim;
}

void clear_folder(const fs::path& directory, const Scene& next) {
  remove_results(directory);
  remove_files(directory, {file_name::mesh});
  const std::vector<fs::path> kept = input_files(next);
  for (const fs::path& surface : present_files(directory, {"*.stl"}))
    if (is_written_by_us(surface) && !is_one_of_files(surface, kept)) fs::remove(surface);
}

void remove_results(const fs::path& directory) {
  remove_files(directory, joined({later_files(), files_beside_results()}));
}

}  // namespace weaveform
