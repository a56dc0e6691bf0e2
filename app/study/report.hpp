// From the cases a study has run to its files: study.csv; convergence.md and .csv; work_precision.md, .csv and charts;
// border.md, .csv and .svg.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/study/cases.hpp"

namespace weaveform::study {

// All measures the study needs: its own first (so many are the columns of study.csv), then what only [convergence] and
// [work_precision] name. Throws InputError, at its place, when what [work_precision] compares with is not what it
// charts.
struct Measures {
  std::vector<std::string> all;
  std::size_t columns = 0;
  std::vector<std::string> converging, charted;
};
[[nodiscard]] Measures measures_of(const Study& study);

// Throws InputError, at the places of the study file, for measures that a done case does not have.
void check_measures(const Study& study, const Measures& measures, const Case& done,
                    const std::filesystem::path& study_folder);

struct Report {
  std::string answer;  // to print
  int done = 0, failed = 0, missing = 0;
  int borders = 0;                      // found, of [border]
  std::vector<std::string> complaints;  // what could not be said
};

// Writes the files, of a study without and with [border]. Throws FileError, InputError.
Report write_report(const Study& study, const std::vector<Case>& cases, const std::filesystem::path& study_folder);
Report write_border_report(const Study& study, const std::filesystem::path& study_folder);

}  // namespace weaveform::study
