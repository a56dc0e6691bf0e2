// The report of a study: its cases, each with its own report where that was written, the measures over the cell size, and
// time against error.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/study/table.hpp"
#include "core/chart/chart.hpp"

namespace weaveform::study {

struct StudyPage {
  std::vector<Chart> charts;                                 // those of the study's own files
  std::vector<std::pair<std::string, std::string>> answers;  // title and Markdown of what was found
  std::vector<std::string> complaints;
};

// One HTML file, report.html. Throws FileError.
void write_study_page(const Study& study, const Table& table, std::size_t measure_columns, const StudyPage& page,
                      const std::filesystem::path& study_folder);

// DIR/cases/NAME/report.html of every case that is done, where it is missing or older than the case's answers. Throws
// FileError, InputError.
void write_case_reports(const Table& table, const std::filesystem::path& study_folder);

}  // namespace weaveform::study
