#include "post/report/measured.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/chart/chart_json.hpp"
#include "core/error.hpp"
#include "core/files/files.hpp"
#include "mesher/mesh/vtu_grid.hpp"
#include "post/dic/comparison/compare.hpp"
#include "post/report/base64.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

double number(const Json& value) {
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::string shown(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

Chart chart_over_stages(const Json& stages, const std::string& grip, const std::string& title, const std::string& y) {
  Chart chart{.title = title};
  chart.x.title = fmt::format("travel of {} (mm)", grip);
  chart.y.title = y;
  chart.series = {{.label = "measured", .mark = ChartMark::points}, {.label = "simulated", .mark = ChartMark::line}};
  for (const Json& stage : stages)
    for (ChartSeries& series : chart.series) series.x.push_back(number(stage["travel_mm"]));
  return chart;
}

Json charts_of(const Json& comparison) {
  const Json& stages = comparison["stages"];
  const std::string grip = comparison["grip"];
  Chart angle = chart_over_stages(stages, grip, "Mean shear angle, measured and simulated", "shear angle (°)");
  angle.series[1].label = "simulated, as the instrument sees it";
  Chart load = chart_over_stages(stages, grip, "Load, measured and simulated", "force (N)");
  bool has_load = false;
  for (const Json& stage : stages) {
    angle.series[0].y.push_back(number(stage["all"]["measured_deg"]));
    angle.series[1].y.push_back(number(stage["all"]["levelled_deg"]));
    load.series[0].y.push_back(number(stage["measured_force_N"]));
    load.series[1].y.push_back(number(stage["simulated_force_N"]));
    has_load = has_load || std::isfinite(load.series[0].y.back());
  }
  Json charts = Json::array();
  charts.push_back(chart_json("measured_angle", angle));
  if (has_load) charts.push_back(chart_json("measured_load", load));
  return charts;
}

Json table_of(const Json& comparison) {
  Json table = {{"title", "Measurement against simulation"},
                {"columns",
                 {"stage", "travel (mm)", "measured angle (°)", "simulated, as the instrument sees it (°)",
                  "difference, RMS (°)", "measured load (N)", "simulated load (N)", "verdict"}},
                {"rows", Json::array()},
                {"links", Json::array()}};
  for (const Json& stage : comparison["stages"]) {
    table["rows"].push_back({stage["label"], stage["travel_mm"], shown(number(stage["all"]["measured_deg"]), "{:.2f}"),
                             shown(number(stage["all"]["levelled_deg"]), "{:.2f}"),
                             shown(number(stage["all"]["difference_deg"]["rms"]), "{:.2f}"),
                             shown(number(stage["measured_force_N"]), "{:.4g}"),
                             shown(number(stage["simulated_force_N"]), "{:.4g}"), stage["verdict"]});
    table["links"].push_back(nullptr);
  }
  return table;
}

fs::path last_stage_file(const fs::path& folder, std::size_t stages) {
  return folder / dic::file_name::stage_fields / fmt::format("stage_{:03}.vtu", stages);
}

const VtuArray& array_of(const VtuGrid& grid, const fs::path& file, const std::string& name, int components) {
  const VtuArray* array = find_array(grid.point_data, name);
  if (array == nullptr || array->components != components)
    throw InputError(fmt::format("{}: has no '{}' of {} components; compare again", file.string(), name, components));
  return *array;
}

// Points of the blank where they were measured to be; those without a value are left as they lie on it.
Json field_of(const fs::path& file, const std::string& label, std::size_t frame) {
  const VtuGrid grid =
      read_vtu(file, std::vector<std::string>{"measured_deg", "measured_displacement_mm"}, "compare again");
  const VtuArray& angle = array_of(grid, file, "measured_deg", 1);
  const VtuArray& moved = array_of(grid, file, "measured_displacement_mm", 3);
  std::vector<float> points, values;
  for (std::size_t p = 0; p < grid.point.size(); ++p) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double u = moved.as_double(3 * p + c);
      points.push_back(static_cast<float>(grid.point[p][c] + (std::isfinite(u) ? u : 0.0)));
    }
    values.push_back(static_cast<float>(std::abs(angle.as_double(p))));
  }
  std::vector<std::uint32_t> triangles;
  for (std::size_t t = 0; t < grid.cells(); ++t)
    if (grid.offset[t + 1] - grid.offset[t] == 3)
      for (std::int64_t k = grid.offset[t]; k < grid.offset[t + 1]; ++k)
        triangles.push_back(static_cast<std::uint32_t>(grid.node[static_cast<std::size_t>(k)]));
  return {{"title", fmt::format("measured, {}", label)},
          {"points", base64(points)},
          {"triangles", triangles.empty() ? Json(nullptr) : Json(base64(triangles))},
          {"frame", frame},
          {"field", "shear_angle"},
          {"values", base64(values)}};
}

// The frame whose grip has come nearest to the stage's travel.
std::size_t frame_at(ResultFolder& folder, const std::vector<FrameFile>& frames, const std::string& grip,
                     double travel) {
  const std::vector<double> time = folder.history().values("time_s");
  const std::vector<double> way = folder.history().values(grip + ".displacement_mm");
  std::size_t best = frames.size() - 1;
  double least = std::numeric_limits<double>::max();
  for (std::size_t f = 0; f < frames.size(); ++f) {
    std::size_t row = 0;
    while (row + 1 < time.size() && time[row] < frames[f].time) ++row;
    const double off = std::abs(way[row] - travel);
    if (off < least) least = off, best = f;
  }
  return best;
}

}  // namespace

std::optional<MeasuredPage> measured_page(ResultFolder& folder, const std::vector<FrameFile>& frames) {
  const fs::path directory = folder.directory() / dic::file_name::default_comparison;
  const fs::path file = directory / dic::file_name::comparison;
  if (!fs::exists(file)) return {};
  try {
    const Json comparison = Json::parse(read_text_file(file));
    const Json& stages = comparison.at("stages");
    if (stages.empty()) return {};
    MeasuredPage page{Json(nullptr), charts_of(comparison), table_of(comparison)};
    const fs::path fields = last_stage_file(directory, stages.size());
    if (fs::exists(fields))
      page.field = field_of(fields, stages.back()["label"],
                            frame_at(folder, frames, comparison["grip"], number(stages.back()["travel_mm"])));
    return page;
  } catch (const Json::exception&) {
    throw InputError(fmt::format("{}: is not a comparison as this program writes it; compare again", file.string()));
  }
}

}  // namespace weaveform
