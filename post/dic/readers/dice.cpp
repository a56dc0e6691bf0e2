#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "post/dic/readers/readers.hpp"

namespace weaveform::dic {
namespace {

// DICe's enum Status_Flag: successes; every other number is a failure of some kind.
bool status_succeeded(double flag) {
  constexpr std::array successes = {0, 1, 2, 3, 4, 6, 15, 18};
  return std::any_of(successes.begin(), successes.end(), [flag](int good) { return flag == good; });
}

// The number that follows `words` in the header, not a number when they are not there.
double header_number(const std::vector<std::string>& header, const std::string& words) {
  for (const std::string& line : header) {
    const auto at = line.find(words);
    if (at == std::string::npos) continue;
    const auto first = line.find_first_of("-0123456789", at + words.size());
    if (first == std::string::npos) break;
    return number_of(line.substr(first, line.find_first_not_of("-0123456789.", first) - first));
  }
  return std::nan("");
}

int required(const PointTable& table, const std::string& name) {
  const auto column = find_column(table.heading, name);
  if (!column)
    throw InputError(fmt::format("{}: names no column '{}'; let DICe write it (its output_spec)", table.file, name));
  return static_cast<int>(*column);
}

}  // namespace

bool names_dice(const std::vector<std::string>& heading) {
  return has_columns(heading, {"COORDINATE_X", "COORDINATE_Y"}) ||
         has_columns(heading, {"MODEL_COORDINATES_X", "MODEL_COORDINATES_Y"});
}

MeasuredStage read_dice(const PointTable& table, const MeasurementSpec& spec) {
  MeasuredStage stage;
  stage.label = std::filesystem::path(table.file).filename().string();
  const bool model = has_columns(table.heading, {"MODEL_COORDINATES_X", "MODEL_COORDINATES_Y"});
  const bool pixels = has_columns(table.heading, {"COORDINATE_X", "COORDINATE_Y"});
  const std::string position = model ? "MODEL_COORDINATES_" : "COORDINATE_";
  const std::string displacement = model ? "MODEL_DISPLACEMENT_" : "DISPLACEMENT_";
  PointColumns columns;
  columns.x = required(table, position + "X");
  columns.y = required(table, position + "Y");
  columns.u = required(table, displacement + "X");
  columns.v = required(table, displacement + "Y");
  if (model) columns.z = required(table, position + "Z"), columns.w = required(table, displacement + "Z");
  std::vector<std::string> flags;
  for (const char* name : {"MATCH", "SIGMA", "STATUS_FLAG"}) {
    if (const auto column = find_column(table.heading, name)) {
      flags.emplace_back(name);
      columns.flags.push_back(static_cast<int>(*column));
    }
  }
  if (model && pixels) columns.flags.push_back(required(table, "COORDINATE_Y"));
  const double factor = model ? length_factor("", spec, table.file, position + "X", stage.questions)
                              : length_factor("px", spec, table.file, position + "X", stage.questions);
  PointRows rows = read_points(table, columns, factor);

  std::vector<bool> failed(rows.position.size(), false);
  for (std::size_t f = 0; f < flags.size(); ++f)
    for (std::size_t i = 0; i < failed.size(); ++i) {
      const double flag = rows.flags[f][i];
      if (!std::isfinite(flag) || (flags[f] == "STATUS_FLAG" ? !status_succeeded(flag) : flag < 0.0)) failed[i] = true;
    }
  std::string flag_words = flags.empty() ? "none in the file" : "";
  for (const auto& name : flags) flag_words += (flag_words.empty() ? "" : ", ") + name;
  stage.notes.push_back("failed correlations by: " + flag_words);

  const auto told = !model ? std::optional(false) : pixels ? y_is_up(rows.flags.back(), rows.position) : std::nullopt;
  const bool up = settle_up(spec, told, table.file, position + "Y", stage.questions);
  if (!up) flip_y(rows);
  stage.notes.push_back(fmt::format("DICe: {}, y {}{}", model ? "stereo (MODEL_ columns)" : "pixels",
                                    up ? "up" : "down, turned up",
                                    spec.y_axis != YAxis::automatic ? " as the settings say"
                                    : model                         ? ", told by COORDINATE_Y"
                                                                    : ", the image's"));
  stage.header_facet = header_number(table.header, "Subset size:");
  stage.header_step = header_number(table.header, "Step size: x");
  const double window = header_number(table.header, "Strain window size in pixels:");
  // A window of so many pixels spans that many steps; an odd number of points lies in it.
  if (window > 0.0 && stage.header_step > 0.0)
    stage.window = std::max(3, 2 * static_cast<int>(std::floor(0.5 * window / stage.header_step)) + 1);
  take_rows(std::move(rows), failed, stage);
  return stage;
}

}  // namespace weaveform::dic
