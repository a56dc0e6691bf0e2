#include "app/study/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "app/study/measure.hpp"
#include "mesher/base/error.hpp"

namespace weaveform::study {

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

// A value as people write it: text without its quotes.
std::string plain(const std::string& toml) {
  const bool quoted = toml.size() > 1 && (toml.front() == '"' || toml.front() == '\'') && toml.back() == toml.front();
  return quoted ? toml.substr(1, toml.size() - 2) : toml;
}

}  // namespace

std::size_t column_of(const Table& table, const std::string& measure) {
  return static_cast<std::size_t>(std::find(table.measures.begin(), table.measures.end(), measure) -
                                  table.measures.begin());
}

Table collect(const Study& study, const std::vector<Case>& cases, std::vector<std::string> measures,
              const std::filesystem::path& study_folder, std::vector<std::string>& complaints) {
  Table table{varied_keys(study), std::move(measures), {}};
  std::set<std::string> missing;
  for (const Case& one : cases) {
    const CaseFiles files = case_files(study_folder, one.name);
    Row row{one, outcome(files, one.text), std::vector<double>(table.measures.size(), no_number), no_number, no_number};
    if (row.outcome && row.outcome->exit_code == 0) {
      row.size = mesh_size(files.results);
      row.wall = measure(files.results, "wall_s");
      for (std::size_t m = 0; m < table.measures.size(); ++m) {
        try {
          row.value[m] = measure(files.results, table.measures[m]);
        } catch (const InputError& error) {
          if (missing.insert(table.measures[m]).second)
            complaints.push_back(fmt::format("{} ({}): {}", describe(one), files.results.string(), error.what()));
        }
      }
    }
    table.row.push_back(std::move(row));
  }
  return table;
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + "\"";
}

void add_field(std::string& text, const std::string& field) {
  text += ',';
  text += field;
}

std::string csv_number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "";
}

std::string to_csv(const Table& table, std::size_t measure_columns) {
  std::string text = "case";
  for (const std::string& key : table.keys) add_field(text, csv_field(key));
  text += ",exit_code,error";
  for (std::size_t m = 0; m < measure_columns; ++m) add_field(text, csv_field(table.measures[m]));
  text += "\n";
  for (const Row& row : table.row) {
    text += row.one.name;
    for (const std::string& key : table.keys) {
      const Setting* setting = setting_of(row.one, key);
      add_field(text, (setting != nullptr ? csv_field(plain(setting->value)) : ""));
    }
    text += row.outcome ? fmt::format(",{},{}", row.outcome->exit_code, csv_field(row.outcome->error)) : ",,not run";
    for (std::size_t m = 0; m < measure_columns; ++m) add_field(text, csv_number(row.value[m]));
    text += "\n";
  }
  return text;
}

}  // namespace weaveform::study
