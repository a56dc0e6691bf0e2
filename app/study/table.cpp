#include "app/study/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "app/study/measure.hpp"
#include "core/error.hpp"
#include "core/json/toml_json.hpp"
#include "post/report/words.hpp"

namespace weaveform::study {

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

std::string last_word(const std::string& key) {
  return key.substr(key.rfind('.') + 1);
}

bool varies(const Table& table, const std::string& key) {
  std::set<std::string> values;
  for (const Row& row : table.row) values.insert(plain_value(row.one, key));
  return values.size() > 1;
}

bool ends_like_another(const Table& table, const std::string& key) {
  const auto alike = [&](const std::string& other) { return other != key && last_word(other) == last_word(key); };
  return std::any_of(table.keys.begin(), table.keys.end(), alike);
}

}  // namespace

bool is_done(const Row& row) {
  return row.outcome && row.outcome->exit_code == 0;
}

std::string plain_value(const std::string& toml) {
  const bool quoted = toml.size() > 1 && (toml.front() == '"' || toml.front() == '\'') && toml.back() == toml.front();
  return quoted ? toml.substr(1, toml.size() - 2) : toml;
}

std::string plain_value(const Case& one, const std::string& key) {
  const Setting* setting = setting_of(one, key);
  return setting != nullptr ? plain_value(setting->value) : "";
}

std::string short_description(const Case& one, const Table& table) {
  std::string text;
  for (const Setting& setting : one.settings) {
    if (!varies(table, setting.key)) continue;
    std::string key = ends_like_another(table, setting.key) ? setting.key : last_word(setting.key);
    std::replace(key.begin(), key.end(), '_', ' ');
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", key, plain_value(setting.value));
  }
  return text.empty() ? "the scene as it is" : text;
}

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
    if (is_done(row)) {
      row.size = mesh_size(files.results);
      row.wall = wall_of(files);
      for (std::size_t m = 0; m < table.measures.size(); ++m) {
        try {
          row.value[m] = table.measures[m] == "wall_s" ? row.wall : measure(files.results, table.measures[m]);
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

void add_field(std::string& text, const std::string& field) {
  text += ',';
  text += field;
}

std::string to_csv(const Table& table, std::size_t measure_columns) {
  const bool series =
      std::any_of(table.row.begin(), table.row.end(), [](const Row& row) { return !row.one.series.empty(); });
  std::string text = series ? "case,series" : "case";
  for (const std::string& key : table.keys) add_field(text, csv_field(key));
  text += ",exit_code,error";
  for (std::size_t m = 0; m < measure_columns; ++m) add_field(text, csv_field(table.measures[m]));
  text += "\n";
  for (const Row& row : table.row) {
    text += row.one.name;
    if (series) add_field(text, csv_field(row.one.series));
    for (const std::string& key : table.keys) add_field(text, csv_field(plain_value(row.one, key)));
    text += row.outcome ? fmt::format(",{},{}", row.outcome->exit_code, csv_field(row.outcome->error)) : ",,not run";
    for (std::size_t m = 0; m < measure_columns; ++m) add_field(text, csv_number(row.value[m]));
    text += "\n";
  }
  return text;
}

std::string to_markdown(const Table& table, std::size_t measure_columns) {
  std::string text = "|";
  for (const std::string& key : table.keys) text += fmt::format(" {} |", key);
  for (std::size_t m = 0; m < measure_columns; ++m) text += fmt::format(" {} |", measure_in_words(table.measures[m]));
  text += " solve |\n|";
  for (std::size_t c = 0; c < table.keys.size() + measure_columns + 1; ++c) text += "---:|";
  for (const Row& row : table.row) {
    text += "\n|";
    for (const std::string& key : table.keys) text += fmt::format(" {} |", plain_value(row.one, key));
    const bool done = is_done(row);
    for (std::size_t m = 0; m < measure_columns; ++m) text += fmt::format(" {} |", csv_number(row.value[m], 6));
    text += done ? fmt::format(" {:.3g} s |", row.wall) : row.outcome ? " failed |" : " not run |";
  }
  return text + "\n";
}

nlohmann::ordered_json table_json(const Table& table, std::size_t measure_columns) {
  using Json = nlohmann::ordered_json;
  Json cases = Json::array();
  for (const Row& row : table.row) {
    Json one = {{"case", row.one.name}};
    if (!row.one.series.empty()) one["series"] = row.one.series;
    one["settings"] = Json::object();
    for (const Setting& setting : row.one.settings) one["settings"][setting.key] = toml_value_json(setting.value);
    one["exit_code"] = row.outcome ? Json(row.outcome->exit_code) : Json(nullptr);
    one["error"] = row.outcome ? row.outcome->error : "not run";
    one["mesh_size_mm"] = row.size;
    one["wall_s"] = row.wall;
    one["measures"] = Json::object();
    for (std::size_t m = 0; m < measure_columns; ++m) one["measures"][table.measures[m]] = row.value[m];
    cases.push_back(std::move(one));
  }
  return cases;
}

}  // namespace weaveform::study
