#include "mesher/scene/scene_copy.hpp"

#include <fmt/format.h>

#include "core/files/files.hpp"
#include "core/version/version.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/scene/scene_name.hpp"

namespace weaveform {

void write_scene_copy(const Scene& scene, const std::filesystem::path& directory, const std::string& name) {
  write_text_whole(directory / file_name::scene,
                   fmt::format("# {}: {}\n{}\n{}", written_mark, version_line(),
                               scene_name_line(name.empty() ? scene.file : name), scene_to_toml(scene)));
}

std::string scene_name_of(const std::filesystem::path& directory) {
  return scene_name_in(read_text_file(directory / file_name::scene));
}

}  // namespace weaveform
