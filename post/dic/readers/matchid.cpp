#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "post/dic/readers/readers.hpp"

namespace weaveform::dic {
namespace {

// The names of two generations of the program.
struct MatchidNames {
  const char *x_pixel, *y_pixel, *x, *y, *z, *u, *v, *w;
  const char* unit;  // of the pixel columns when the heading has none
};
constexpr std::array<MatchidNames, 2> generations = {{
    {"Coordinates.Image X", "Coordinates.Image Y", "coor.X", "coor.Y", "coor.Z", "disp.Horizontal Displacement U",
     "disp.Vertical Displacement V", "disp.Out-Of-Plane: W", ""},
    {"x_pic", "y_pic", "x", "y", "z", "u", "v", "w", "px"},
}};

bool has_displacements(const std::vector<std::string>& heading, const MatchidNames& n) {
  return has_columns(heading, {n.u, n.v}) &&
         (has_columns(heading, {n.x_pixel, n.y_pixel}) || (n.unit[0] == '\0' && has_columns(heading, {n.x, n.y})));
}

}  // namespace

bool names_matchid(const std::vector<std::string>& heading) {
  return std::any_of(generations.begin(), generations.end(),
                     [&](const MatchidNames& names) { return has_displacements(heading, names); });
}

MeasuredStage read_matchid(const PointTable& table, const MeasurementSpec& spec) {
  MeasuredStage stage;
  stage.label = std::filesystem::path(table.file).filename().string();
  const MatchidNames& names = *std::find_if(generations.begin(), generations.end(),
                                            [&](const MatchidNames& n) { return has_displacements(table.heading, n); });
  const bool lengths = has_columns(table.heading, {names.x, names.y});
  PointColumns columns;
  columns.x = column_of(table, lengths ? names.x : names.x_pixel);
  columns.y = column_of(table, lengths ? names.y : names.y_pixel);
  columns.u = column_of(table, names.u);
  columns.v = column_of(table, names.v);
  if (lengths) columns.z = column_of(table, names.z);
  columns.w = column_of(table, names.w);
  std::vector<std::size_t> same_unit;
  for (const int column : {columns.x, columns.y, columns.z, columns.u, columns.v, columns.w})
    if (column >= 0) same_unit.push_back(static_cast<std::size_t>(column));
  const bool bare = column_name(table.heading[same_unit.front()]).unit.empty();
  const double factor = bare && !lengths ? length_factor("px", spec, table.file, names.x_pixel, stage.questions)
                                         : common_length_factor(table, same_unit, spec, stage.questions);
  const int pixel = column_of(table, names.y_pixel);
  if (pixel >= 0) columns.flags.push_back(pixel);
  PointRows rows = read_points(table, columns, factor);
  const auto told = !lengths     ? std::optional(false)
                    : pixel >= 0 ? y_is_up(rows.flags.front(), rows.position)
                                 : std::nullopt;
  const bool up =
      settle_up(spec, told, table.file, table.heading[static_cast<std::size_t>(columns.y)], stage.questions);
  if (!up) flip_y(rows);
  stage.notes.push_back("failed correlations by: points without numbers");
  stage.notes.push_back(fmt::format("MatchID: columns {} and {}, y {}{}", lengths ? names.x : names.x_pixel, names.u,
                                    up ? "up" : "down, turned up",
                                    spec.y_axis != YAxis::automatic ? " as the settings say"
                                    : lengths                       ? ", told by the pixel column"
                                                                    : ", the image's"));
  take_rows(std::move(rows), {}, stage);
  return stage;
}

}  // namespace weaveform::dic
