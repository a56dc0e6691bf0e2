// The results of a study, a row for each case: study.csv.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/study/case_files.hpp"
#include "app/study/cases.hpp"
#include "core/files/csv.hpp"

namespace weaveform::study {

struct Row {
  Case one;
  std::optional<Outcome> outcome;  // none: has not ended
  std::vector<double> value;       // of each measure; not a number when the case is not done
  double size = 0.0;               // mm; of its mesh; not a number when the case is not done
  double wall = 0.0;               // s; of its solve, the median of `repeats`; not a number when the case is not done
};

// The case has run, and to its end.
[[nodiscard]] bool is_done(const Row& row);

struct Table {
  std::vector<std::string> keys;      // varied
  std::vector<std::string> measures;  // columns of Row::value
  std::vector<Row> row;
};

// What the cases have left in the study folder. A done case that lacks a measure has no number there, and `complaints`
// (one line for each measure) says so. Throws FileError, InputError (a damaged file).
[[nodiscard]] Table collect(const Study& study, const std::vector<Case>& cases, std::vector<std::string> measures,
                            const std::filesystem::path& study_folder, std::vector<std::string>& complaints);

// Index of a measure's column; measures of [convergence] and [work_precision] that the study does not list have columns
// of their own too.
[[nodiscard]] std::size_t column_of(const Table& table, const std::string& measure);

// case, series (when there are any), the varied keys, exit_code, error, the measures. Empty where there is nothing. Ten
// significant digits.
[[nodiscard]] std::string to_csv(const Table& table, std::size_t measure_columns);

// The table for people: settings, measures, time of the solve or that it failed.
[[nodiscard]] std::string to_markdown(const Table& table, std::size_t measure_columns);

// A list of cases: "case" (its name), "series" (where there are any), "settings" by key, "exit_code" (null: not run),
// "error", "mesh_size_mm", "wall_s", "measures" by name; null where there is no number.
[[nodiscard]] nlohmann::ordered_json table_json(const Table& table, std::size_t measure_columns);

// A value as people write it: text without its quotes. Of a key that the case leaves out: "".
[[nodiscard]] std::string plain_value(const std::string& toml);
[[nodiscard]] std::string plain_value(const Case& one, const std::string& key);

// The settings in which the case differs from others of the table, in few words for charts: "coarsening 4, yarn beam".
// A key's table is left out unless two keys end alike. The scene as it is where there is no such setting.
[[nodiscard]] std::string short_description(const Case& one, const Table& table);

// ",FIELD" at the end of the text.
void add_field(std::string& text, const std::string& field);

}  // namespace weaveform::study
