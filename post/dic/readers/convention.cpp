#include "post/dic/readers/convention.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "core/files/text_words.hpp"

namespace weaveform::dic {
namespace {

// mm of each length unit, under the names files use; "µ" as UTF-8, as Latin-1 and as "u".
const std::map<std::string, double> millimetres = {
    {"mm", 1.0},     {"cm", 10.0}, {"m", 1000.0},  {"um", 1e-3}, {"\xC2\xB5m", 1e-3},
    {"\xB5m", 1e-3}, {"in", 25.4}, {"inch", 25.4}, {"\"", 25.4}, {"micron", 1e-3},
};

}  // namespace

bool is_pixel(const std::string& unit) {
  const std::string word = lower(unit);
  return word == "px" || word == "pixel" || word == "pixels" || word == "pix";
}

bool settle_up(const MeasurementSpec& spec, const std::optional<bool>& told, const std::string& file,
               const std::string& column, Questions& questions) {
  if (spec.y_axis != YAxis::automatic) return spec.y_axis == YAxis::up;
  if (!told)
    ask(questions, {fmt::format("{}: does {} point up or down on the specimen? the file does not tell;", file, column),
                    "measurement.y_axis", "up"});
  return told.value_or(false);
}

std::vector<std::string> quality_columns(const std::vector<std::string>& heading,
                                         const std::vector<std::string>& known) {
  std::vector<std::string> found;
  for (const std::string& cell : heading) {
    const std::string name = column_name(cell).name, word = lower(name);
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    constexpr std::array<const char*, 10> words = {"corr", "ncc",   "quality", "valid", "status",
                                                   "flag", "match", "conver",  "error", "residu"};
    if (std::any_of(words.begin(), words.end(), [&](const char* w) { return word.find(w) != std::string::npos; }))
      found.push_back(cell);
  }
  return found;
}

ColumnName column_name(const std::string& heading) {
  const auto open = heading.find_first_of("[(");
  if (open == std::string::npos) return {heading, ""};
  const auto close = heading.find_first_of("])", open);
  std::string name = heading.substr(0, open);
  while (!name.empty() && name.back() == ' ') name.pop_back();
  return {name, heading.substr(open + 1, close == std::string::npos ? close : close - open - 1)};
}

std::optional<std::size_t> find_column(const std::vector<std::string>& heading, const std::string& name) {
  const auto found =
      std::find_if(heading.begin(), heading.end(), [&](const auto& cell) { return column_name(cell).name == name; });
  if (found == heading.end()) return std::nullopt;
  return static_cast<std::size_t>(found - heading.begin());
}

bool has_columns(const std::vector<std::string>& heading, const std::vector<std::string>& names) {
  return std::all_of(names.begin(), names.end(), [&](const auto& name) { return find_column(heading, name); });
}

double length_factor(const std::string& unit, const MeasurementSpec& spec, const std::string& file,
                     const std::string& column, Questions& questions) {
  const bool stated = spec.length_unit != MeasuredUnit::automatic;
  if (unit.empty() && !stated) {
    ask(questions, {fmt::format("{}: column '{}' has no unit: is it in mm, m, um, in or pixels?", file, column),
                    "measurement.length_unit", "mm"});
    return 1.0;
  }
  const std::string asked = name_of(spec.length_unit);
  if (stated && !unit.empty() && asked != unit && !(is_pixel(asked) && is_pixel(unit)))
    throw InputError(
        fmt::format("{}: column '{}' says [{}], but length_unit of [measurement] is '{}'; which is right? "
                    "correct one of them",
                    file, column, unit, asked));
  const std::string& use = unit.empty() ? asked : unit;
  if (is_pixel(use)) {
    if (spec.pixel_size) return *spec.pixel_size;
    ask(questions, {fmt::format("{}: column '{}' is in pixels: how many mm is one pixel?", file, column),
                    "measurement.pixel_size", "0.05"});
    return 1.0;
  }
  const auto found = millimetres.find(use);
  if (found == millimetres.end())
    throw InputError(
        fmt::format("{}: column '{}' has the unit '{}', which is no length known here (mm, cm, m, um, in, "
                    "px); is it a position or displacement?",
                    file, column, use));
  return found->second;
}

double common_length_factor(const PointTable& table, const std::vector<std::size_t>& columns,
                            const MeasurementSpec& spec, Questions& questions) {
  const std::string& first = table.heading[columns.front()];
  for (const std::size_t column : columns)
    if (column_name(table.heading[column]).unit != column_name(first).unit)
      throw InputError(fmt::format("{}: columns '{}' and '{}' differ in their unit; export both in one", table.file,
                                   first, table.heading[column]));
  return length_factor(column_name(first).unit, spec, table.file, column_name(first).name, questions);
}

PointRows read_points(const PointTable& table, const PointColumns& columns, double factor) {
  std::vector<std::size_t> wanted;
  const auto ask = [&](int column) {
    if (column < 0) return -1;
    const auto index = static_cast<std::size_t>(column);
    const auto found = std::find(wanted.begin(), wanted.end(), index);
    if (found != wanted.end()) return static_cast<int>(found - wanted.begin());
    wanted.push_back(index);
    return static_cast<int>(wanted.size()) - 1;
  };
  const std::array<int, 3> position = {ask(columns.x), ask(columns.y), ask(columns.z)};
  const std::array<int, 3> displacement = {ask(columns.u), ask(columns.v), ask(columns.w)};
  std::vector<int> flags;
  for (const int column : columns.flags) flags.push_back(ask(column));
  auto numbers = read_columns(table, wanted);
  PointRows rows;
  const std::size_t count = numbers.empty() ? 0 : numbers.front().size();
  rows.position.assign(count, {0.0, 0.0, 0.0});
  rows.displacement.assign(count, {0.0, 0.0, 0.0});
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < count; ++i) {
      if (position[k] >= 0) rows.position[i][k] = factor * numbers[static_cast<std::size_t>(position[k])][i];
      if (displacement[k] >= 0)
        rows.displacement[i][k] = factor * numbers[static_cast<std::size_t>(displacement[k])][i];
    }
  }
  for (const int flag : flags) rows.flags.push_back(numbers[static_cast<std::size_t>(flag)]);
  return rows;
}

void flip_y(PointRows& rows) {
  for (auto* field : {&rows.position, &rows.displacement})
    for (Vec3& v : *field) {
      v[1] = -v[1];
      v[2] = -v[2];
    }
}

void take_rows(PointRows rows, const std::vector<bool>& failed, MeasuredStage& stage) {
  const auto known = [](const Vec3& v) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); };
  for (std::size_t i = 0; i < rows.position.size(); ++i) {
    const bool bad = !failed.empty() && failed[i];
    if (bad) ++stage.failed;
    if (!known(rows.position[i])) {
      if (!bad) ++stage.missing;
      continue;
    }
    const bool measured = known(rows.displacement[i]);
    if (!measured && !bad) ++stage.missing;
    stage.reference.push_back(rows.position[i]);
    stage.displacement_field.push_back(rows.displacement[i]);
    stage.valid.push_back(measured && !bad);
  }
}

std::optional<bool> y_is_up(const std::vector<double>& y_pixel, const std::vector<Vec3>& position) {
  double mean_pixel = 0.0, mean_y = 0.0;
  std::size_t count = 0;
  const auto both = [&](std::size_t i) { return std::isfinite(y_pixel[i]) && std::isfinite(position[i][1]); };
  for (std::size_t i = 0; i < position.size(); ++i) {
    if (!both(i)) continue;
    mean_pixel += y_pixel[i];
    mean_y += position[i][1];
    ++count;
  }
  if (count < 3) return std::nullopt;
  mean_pixel /= static_cast<double>(count);
  mean_y /= static_cast<double>(count);
  double product = 0.0, pixel_square = 0.0, y_square = 0.0;
  for (std::size_t i = 0; i < position.size(); ++i) {
    if (!both(i)) continue;
    const double a = y_pixel[i] - mean_pixel, b = position[i][1] - mean_y;
    product += a * b;
    pixel_square += a * a;
    y_square += b * b;
  }
  // A frame turned by more than some 60 degrees against the camera says nothing sure about up and down.
  const double correlation = product / std::sqrt(pixel_square * y_square);
  if (!(std::abs(correlation) > 0.5)) return std::nullopt;
  return correlation < 0.0;
}

}  // namespace weaveform::dic
