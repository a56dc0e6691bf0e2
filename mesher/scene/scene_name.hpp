// The file that a scene was first read from, kept as a comment in every copy of it.
#pragma once

#include <string>

namespace weaveform {

// "# Scene: \"examples/bias_extension_pw.toml\"", quoted as JSON does so that no name ends the comment.
[[nodiscard]] std::string scene_name_line(const std::string& name);

// The name in a scene's text; "" where it has no such line.
[[nodiscard]] std::string scene_name_in(const std::string& text);

}  // namespace weaveform
