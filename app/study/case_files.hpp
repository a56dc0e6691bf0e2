// The files of a case in DIR/cases, the same whoever ran it (this program or a workflow engine):
//   NAME.toml   its scene            NAME/     its result folder
//   NAME.exit   the exit code, one number, written when the case has ended     NAME.log   what it said (standard error)
//   NAME.walls  with `repeats`: s of each solve, one a line
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace weaveform::study {

struct CaseFiles {
  std::filesystem::path scene, results, exit, log, walls;
};
[[nodiscard]] CaseFiles case_files(const std::filesystem::path& study_folder, const std::string& name);

// How a case ended.
struct Outcome {
  int exit_code = 0;
  std::string error;  // what it said last; "" when it is done
};

// Nothing when the case has not ended: no exit code is there, or it is that of an interruption, or its scene file says
// something else than `text`. Throws FileError.
[[nodiscard]] std::optional<Outcome> outcome(const CaseFiles& files, const std::string& text);

// Codes that would be the same again: done, input wrong, physics failed. Others (a full disk, a killed process) may
// not.
[[nodiscard]] bool is_final(int exit_code);

// s of each solve of the case so far; none when it was run once. Throws FileError, InputError (a damaged file).
[[nodiscard]] std::vector<double> walls_of(const CaseFiles& files);

// s of its solve, of a done case: the median when it was run several times. Throws as walls_of and `measure` do.
[[nodiscard]] double wall_of(const CaseFiles& files);

// The last complaint in a log, else what the code says by itself ("killed by signal 9 (Killed)").
[[nodiscard]] std::string error_line(const std::filesystem::path& log, int exit_code);

}  // namespace weaveform::study
