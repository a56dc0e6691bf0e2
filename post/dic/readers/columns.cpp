#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "core/keys/nearest_name.hpp"
#include "post/dic/readers/readers.hpp"

namespace weaveform::dic {
namespace {

// A column's number from 1, or 0.
std::size_t number_in(const std::string& column) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(column.data(), column.data() + column.size(), number);
  return error == std::errc() && end == column.data() + column.size() ? number : 0;
}

// A heading is named whole ("U [mm]") or without its unit ("U").
std::optional<std::size_t> index_of(const std::vector<std::string>& heading, const std::string& column) {
  const auto whole = std::find(heading.begin(), heading.end(), column);
  if (whole != heading.end()) return static_cast<std::size_t>(whole - heading.begin());
  if (const auto found = find_column(heading, column)) return found;
  const std::size_t number = number_in(column);
  if (number > 0 && (heading.empty() || number <= heading.size())) return number - 1;
  return std::nullopt;
}

int required(const PointTable& table, const NamedColumn& named) {
  const auto index = index_of(table.heading, *named.second);
  if (index) return static_cast<int>(*index);
  throw InputError(fmt::format("{}: no column '{}' ({} of [measurement]){}", table.file, *named.second, named.first,
                               did_you_mean(*named.second, table.heading)));
}

double factor_of(const PointTable& table, const std::vector<std::size_t>& lengths, const MeasurementSpec& spec,
                 Questions& questions) {
  if (table.heading.empty()) return length_factor("", spec, table.file, spec.x, questions);
  return common_length_factor(table, lengths, spec, questions);
}

// Rows with the same value in the stage column, in the order they first appear.
std::vector<std::vector<std::size_t>> rows_by_stage(const std::vector<double>& value) {
  std::map<double, std::size_t> place;
  std::vector<std::vector<std::size_t>> rows;
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (!std::isfinite(value[i])) continue;
    const auto [at, fresh] = place.emplace(value[i], rows.size());
    if (fresh) rows.emplace_back();
    rows[at->second].push_back(i);
  }
  return rows;
}

MeasuredStage stage_of(const PointRows& rows, const std::vector<std::size_t>& index, const MeasurementSpec& spec) {
  MeasuredStage stage;
  PointRows own;
  std::vector<bool> failed;
  const double least = spec.quality_least.value_or(-HUGE_VAL), greatest = spec.quality_greatest.value_or(HUGE_VAL);
  for (const std::size_t i : index) {
    Vec3 position = rows.position[i];
    const Vec3& displacement = rows.displacement[i];
    // X = x - u: an export of current positions has the material point's reference position by its displacement.
    if (spec.position == PositionOf::current)
      for (std::size_t k = 0; k < 3; ++k) position[k] -= displacement[k];
    own.position.push_back(position);
    own.displacement.push_back(displacement);
    if (!spec.quality.empty()) failed.push_back(!(rows.flags[0][i] >= least && rows.flags[0][i] <= greatest));
  }
  if (spec.y_axis == YAxis::down) flip_y(own);
  take_rows(std::move(own), failed, stage);
  stage.notes.push_back(
      fmt::format("columns as mapped: {} positions, y {}", name_of(spec.position), name_of(spec.y_axis)));
  return stage;
}

}  // namespace

std::vector<NamedColumn> columns_asked(const MeasurementSpec& spec) {
  std::vector<NamedColumn> asked;
  for (const NamedColumn& named : {NamedColumn{"x", &spec.x},
                                   {"y", &spec.y},
                                   {"z", &spec.z},
                                   {"u", &spec.u},
                                   {"v", &spec.v},
                                   {"w", &spec.w},
                                   {"quality", &spec.quality},
                                   {"stage_column", &spec.stage_column}})
    if (!named.second->empty()) asked.push_back(named);
  return asked;
}

bool numbered_columns(const MeasurementSpec& spec) {
  const auto asked = columns_asked(spec);
  return !asked.empty() &&
         std::all_of(asked.begin(), asked.end(), [](const NamedColumn& named) { return number_in(*named.second) > 0; });
}

bool names_columns(const std::vector<std::string>& heading, const MeasurementSpec& spec) {
  const auto asked = columns_asked(spec);
  return heading.size() >= asked.size() && std::all_of(asked.begin(), asked.end(), [&](const NamedColumn& named) {
           return index_of(heading, *named.second).has_value();
         });
}

std::vector<MeasuredStage> read_mapped(const PointTable& table, const MeasurementSpec& spec) {
  Questions questions;
  (void)settle_up(spec, std::nullopt, table.file, "'" + spec.y + "'", questions);
  PointColumns columns;
  columns.x = required(table, {"x", &spec.x});
  columns.y = required(table, {"y", &spec.y});
  columns.u = required(table, {"u", &spec.u});
  columns.v = required(table, {"v", &spec.v});
  if (!spec.z.empty()) columns.z = required(table, {"z", &spec.z});
  if (!spec.w.empty()) columns.w = required(table, {"w", &spec.w});
  std::vector<std::size_t> lengths;
  for (const int column : {columns.x, columns.y, columns.z, columns.u, columns.v, columns.w})
    if (column >= 0) lengths.push_back(static_cast<std::size_t>(column));
  if (!spec.quality.empty()) columns.flags.push_back(required(table, {"quality", &spec.quality}));
  if (!spec.stage_column.empty()) columns.flags.push_back(required(table, {"stage_column", &spec.stage_column}));
  const PointRows rows = read_points(table, columns, factor_of(table, lengths, spec, questions));

  const std::string file = std::filesystem::path(table.file).filename().string();
  std::vector<std::size_t> all(rows.position.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  if (spec.stage_column.empty()) {
    std::vector<MeasuredStage> one = {stage_of(rows, all, spec)};
    one.front().label = file;
    one.front().questions = questions;
    return one;
  }
  std::vector<MeasuredStage> stages;
  for (const auto& index : rows_by_stage(rows.flags.back())) {
    stages.push_back(stage_of(rows, index, spec));
    stages.back().questions = questions;
    stages.back().label = fmt::format("{} ({} = {})", file, spec.stage_column, rows.flags.back()[index.front()]);
  }
  return stages;
}

}  // namespace weaveform::dic
