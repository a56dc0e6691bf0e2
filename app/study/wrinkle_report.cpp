#include "app/study/wrinkle_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/study/convergence_report.hpp"
#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/json/toml_json.hpp"
#include "post/output/summary.hpp"

namespace weaveform::study {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* refined = "blank.coarsening";
constexpr double missing = std::numeric_limits<double>::quiet_NaN();

// "wrinkles" of each ply by its name; of a single ply under "". Results of older versions have none.
std::vector<std::pair<std::string, Json>> wrinkles_in(const std::filesystem::path& file) {
  const Json json = Json::parse(read_text_file(file), nullptr, false);
  if (!json.is_object()) throw InputError(fmt::format("{}: not JSON; run the case again", file.string()));
  std::vector<std::pair<std::string, Json>> found;
  if (const auto own = json.find("wrinkles"); own != json.end()) found.emplace_back("", *own);
  if (const auto plies = json.find("plies"); plies != json.end() && plies->is_object())
    for (const auto& ply : plies->items())
      if (ply.value().contains("wrinkles")) found.emplace_back(ply.key(), ply.value().at("wrinkles"));
  std::erase_if(found, [](const auto& one) { return !one.second.is_object(); });
  return found;
}

double number_in(const Json& wrinkles, const char* name) {
  const auto found = wrinkles.find(name);
  return found != wrinkles.end() && found->is_number() ? found->get<double>() : missing;
}

WrinkleLevel level_of(std::size_t row, double size, const Json& wrinkles) {
  WrinkleLevel level;
  level.row = row;
  level.size = size;
  for (std::size_t m = 0; m < wrinkle_measures; ++m) level.value[m] = number_in(wrinkles, wrinkle_measure[m].name);
  level.cells = number_in(wrinkles, "cells_per_wave");
  if (const auto of = wrinkles.find("of"); of != wrinkles.end() && of->is_string()) level.of = of->get<std::string>();
  return level;
}

WrinklesOf& entry_of(std::vector<WrinklesOf>& all, const std::string& group, const std::string& ply) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const WrinklesOf& one) { return one.group == group && one.ply == ply; });
  if (found != all.end()) return *found;
  all.emplace_back();
  all.back().group = group;
  all.back().ply = ply;
  return all.back();
}

// Two settings may give one mesh, when the lattice is fitted to the grips: they are one level.
void add_level(WrinklesOf& one, const WrinkleLevel& level) {
  const auto same = [&](const WrinkleLevel& other) { return std::abs(other.size - level.size) <= 1e-6 * level.size; };
  if (std::none_of(one.level.begin(), one.level.end(), same)) one.level.push_back(level);
}

std::size_t agrees_from(const WrinklesOf& one, std::size_t measure) {
  const double finest = one.level.front().value[measure];
  if (std::isnan(finest)) return 0;
  const double scale = std::max(std::abs(finest), wrinkle_measure[measure].floor);
  std::size_t from = 0;
  const auto agrees = [&](double value) {
    return !std::isnan(value) && std::abs(value - finest) <= wrinkles_agree * scale;
  };
  while (from + 1 < one.level.size() && agrees(one.level[from + 1].value[measure])) ++from;
  return from;
}

std::string coarsening_of(const Table& table, const WrinkleLevel& level) {
  return plain_value(table.row[level.row].one, refined);
}

std::string whose(const WrinkleLevel& level) {
  return level.of.empty() ? "-" : "the " + level.of + "'s";
}

std::string cell_of(double value) {
  return std::isfinite(value) ? fmt::format("{:.3g}", value) : "-";
}

std::string verdict_of(const WrinklesOf& one, const Table& table) {
  std::string each;
  for (std::size_t m = 0; m < wrinkle_measures; ++m) {
    const std::string words = wrinkle_measure[m].words;
    const std::string from =
        one.agrees_from[m] == 0 ? "not" : "from " + coarsening_of(table, one.level[one.agrees_from[m]]);
    each += fmt::format("{}{} {}", m == 0 ? "" : "; ", words.substr(0, words.find(',')), from);
  }
  const double percent = 100.0 * wrinkles_agree;
  if (const std::size_t from = one.all_agree_from(); from > 0)
    return fmt::format("the wrinkles of {} = {} and finer agree within {:g} % ({})\n", refined,
                       coarsening_of(table, one.level[from]), percent, each);
  return fmt::format("the wrinkles do NOT agree within {:g} % ({}): believe that it wrinkles, not how\n", percent,
                     each);
}

}  // namespace

std::size_t WrinklesOf::all_agree_from() const {
  return *std::min_element(agrees_from.begin(), agrees_from.end());
}

std::vector<WrinklesOf> wrinkles_of(const Table& table, const std::filesystem::path& study_folder) {
  std::vector<WrinklesOf> all;
  for (std::size_t r = 0; r < table.row.size(); ++r) {
    const Row& row = table.row[r];
    if (!row.outcome || row.outcome->exit_code != 0 || setting_of(row.one, refined) == nullptr) continue;
    for (const auto& [ply, wrinkles] :
         wrinkles_in(case_files(study_folder, row.one.name).results / weaveform::file_name::summary))
      add_level(entry_of(all, group_of(row.one, refined), ply), level_of(r, row.size, wrinkles));
  }
  std::erase_if(all, [](const WrinklesOf& one) {
    return one.level.size() < 2 ||
           std::all_of(one.level.begin(), one.level.end(), [](const WrinkleLevel& level) { return level.of.empty(); });
  });
  for (WrinklesOf& one : all) {
    std::sort(one.level.begin(), one.level.end(), [](const auto& a, const auto& b) { return a.size < b.size; });
    for (std::size_t m = 0; m < wrinkle_measures; ++m) one.agrees_from[m] = agrees_from(one, m);
  }
  return all;
}

std::string wrinkles_markdown(const std::vector<WrinklesOf>& all, const Table& table) {
  std::string text = "Wrinkles over blank.coarsening (spacing: of the mesh, mm)\n";
  for (const WrinklesOf& one : all) {
    text += "\n";
    if (!one.ply.empty()) text += fmt::format("ply {}{}", one.ply, one.group.empty() ? "\n" : ", ");
    if (!one.group.empty()) text += one.group + "\n";
    text += fmt::format("| {} | spacing |", refined);
    for (const WrinkleMeasure& measure : wrinkle_measure) text += fmt::format(" {} |", measure.words);
    text += " cells a wave | they are |\n|---:|---:|---:|---:|---:|---:|---:|---|\n";
    for (const WrinkleLevel& level : one.level) {
      text += fmt::format("| {} | {:.4g} |", coarsening_of(table, level), level.size);
      for (const double value : level.value) text += fmt::format(" {} |", cell_of(value));
      text += fmt::format(" {} | {} |\n", cell_of(level.cells), whose(level));
    }
    text += verdict_of(one, table);
  }
  return text;
}

std::string wrinkles_csv(const std::vector<WrinklesOf>& all, const Table& table) {
  std::string text =
      "ply,group,case,blank.coarsening,spacing_mm,wavelength_mm,amplitude_mm,area_share,"
      "compressed_fibre_share,cells_per_wave,of,agrees\n";
  for (const WrinklesOf& one : all)
    for (std::size_t i = 0; i < one.level.size(); ++i) {
      const WrinkleLevel& level = one.level[i];
      text += fmt::format("{},{},{},{},{}", csv_field(one.ply), csv_field(one.group), table.row[level.row].one.name,
                          csv_field(coarsening_of(table, level)), csv_number(level.size));
      for (const double value : level.value) add_field(text, csv_number(value));
      text += fmt::format(",{},{},{}\n", csv_number(level.cells), level.of, i <= one.all_agree_from() ? 1 : 0);
    }
  return text;
}

Json wrinkles_json(const std::vector<WrinklesOf>& all, const Table& table) {
  Json json = Json::array();
  for (const WrinklesOf& one : all) {
    Json entry = {{"ply", one.ply}, {"group", one.group}, {"agree", one.all_agree_from() > 0}};
    entry["agree_from_case"] = nullptr;
    if (const std::size_t from = one.all_agree_from(); from > 0)
      entry["agree_from_case"] = table.row[one.level[from].row].one.name;
    for (const WrinkleLevel& level : one.level) {
      Json row = {{"case", table.row[level.row].one.name},
                  {"value", toml_value_json(setting_of(table.row[level.row].one, refined)->value)},
                  {"spacing_mm", level.size}};
      for (std::size_t m = 0; m < wrinkle_measures; ++m)
        row[wrinkle_measure[m].name] = std::isfinite(level.value[m]) ? Json(level.value[m]) : Json();
      row["cells_per_wave"] = std::isfinite(level.cells) ? Json(level.cells) : Json();
      row["of"] = level.of.empty() ? Json() : Json(level.of);
      entry["levels"].push_back(std::move(row));
    }
    json.push_back(std::move(entry));
  }
  return json;
}

}  // namespace weaveform::study
