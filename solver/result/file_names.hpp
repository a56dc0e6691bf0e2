// What a solve writes to its folder, by name.
#pragma once

#include "core/files/owned_files.hpp"

namespace weaveform {

namespace file_name {
inline constexpr const char* index = "result.pvd";  // of the frames, for ParaView
inline constexpr const char* frames = "frames";     // the folder of frame_NNNN.vtu
inline constexpr const char* history = "history.csv";
inline constexpr const char* statistics = "solve.json";
inline constexpr const char* checkpoint = "checkpoint.bin";
inline constexpr const char* clean_checkpoint = "checkpoint_clean.bin";  // of what a perturbed run is set beside
}  // namespace file_name

[[nodiscard]] inline FileNames solve_files() {
  return {file_name::index,      std::string(file_name::frames) + "/frame_####.vtu",
          file_name::history,    file_name::statistics,
          file_name::checkpoint, file_name::clean_checkpoint};
}

}  // namespace weaveform
