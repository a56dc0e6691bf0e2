// Results -> answers: contours, zones, the table a user reads, summary.json.
#pragma once

#include <string>
#include <vector>

#include "core/files/owned_files.hpp"
#include "post/output/ply_folder.hpp"
#include "post/output/summary.hpp"
#include "solver/result/result_folder.hpp"

namespace weaveform {

// What a result's last frame and its history come to.
struct Evaluation {
  Fields end;
  Summary summary;
};
// Throws FileError or InputError (which file is missing).
[[nodiscard]] Evaluation evaluate(ResultFolder& folder);

struct PostAnswers {
  std::string table;                  // to be printed at the end of a run
  std::vector<std::string> warnings;  // what the run says against itself, as in summary.json
};

// Writes contours.vtp and summary.json into the result folder, for a scene with tools also the files of
// forming/forming.hpp. Of a run that is not finished, everything is of its last frame, `finished` is false in
// summary.json and a warning says to what time it came. Throws FileError or InputError (which file is missing).
PostAnswers post_process(ResultFolder& folder);
PostAnswers post_process(ResultFolder& folder, const Evaluation& evaluation);  // of that folder

[[nodiscard]] FileNames post_files();
// Of a stack: the files of forming/forming.hpp once for each ply, in plies/NAME.
[[nodiscard]] FileNames ply_files();

}  // namespace weaveform
