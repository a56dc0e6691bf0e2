#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "post/dic/readers/readers.hpp"

namespace weaveform::dic {
namespace {

struct VicColumns {
  std::array<const char*, 3> position, displacement;  // third: "" in two dimensions
  bool pixels;                                        // no unit in the heading means pixels of the image
};

// In the order they are preferred where a file has several.
constexpr std::array<VicColumns, 3> kinds = {{
    {{"X", "Y", "Z"}, {"U", "V", "W"}, false},
    {{"x_c", "y_c", ""}, {"u_c", "v_c", ""}, false},
    {{"x", "y", ""}, {"u", "v", ""}, true},
}};

bool has(const std::vector<std::string>& heading, const VicColumns& kind) {
  return has_columns(heading, {kind.position[0], kind.position[1], kind.displacement[0], kind.displacement[1]});
}

struct VicUnits {
  bool alone = false;    // x, y, u, v and nothing else: no column tells the program
  bool unknown = false;  // ... and the settings do not tell the unit either
  bool pixels = false;
  double factor = 1.0;  // mm per unit
};

VicUnits units_of(const PointTable& table, const VicColumns& kind, const PointColumns& columns,
                  const MeasurementSpec& spec, Questions& questions) {
  std::vector<std::size_t> lengths;
  for (const int column : {columns.x, columns.y, columns.z, columns.u, columns.v, columns.w})
    if (column >= 0) lengths.push_back(static_cast<std::size_t>(column));
  const std::string unit = column_name(table.heading[lengths.front()]).unit;
  const bool stated = spec.length_unit != MeasuredUnit::automatic;
  VicUnits units;
  units.alone = kind.pixels && unit.empty() && table.heading.size() == lengths.size();
  units.unknown = units.alone && !stated && !spec.pixel_size;
  units.pixels = kind.pixels && (unit.empty() ? !stated || spec.length_unit == MeasuredUnit::px : is_pixel(unit));
  units.factor = units.pixels && unit.empty() && !units.unknown
                     ? length_factor("px", spec, table.file, kind.position[0], questions)
                     : common_length_factor(table, lengths, spec, questions);
  return units;
}

// VIC writes sigma = -1 where the correlation failed, and then often zeros for everything else, which are no place.
std::vector<bool> failed_rows(PointRows& rows, bool with_pixels) {
  std::vector<bool> failed(rows.position.size(), false);
  for (std::size_t i = 0; i < failed.size(); ++i) {
    failed[i] = !(rows.flags[0][i] >= 0.0);
    if (!failed[i] || rows.position[i] != Vec3{0.0, 0.0, 0.0}) continue;
    rows.position[i][0] = std::numeric_limits<double>::quiet_NaN();
    if (with_pixels) rows.flags.back()[i] = rows.position[i][0];
  }
  return failed;
}

void ask_about_quality(const PointTable& table, Questions& questions) {
  const auto quality = quality_columns(table.heading, {});
  if (quality.empty()) return;
  ask(questions, {fmt::format("{}: does '{}' tell failed points from good ones? map it as 'quality' with format = "
                              "\"columns\", or say that the file is VIC's;",
                              table.file, quality.front()),
                  "measurement.format", "vic"});
}

}  // namespace

bool only_vic(const std::vector<std::string>& heading) {
  const bool own_names = has(heading, kinds[0]) || has(heading, kinds[1]);
  const auto x = find_column(heading, "x");
  if (own_names || !x || !column_name(heading[*x]).unit.empty()) return true;
  return std::all_of(heading.begin(), heading.end(), [](const std::string& cell) {
    static const std::vector<std::string> known = {"x",     "y",   "u",   "v",     "q",     "r",          "theta",
                                                   "sigma", "e1",  "e2",  "gamma", "Index", "index",      "n",
                                                   "exx",   "eyy", "exy", "omega", "",      "e_vonmises", "e_tresca"};
    return std::find(known.begin(), known.end(), column_name(cell).name) != known.end();
  });
}

bool names_vic(const std::vector<std::string>& heading) {
  return std::any_of(kinds.begin(), kinds.end(), [&](const VicColumns& kind) { return has(heading, kind); });
}

MeasuredStage read_vic(const PointTable& table, const MeasurementSpec& spec) {
  MeasuredStage stage;
  stage.label = std::filesystem::path(table.file).filename().string();
  const auto kind =
      std::find_if(kinds.begin(), kinds.end(), [&](const VicColumns& k) { return has(table.heading, k); });
  PointColumns columns;
  columns.x = column_of(table, kind->position[0]);
  columns.y = column_of(table, kind->position[1]);
  columns.z = column_of(table, kind->position[2]);
  columns.u = column_of(table, kind->displacement[0]);
  columns.v = column_of(table, kind->displacement[1]);
  columns.w = column_of(table, kind->displacement[2]);
  const VicUnits units = units_of(table, *kind, columns, spec, stage.questions);
  const auto sigma = find_column(table.heading, "sigma");
  if (sigma) columns.flags.push_back(static_cast<int>(*sigma));
  const int y_pixel = kind->pixels ? -1 : column_of(table, "y");
  if (y_pixel >= 0) columns.flags.push_back(y_pixel);
  PointRows rows = read_points(table, columns, units.factor);
  const auto failed = sigma ? failed_rows(rows, y_pixel >= 0) : std::vector<bool>(rows.position.size(), false);
  stage.notes.push_back(sigma ? "failed correlations by: sigma < 0" : "failed correlations by: none in the file");
  if (!sigma && spec.format == MeasurementFormat::automatic) ask_about_quality(table, stage.questions);

  const auto told = units.unknown  ? std::nullopt
                    : units.pixels ? std::optional(false)
                    : y_pixel >= 0 ? y_is_up(rows.flags.back(), rows.position)
                                   : std::nullopt;
  const bool up = settle_up(spec, told, table.file, kind->position[1], stage.questions);
  if (!up) flip_y(rows);
  stage.notes.push_back(fmt::format("{}: columns {} {} and {} {}, y {}{}", units.alone ? "table" : "VIC",
                                    kind->position[0], kind->position[1], kind->displacement[0], kind->displacement[1],
                                    up ? "up" : "down, turned up",
                                    spec.y_axis != YAxis::automatic ? " as the settings say"
                                    : units.pixels                  ? ", the image's"
                                                                    : ", told by the pixel column"));
  take_rows(std::move(rows), failed, stage);
  return stage;
}

}  // namespace weaveform::dic
