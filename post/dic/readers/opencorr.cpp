#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/error.hpp"
#include "post/dic/readers/readers.hpp"

namespace weaveform::dic {
namespace {

bool is_stereo(const std::vector<std::string>& heading) {
  return has_columns(heading, {"r1r2 ZNCC"}) || has_columns(heading, {"r1t1 ZNCC"}) ||
         has_columns(heading, {"ref_x", "ref_y"});
}

// Rows with a correlation that failed: codes below zero, zero where it was never computed, no number at all.
std::vector<bool> failed_rows(const PointRows& rows, std::size_t correlations) {
  std::vector<bool> failed(rows.position.size(), false);
  for (std::size_t f = 0; f < correlations; ++f)
    for (std::size_t i = 0; i < failed.size(); ++i)
      if (!(rows.flags[f][i] > 0.0)) failed[i] = true;
  return failed;
}

}  // namespace

bool names_opencorr(const std::vector<std::string>& heading) {
  if (!has_columns(heading, {"x", "y", "u", "v"})) return false;
  if (is_stereo(heading)) return true;
  if (has_columns(heading, {"z"}) || has_columns(heading, {"w"})) return false;  // of a volume
  return has_columns(heading, {"ZNCC"}) || has_columns(heading, {"zncc"}) ||
         has_columns(heading, {"ux", "uy", "uxx", "vx", "vy", "vxx"});
}

MeasuredStage read_opencorr(const PointTable& table, const MeasurementSpec& spec) {
  MeasuredStage stage;
  stage.label = std::filesystem::path(table.file).filename().string();
  const bool stereo = is_stereo(table.heading);
  if (stereo && !has_columns(table.heading, {"ref_x", "ref_y", "w"}))
    throw InputError(
        fmt::format("{}: is an OpenCorr stereo table without ref_x, ref_y, ref_z: x and y are pixels, u, v "
                    "and w lengths, so that no point has a place; let OpenCorr write the whole table "
                    "(saveTable2DS after the reconstruction of both states)",
                    table.file));
  PointColumns columns;
  columns.x = column_of(table, stereo ? "ref_x" : "x");
  columns.y = column_of(table, stereo ? "ref_y" : "y");
  columns.u = column_of(table, "u");
  columns.v = column_of(table, "v");
  if (stereo) columns.z = column_of(table, "ref_z"), columns.w = column_of(table, "w");
  std::vector<std::string> correlations;
  for (const char* name : {"ZNCC", "zncc", "r1r2 ZNCC", "r1t1 ZNCC", "r1t2 ZNCC"})
    if (const int column = column_of(table, name); column >= 0) {
      correlations.emplace_back(name);
      columns.flags.push_back(column);
    }
  if (stereo) columns.flags.push_back(column_of(table, "y"));
  if (stereo && spec.length_unit == MeasuredUnit::px)
    throw InputError(
        fmt::format("{}: is an OpenCorr stereo table, whose u, v, w and ref_ columns are lengths, but "
                    "length_unit of [measurement] is '{}'; give the unit of the calibration (mm, m, ...)",
                    table.file, name_of(spec.length_unit)));
  // OpenCorr names no units; a user may have added them
  std::vector<std::size_t> lengths;
  for (const int column : {columns.x, columns.y, columns.z, columns.u, columns.v, columns.w})
    if (column >= 0) lengths.push_back(static_cast<std::size_t>(column));
  const std::string written = column_name(table.heading[lengths.front()]).unit;
  const std::string unit = !written.empty()                              ? written
                           : stereo                                      ? ""
                           : spec.length_unit == MeasuredUnit::automatic ? "px"
                                                                         : name_of(spec.length_unit);
  const double factor = unit == written ? common_length_factor(table, lengths, spec, stage.questions)
                                        : length_factor(unit, spec, table.file, "x", stage.questions);
  PointRows rows = read_points(table, columns, factor);

  std::string by;
  for (const auto& name : correlations) by += (by.empty() ? "" : ", ") + name;
  stage.notes.push_back("failed correlations by: " + (by.empty() ? "none in the file" : by + " not above 0"));
  const std::vector<bool> failed = failed_rows(rows, correlations.size());
  // In stereo the world's y is whatever the calibration made it: the pixels tell, of good points only.
  std::optional<bool> told;
  if (!stereo && is_pixel(unit)) told = false;
  if (stereo) {
    std::vector<double> pixel = rows.flags.back();
    for (std::size_t i = 0; i < pixel.size(); ++i)
      if (failed[i]) pixel[i] = std::nan("");
    told = y_is_up(pixel, rows.position);
  }
  const bool up = settle_up(spec, told, table.file, stereo ? "ref_y" : "y", stage.questions);
  if (!up) flip_y(rows);
  stage.notes.push_back(fmt::format("OpenCorr: {}, y {}{}",
                                    stereo ? "stereo (ref_ columns and u, v, w)" : "planar table",
                                    up ? "up" : "down, turned up",
                                    spec.y_axis != YAxis::automatic ? " as the settings say"
                                    : stereo                        ? ", told by the pixel column"
                                                                    : ", the image's"));
  take_rows(std::move(rows), failed, stage);
  return stage;
}

}  // namespace weaveform::dic
