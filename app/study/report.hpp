// From the cases a study has run to its files: study.csv; convergence.md and .csv; work_precision.md, .csv and charts;
// wrinkles.md and .csv; border.md, .csv and .svg; report.html.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/study/cases.hpp"
#include "core/files/owned_files.hpp"

namespace weaveform::study {

namespace report_name {
inline constexpr const char *table = "study.csv", *convergence = "convergence.md";
inline constexpr const char *convergence_table = "convergence.csv", *work_precision = "work_precision.md";
inline constexpr const char* work_precision_table = "work_precision.csv";
inline constexpr const char *wrinkles = "wrinkles.md", *wrinkles_table = "wrinkles.csv";
inline constexpr const char* page = "report.html";
inline constexpr const char *border = "border.md", *border_table = "border.csv", *border_chart = "border.svg";
}  // namespace report_name

// All of them, the charts of work_precision_report.hpp too; those of an earlier report go when a new one is written.
[[nodiscard]] inline FileNames report_files() {
  return {report_name::table,       report_name::convergence,    report_name::convergence_table,
          report_name::border,      report_name::work_precision, report_name::work_precision_table,
          report_name::wrinkles,    report_name::wrinkles_table, report_name::border_table,
          report_name::page,        "work_precision.html",       "work_precision_*.svg",
          report_name::border_chart};
}

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
  std::string answer;           // to print
  nlohmann::ordered_json json;  // the same numbers, and the counts below (docs/results.md)
  int done = 0, failed = 0, missing = 0;
  int borders = 0;                      // found, of [border]
  std::vector<std::string> complaints;  // what could not be said
};

// Writes the files, of a study without and with [border]. Throws FileError, InputError.
// `of_cases`: also a report of each case that is done.
Report write_report(const Study& study, const std::vector<Case>& cases, const std::filesystem::path& study_folder,
                    bool of_cases = false);
Report write_border_report(const Study& study, const std::filesystem::path& study_folder, bool of_cases = false);

}  // namespace weaveform::study
