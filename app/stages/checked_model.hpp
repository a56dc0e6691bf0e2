// A scene looked at before anything is done with it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesher/resolve/resolve.hpp"

namespace weaveform {

enum class Look {
  for_first_complaint,  // who wants the mesh or nothing
  for_all_complaints,   // files, card, bending, outline, mesh, tools, drape and symmetry, each as far as the others let
                        // it
  with_first_step,  // and the first step of the analysis, which finds tools inside the blank, measures without cells
                    // and all else that a run refuses
};

// Everything that the scene leads to; there must be memory for its mesh unless `yes` (app/stages/room.hpp). Throws
// InputError with the complaints, or FileError when no more is wrong than that files are missing.
[[nodiscard]] Resolved checked_model(const std::filesystem::path& scene_file, const std::vector<std::string>& overrides,
                                     bool yes, Look look, ResolveTo to = ResolveTo::whole);

}  // namespace weaveform
