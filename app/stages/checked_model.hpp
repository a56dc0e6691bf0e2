// A scene looked at whole before anything is done with it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/stages/stages.hpp"

namespace weaveform {

// How far the look goes: files, card, bending and mesh, or the first step of the analysis too, which finds tools inside
// the blank, measures without cells and all else that a run refuses.
enum class Look { before_the_run, with_first_step };

// As build_model, but with every complaint found, not only the first one's. Throws InputError with all of them, or
// FileError when no more is wrong than that files are missing.
[[nodiscard]] Model checked_model(const std::filesystem::path& scene_file, const std::vector<std::string>& overrides,
                                  bool yes, Look look);

}  // namespace weaveform
