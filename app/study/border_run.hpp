// The cases of a [border] study: which are needed, what they said, where the borders are.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/study/border_judge.hpp"
#include "app/study/border_search.hpp"
#include "app/study/cases.hpp"
#include "app/study/runner.hpp"

namespace weaveform::study {

// One combination of what is varied, with a border of its own.
struct BorderGroup {
  Variant variant;
  BorderSearch search;
  std::vector<Case> tried;  // the cases of search.tried
  Judgement failing;        // at search.fails, once a border is found
};

// Both ends of every group: all that is known beforehand, so that a wrong value is told before anything runs. Throws
// InputError, FileError.
[[nodiscard]] std::vector<Case> border_ends(const Study& study);

// Runs what the searches need, groups side by side and each one step after the other. With `retry` cases that failed
// are run once more. A case that ends with exit code 2 or 4 stops the study: throws InputError, FileError with what it
// said; otherwise as run_cases. Gives the number of cases run now.
int run_borders(const Study& study, const std::filesystem::path& study_folder, const RunOptions& options);

// Where the borders are by what has been run. Throws InputError, FileError.
[[nodiscard]] std::vector<BorderGroup> find_borders(const Study& study, const std::filesystem::path& study_folder);

}  // namespace weaveform::study
