// solve.json: SolveStatistics under the names of its fields.
#include "solver/result/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "solver/result/result.hpp"

namespace weaveform {

namespace {

// JSON has no "not a number": it is written as null and read back as one.
void take(const nlohmann::json& value, double& field) {
  field = value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}
void take(const nlohmann::json& value, bool& field) {
  field = value.get<bool>();
}
void take(const nlohmann::json& value, std::string& field) {
  field = value.get<std::string>();
}
// The library would wrap a count that does not fit, and cut a fraction.
template <std::integral Count>
void take(const nlohmann::json& value, Count& field) {
  constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<Count>::max());
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > most) throw std::range_error("no count");
  field = value.get<Count>();
}

// Statistics that earlier versions, which wrote the file of a finished run only, did not have.
constexpr std::array<std::string_view, 9> added_later = {"finished",
                                                         "time_s",
                                                         "program",
                                                         "scene",
                                                         "scene_digest",
                                                         "card_digest",
                                                         "mesh_digest",
                                                         "checkpoint_wall_s",
                                                         "bending_friction_work_mJ"};

}  // namespace

void write_statistics(const SolveStatistics& statistics, const std::filesystem::path& file) {
  nlohmann::ordered_json json;
  for_each_statistic(statistics, [&](const char* name, const auto& value) { json[name] = value; });
  for (const PairStatistics& pair : statistics.pairs) {
    nlohmann::ordered_json entry;
    for_each_pair_statistic(pair, [&](const char* name, const auto& value) { entry[name] = value; });
    json["pairs"].push_back(std::move(entry));
  }
  write_text_whole(file, json.dump(2) + "\n");
}

SolveStatistics read_statistics(const std::filesystem::path& file) {
  const std::string text = read_text_file(file);
  SolveStatistics statistics;
  statistics.finished = true;
  const char* current = "";
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    for_each_statistic(statistics, [&](const char* name, auto& value) {
      current = name;
      const bool may_lack = std::find(added_later.begin(), added_later.end(), name) != added_later.end();
      if (may_lack && !json.contains(name)) return;
      take(json.at(name), value);
    });
    if (json.contains("pairs"))
      for (const nlohmann::json& entry : json.at("pairs"))
        for_each_pair_statistic(statistics.pairs.emplace_back(), [&](const char* name, auto& value) {
          current = name;
          take(entry.at(name), value);
        });
  } catch (const nlohmann::json::parse_error& error) {
    throw InputError(fmt::format("{}: not JSON (byte {}); solve again", file.string(), error.byte));
  } catch (const std::exception&) {
    throw InputError(fmt::format("{}: '{}' is missing or of the wrong type; solve again", file.string(), current));
  }
  return statistics;
}

}  // namespace weaveform
