// Surfaces from STL files, text or binary.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "mesher/tools/triangle_list.hpp"

namespace weaveform {

// Equal points become one. Throws FileError when the file cannot be read, InputError when it holds no surface, is cut
// short, or has a corner that is no number or out of all bounds (which facet).
[[nodiscard]] TriangleList read_stl(const std::filesystem::path& file);

// The same from the file's bytes; `name` begins the messages.
[[nodiscard]] TriangleList parse_stl(std::string_view bytes, const std::string& name);

}  // namespace weaveform
