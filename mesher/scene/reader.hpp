// Scene files: TOML in, Scene out, and back. One key table (schema.hpp) drives all of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/keys/key_info.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

// Reads and checks a scene file. Overrides are "key=value" as given to --set, e.g. "blank.size=[100,200]",
// "grip.top.travel=40" (array tables by name or by 0-based index, "grip.0.travel"); the value is TOML, and a bare word
// is taken as a string. Throws InputError with every complaint at once, each "file:line:column: ...; did you mean
// '...'" (overrides: "--set key: ..."), FileError when the file cannot be read.
[[nodiscard]] Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

// The same from text in memory; `name` stands for the file in messages.
[[nodiscard]] Scene read_scene_text(const std::string& text, const std::string& name,
                                    const std::vector<std::string>& overrides = {});

// The complete scene as TOML, every key with its value, so that reading it back gives the same scene.
[[nodiscard]] std::string scene_to_toml(const Scene& scene);

// The scene with every path in it absolute (a relative one is meant beside scene.file), so that its echo can be run
// from any folder.
[[nodiscard]] Scene with_absolute_paths(Scene scene);

// Every valid key, in the order of the echo.
[[nodiscard]] std::vector<KeyInfo> scene_keys();

// docs/scene.md, generated from the key table: every key with type, unit, default, range and meaning.
[[nodiscard]] std::string scene_reference_markdown();

}  // namespace weaveform
