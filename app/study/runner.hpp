// Runs cases in parallel, each a `weaveform run` of its own, so that the crash of one leaves the others alone.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/study/case_files.hpp"
#include "app/study/cases.hpp"

namespace weaveform::study {

struct RunOptions {
  int jobs = 1;
  int threads = 1;     // of each case
  int repeats = 1;     // runs of each case, for its time
  bool retry = false;  // run cases that failed once more
  std::function<void(const std::string&)> log = [](const std::string&) {};
  // Asked again and again; true: ask the running cases to stop and throw Interrupted.
  std::function<bool()> stop_requested = {};
  std::function<void(const Case&)> first_done = [](const Case&) {};  // called after the first case that is done
};

// Runs those cases of the list that have not ended yet (case_files.hpp); equal ones once. An interrupted case goes on
// from its checkpoint. Ctrl-C and SIGTERM are passed on to the running cases, which leave checkpoints, and throw
// Interrupted; an exception of first_done kills them and passes. A failing case is not a failure of the study. Throws
// FileError, also when another study is at work in the folder. Gives the number of cases run now.
int run_cases(const std::vector<Case>& cases, const std::filesystem::path& study_folder, const RunOptions& options);

// The same for cases that follow from the results of others: `wanted` gives those to be run that it has not given
// before; it is called at the start and whenever a case has ended, until nothing is wanted and nothing runs.
using Wanted = std::function<std::vector<Case>()>;
int run_wanted(const Wanted& wanted, const std::filesystem::path& study_folder, const RunOptions& options);

// Writes the case's scene, NAME.toml, unless it is there. Throws FileError when another case has taken the name.
void write_case(const Case& one, const std::filesystem::path& study_folder);

}  // namespace weaveform::study
