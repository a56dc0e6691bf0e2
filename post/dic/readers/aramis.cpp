#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "core/keys/nearest_name.hpp"
#include "post/dic/readers/readers.hpp"

namespace weaveform::dic {
namespace {

struct HeaderValue {
  std::string key, kind, value;  // "displacement", "value_element", "-9.18"; kind is "" for "key : value"
};

std::string without_blanks_around(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r#"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// "# force : value_element : 14985.6" and "# facet_size : 19.0"; a value may hold colons itself (dates).
std::vector<HeaderValue> header_values(const std::vector<std::string>& header) {
  std::vector<HeaderValue> values;
  for (const std::string& line : header) {
    const auto first = line.find(':');
    if (first == std::string::npos) continue;
    HeaderValue value{without_blanks_around(line.substr(0, first)), "", without_blanks_around(line.substr(first + 1))};
    const auto second = value.value.find(" : ");
    if (second != std::string::npos) {
      value.kind = without_blanks_around(value.value.substr(0, second));
      value.value = without_blanks_around(value.value.substr(second + 3));
    }
    values.push_back(std::move(value));
  }
  return values;
}

std::string text_of(const std::vector<HeaderValue>& values, const std::string& key) {
  for (const auto& value : values)
    if (value.kind.empty() && value.key == key) return value.value;
  return "";
}

// The machine's signal: the one the settings name, else the value element of the plain name.
std::optional<double> signal_of(const std::vector<HeaderValue>& values, const std::string& asked,
                                const std::string& plain, const std::string& key, const std::string& file) {
  std::vector<std::string> names;
  const std::string& name = asked.empty() ? plain : asked;
  for (const auto& value : values) {
    if (value.kind.empty()) continue;
    names.push_back(value.key);
    if (value.key != name) continue;
    const double number = number_of(value.value);
    if (!std::isfinite(number))
      throw InputError(fmt::format("{}: signal '{}' is '{}', not a number; correct the file or '{}' of [measurement]",
                                   file, name, value.value, key));
    return number;
  }
  if (!asked.empty())
    throw InputError(fmt::format("{}: the header has no signal '{}' ({} of [measurement]){}", file, asked, key,
                                 did_you_mean(asked, names)));
  return std::nullopt;
}

}  // namespace

bool names_aramis(const std::vector<std::string>& heading) {
  return has_columns(heading, {"x_undef", "y_undef", "u", "v"});
}

MeasuredStage read_aramis(const PointTable& table, const MeasurementSpec& spec) {
  MeasuredStage stage;
  const auto values = header_values(table.header);
  const std::string name = text_of(values, "current_stage_name");
  stage.label = std::filesystem::path(table.file).filename().string() + (name.empty() ? "" : " (" + name + ")");
  stage.header_facet = number_of(text_of(values, "facet_size"));
  stage.header_step = number_of(text_of(values, "facet_distance"));
  const auto displacement =
      signal_of(values, spec.displacement_signal, "displacement", "displacement_signal", table.file);
  if (displacement) stage.displacement = spec.displacement_factor * *displacement + spec.displacement_offset;
  const auto force = signal_of(values, spec.force_signal, "force", "force_signal", table.file);
  if (force) stage.force = spec.force_factor * *force;

  PointColumns columns;
  columns.x = column_of(table, "x_undef");
  columns.y = column_of(table, "y_undef");
  columns.z = column_of(table, "z_undef");
  columns.u = column_of(table, "u");
  columns.v = column_of(table, "v");
  columns.w = column_of(table, "w");
  std::vector<std::size_t> lengths;
  for (const int column : {columns.x, columns.y, columns.z, columns.u, columns.v, columns.w})
    if (column >= 0) lengths.push_back(static_cast<std::size_t>(column));
  PointRows rows = read_points(table, columns, common_length_factor(table, lengths, spec, stage.questions));
  if (spec.y_axis == YAxis::down) flip_y(rows);
  stage.notes.push_back(
      fmt::format("ARAMIS: positions of the undeformed stage, y {} as {}", spec.y_axis == YAxis::down ? "down" : "up",
                  spec.y_axis == YAxis::automatic ? "in the specimen's coordinate system" : "the settings say"));
  std::string strains;
  for (const auto& heading : table.heading)
    if (heading.starts_with("eps")) strains += (strains.empty() ? "" : ", ") + heading;
  if (!strains.empty()) stage.notes.push_back("strain columns not used: " + strains);
  take_rows(std::move(rows), {}, stage);
  return stage;
}

}  // namespace weaveform::dic
