// DIR/scene.toml: the complete scene of a folder, with who wrote it and where it was first read from.
#pragma once

#include <filesystem>
#include <string>

#include "mesher/scene/scene.hpp"

namespace weaveform {

namespace file_name {
inline constexpr const char* scene = "scene.toml";
}

// First words of what Weaveform writes, behind the comment sign of the format.
inline constexpr const char* written_mark = "Written by weaveform";

// Every key with its value, under lines that name the program and the scene's own file; written whole or not at all.
// `name` stands for that file where the scene comes by way of another. Throws FileError.
void write_scene_copy(const Scene& scene, const std::filesystem::path& directory, const std::string& name = "");

// The file that the folder's scene was read from; "" where its copy does not say.
[[nodiscard]] std::string scene_name_of(const std::filesystem::path& directory);

}  // namespace weaveform
