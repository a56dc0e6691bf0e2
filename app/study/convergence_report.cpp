#include "app/study/convergence_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/json/toml_json.hpp"
#include "post/report/words.hpp"

namespace weaveform::study {

namespace {

constexpr const char* coarsening = "blank.coarsening";

std::optional<double> size_of(const ConvergenceSpec& spec, const Row& row) {
  const Setting* setting = setting_of(row.one, spec.key);
  if (setting == nullptr || !setting->number || !row.outcome || row.outcome->exit_code != 0) return std::nullopt;
  if (spec.key == coarsening) return row.size;
  return spec.finer == Finer::larger ? 1.0 / *setting->number : *setting->number;
}

// Groups that have the key at two values or more: a case alone is refined by nothing.
std::vector<std::string> groups_of(const ConvergenceSpec& spec, const Table& table) {
  std::vector<std::string> groups;
  std::map<std::string, std::set<double>> values;
  for (const Row& row : table.row) {
    const std::string group = group_of(row.one, spec.key);
    if (!values.contains(group)) groups.push_back(group);
    const Setting* setting = setting_of(row.one, spec.key);
    if (setting != nullptr && setting->number) values[group].insert(*setting->number);
  }
  std::erase_if(groups, [&](const std::string& group) { return values[group].size() < 2; });
  return groups;
}

ConvergenceOf converge_group(const ConvergenceSpec& spec, const std::string& group, const std::string& measure,
                             const Table& table) {
  ConvergenceOf found{group, measure, {}, std::nullopt};
  const std::size_t column = column_of(table, measure);
  for (std::size_t i = 0; i < table.row.size(); ++i) {
    const auto size = size_of(spec, table.row[i]);
    if (!size || group_of(table.row[i].one, spec.key) != group || !std::isfinite(table.row[i].value[column])) continue;
    // Two settings may give one mesh, when the lattice is fitted to the grips: they are one level.
    const auto same = [&](const LevelRow& level) { return std::abs(level.size - *size) <= 1e-6 * *size; };
    if (std::none_of(found.level.begin(), found.level.end(), same)) found.level.push_back({i, *size});
  }
  std::sort(found.level.begin(), found.level.end(), [](const auto& a, const auto& b) { return a.size < b.size; });
  if (found.level.size() < 3) return found;
  std::vector<Level> levels;
  for (const LevelRow& level : found.level) levels.push_back({level.size, table.row[level.row].value[column]});
  found.refinement = refine(std::move(levels), spec.greatest_order);
  return found;
}

const std::string& value_of(const ConvergenceSpec& spec, const Row& row) {
  return setting_of(row.one, spec.key)->value;
}

std::string heading(const ConvergenceOf& one) {
  return fmt::format("{}{}{}", measure_in_words(one.measure), one.group.empty() ? "" : ", ", one.group);
}

nlohmann::ordered_json group_json(const ConvergenceSpec& spec, const ConvergenceOf& one, const Table& table) {
  using Json = nlohmann::ordered_json;
  Json json = {{"measure", one.measure}, {"group", one.group}, {"levels", Json::array()}};
  for (std::size_t i = 0; i < one.level.size(); ++i) {
    const Row& row = table.row[one.level[i].row];
    const Refinement* found = one.refinement ? &*one.refinement : nullptr;
    json["levels"].push_back({{"case", row.one.name},
                              {"value", toml_value_json(value_of(spec, row))},
                              {"size", one.level[i].size},
                              {"result", row.value[column_of(table, one.measure)]},
                              {"error_bound", found != nullptr ? Json(found->error_bound[i]) : Json(nullptr)},
                              {"wall_s", row.wall}});
  }
  for (const char* name : {"trend", "order", "limit", "limit_uncertainty", "agreed", "cheapest_case"})
    json[name] = nullptr;
  if (!one.refinement) return json;
  json["trend"] = trend_words(one.refinement->finest.trend);
  json["order"] = one.refinement->finest.order;
  json["limit"] = one.refinement->limit;
  json["limit_uncertainty"] = one.refinement->uncertainty;
  json["agreed"] = one.refinement->agreed;
  if (const int cheapest = coarsest_within(*one.refinement, spec.tolerance); cheapest >= 0)
    json["cheapest_case"] = table.row[one.level[static_cast<std::size_t>(cheapest)].row].one.name;
  return json;
}

}  // namespace

std::string group_of(const Case& one, const std::string& key) {
  std::string text;
  for (const Setting& setting : one.settings)
    if (setting.key != key) text += fmt::format("{}{}={}", text.empty() ? "" : " ", setting.key, setting.value);
  return text;
}

std::vector<ConvergenceOf> convergence_of(const ConvergenceSpec& spec, const std::vector<std::string>& measures,
                                          const Table& table) {
  std::vector<ConvergenceOf> all;
  for (const std::string& group : groups_of(spec, table))
    for (const std::string& measure : measures) all.push_back(converge_group(spec, group, measure, table));
  return all;
}

std::string verdict(const Refinement& refinement) {
  const Convergence& finest = refinement.finest;
  const std::string order = std::isfinite(finest.order) ? fmt::format(", observed order {:.2f}", finest.order) : "";
  std::string trust;
  if (refinement.agreed)
    trust = fmt::format("the three next coarser levels agree; grid-convergence index of the finest {:.3g} %",
                        100.0 * finest.index);
  else if (refinement.checked)
    trust = "the levels do NOT agree on a limit; the finest stands for it, broadly bounded";
  else
    trust = "three levels cannot check themselves; broadly bounded";
  return fmt::format("{}{}; limit {:.6g} within {:.2g}; {}", trend_words(finest.trend), order, refinement.limit,
                     refinement.uncertainty, trust);
}

std::string convergence_markdown(const ConvergenceSpec& spec, const std::vector<ConvergenceOf>& all,
                                 const Table& table) {
  std::string text = fmt::format("Convergence over {} ({})\n", spec.key,
                                 spec.key == coarsening ? "size: spacing of the mesh, mm" : "size: its value");
  for (const ConvergenceOf& one : all) {
    text += fmt::format("\n{}\n", heading(one));
    if (!one.refinement) {
      text += fmt::format("{} levels are done; an observed order needs three\n", one.level.size());
      continue;
    }
    text += fmt::format("| {} | size | result | error at most | solve |\n|---:|---:|---:|---:|---:|\n", spec.key);
    for (std::size_t i = 0; i < one.level.size(); ++i) {
      const Row& row = table.row[one.level[i].row];
      text += fmt::format("| {} | {:.5g} | {:.6g} | {:.3g} % | {:.3g} s |\n", value_of(spec, row), one.level[i].size,
                          one.refinement->level[i].result, 100.0 * one.refinement->error_bound[i], row.wall);
    }
    text += verdict(*one.refinement) + "\n";
    const int cheapest = coarsest_within(*one.refinement, spec.tolerance);
    text += cheapest < 0 ? fmt::format("no level is within {:.3g} %\n", 100.0 * spec.tolerance)
                         : fmt::format("cheapest within {:.3g} %: {} = {}\n", 100.0 * spec.tolerance, spec.key,
                                       value_of(spec, table.row[one.level[static_cast<std::size_t>(cheapest)].row]));
  }
  return text;
}

nlohmann::ordered_json convergence_json(const ConvergenceSpec& spec, const std::vector<ConvergenceOf>& all,
                                        const Table& table) {
  nlohmann::ordered_json json = {
      {"key", spec.key}, {"tolerance", spec.tolerance}, {"measures", nlohmann::ordered_json::array()}};
  for (const ConvergenceOf& one : all) json["measures"].push_back(group_json(spec, one, table));
  return json;
}

std::string convergence_csv(const ConvergenceSpec& spec, const std::vector<ConvergenceOf>& all, const Table& table) {
  std::string text =
      "measure,group,case," + csv_field(spec.key) + ",size,result,error_bound,order,limit,limit_uncertainty,trend\n";
  for (const ConvergenceOf& one : all) {
    if (!one.refinement) continue;
    const Refinement& refinement = *one.refinement;
    for (std::size_t i = 0; i < one.level.size(); ++i) {
      const Row& row = table.row[one.level[i].row];
      const std::string order = i < refinement.order.size() ? csv_number(refinement.order[i], 6) : "";
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", csv_field(one.measure), csv_field(one.group),
                          row.one.name, csv_field(value_of(spec, row)), csv_number(one.level[i].size),
                          csv_number(refinement.level[i].result), csv_number(refinement.error_bound[i], 6), order,
                          csv_number(refinement.limit), csv_number(refinement.uncertainty, 6),
                          trend_words(refinement.finest.trend));
    }
  }
  return text;
}

}  // namespace weaveform::study
