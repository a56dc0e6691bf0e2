// The report of a comparison: CSV tables, charts, comparison.json and the printed verdict.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/chart/chart.hpp"
#include "core/files/csv.hpp"
#include "core/files/files.hpp"
#include "core/json/json_text.hpp"
#include "core/vector/angle.hpp"
#include "post/dic/comparison/compare.hpp"
#include "solver/result/chart_file.hpp"

namespace weaveform::dic {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

// JSON has no "not a number".
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}
Json angle(double radians) {
  return number(radians * degrees_per_radian);
}
std::string cell(double value) {
  return csv_number(value, 7);
}

Json motion_json(const RigidMotion& motion) {
  return {{"angle_deg", angle(motion.angle)}, {"shift_mm", {number(motion.shift[0]), number(motion.shift[1])}}};
}

Json statistics_json(const FieldStatistics& s) {
  Json percentile = Json::object();
  for (std::size_t k = 0; k < percentiles.size(); ++k)
    percentile[fmt::format("p{}", percentiles[k])] = angle(s.percentile[k]);
  return {{"points", s.points},
          {"measured_deg", angle(s.measured)},
          {"levelled_deg", angle(s.levelled)},
          {"raw_deg", angle(s.raw)},
          {"difference_deg",
           {{"mean", angle(s.mean)},
            {"mean_uncertainty", angle(s.mean_noise)},
            {"rms", angle(s.rms)},
            {"sd", angle(s.sd)},
            {"greatest", angle(s.greatest)},
            {"greatest_at_mm", {number(s.greatest_at[0]), number(s.greatest_at[1])}},
            {"percentiles", percentile}}},
          {"noise_rms_deg", angle(s.noise)},
          {"within_uncertainty", number(s.within)},
          {"correlation", number(s.correlation)},
          {"slope", number(s.slope)}};
}

Json stage_json(const ComparedStage& stage) {
  Json zones = Json::object(), lines = Json::object();
  for (const FieldStatistics& zone : stage.zone) zones[zone.name] = statistics_json(zone);
  for (const LineProfile& line : stage.line)
    lines[line.name] = {{"measured_width_mm", number(line.measured_width)},
                        {"levelled_width_mm", number(line.levelled_width)},
                        {"raw_width_mm", number(line.raw_width)}};
  return {{"label", stage.label},
          {"travel_mm", stage.travel},
          {"simulated_force_N", stage.simulated_force},
          {"measured_force_N", stage.measured_force ? number(*stage.measured_force) : Json(nullptr)},
          {"points", stage.points},
          {"rows_without_values", stage.missing},
          {"failed_correlations", stage.failed},
          {"displacement_uncertainty_mm", number(stage.displacement_uncertainty)},
          {"uncertainty_estimated", stage.estimated},
          {"deformed_placement", motion_json(stage.current)},
          {"agrees", stage.verdict.agrees},
          {"verdict", stage.verdict.words},
          {"all", statistics_json(stage.all)},
          {"zones", zones},
          {"lines", lines},
          {"notes", stage.notes}};
}

}  // namespace

Json comparison_json(const Comparison& c) {
  Json json = {{"result", c.result.string()},
               {"measurement", c.files},
               {"grip", c.grip},
               {"instrument",
                {{"facet_size_mm", c.instrument.facet_size},
                 {"step_mm", c.instrument.step},
                 {"window_points", c.instrument.window},
                 {"origin", c.instrument.origin}}},
               {"registration",
                {{"method", c.placement.method},
                 {"measurement_to_blank", motion_json(c.placement.reference)},
                 {"residual_rms_mm", number(c.placement.residual)},
                 {"angle_error_deg", angle(c.placement.angle_error)},
                 {"shift_error_mm", number(c.placement.shift_error)},
                 {"used", c.placement.used},
                 {"rejected", c.placement.rejected},
                 {"off_fabric", c.placement.off_fabric}}},
               {"symmetry", name_of(c.symmetry)},
               {"coverage", c.coverage},
               {"stages", Json::array()}};
  if (!c.ply.empty()) json["instrument"]["ply"] = c.ply;
  for (const ComparedStage& stage : c.stage) json["stages"].push_back(stage_json(stage));
  if (c.load)
    json["load"] = {{"rms_difference_N", number(c.load->rms)}, {"measured_over_simulated", number(c.load->ratio)}};
  return json;
}

namespace {

std::string stages_csv(const Comparison& c) {
  std::string text = "stage,travel_mm,simulated_force_N,measured_force_N,points";
  const auto headings = [&](const std::string& name) {
    for (const char* what : {"measured_deg", "levelled_deg", "raw_deg", "difference_mean_deg", "difference_rms_deg",
                             "noise_rms_deg", "within_uncertainty"})
      text += fmt::format(",{}", csv_field(fmt::format("{}.{}", name, what)));
  };
  headings("all");
  for (const FieldStatistics& zone : c.stage.front().zone) headings(zone.name);
  text += "\n";
  for (std::size_t k = 0; k < c.stage.size(); ++k) {
    const ComparedStage& stage = c.stage[k];
    text += fmt::format("{},{},{},{},{}", k + 1, cell(stage.travel), cell(stage.simulated_force),
                        stage.measured_force ? cell(*stage.measured_force) : "", stage.all.points);
    const auto columns = [&](const FieldStatistics& s) {
      for (const double value :
           {s.measured * degrees_per_radian, s.levelled * degrees_per_radian, s.raw * degrees_per_radian,
            s.mean * degrees_per_radian, s.rms * degrees_per_radian, s.noise * degrees_per_radian, s.within})
        text += fmt::format(",{}", cell(value));
    };
    columns(stage.all);
    for (const FieldStatistics& zone : stage.zone) columns(zone);
    text += "\n";
  }
  return text;
}

std::string lines_csv(const Comparison& c) {
  std::string text = "stage,line,distance_mm,x_mm,y_mm,measured_deg,levelled_deg,raw_deg\n";
  for (std::size_t k = 0; k < c.stage.size(); ++k)
    for (const LineProfile& line : c.stage[k].line)
      for (std::size_t i = 0; i < line.distance.size(); ++i)
        text += fmt::format("{},{},{},{},{},{},{},{}\n", k + 1, csv_field(line.name), cell(line.distance[i]),
                            cell(line.place[i][0]), cell(line.place[i][1]), cell(line.measured[i] * degrees_per_radian),
                            cell(line.levelled[i] * degrees_per_radian), cell(line.raw[i] * degrees_per_radian));
  return text;
}

std::string loads_csv(const LoadCurve& load) {
  std::string text = "travel_mm,simulated_force_N,measured_force_N\n";
  for (std::size_t i = 0; i < load.travel.size(); ++i)
    text += fmt::format("{},{},{}\n", cell(load.travel[i]), cell(load.simulated[i]), cell(load.measured[i]));
  return text;
}

// Zone averages over the travel: measured as points, levelled as lines of the same colour.
Chart angle_chart(const Comparison& c) {
  Chart chart;
  chart.title = "Mean shear angle by zone";
  chart.x = {.title = fmt::format("travel of {} (mm)", c.grip)};
  chart.y = {.title = "shear angle (deg)"};
  const bool zoned = !c.stage.front().zone.empty();
  const std::size_t count = zoned ? c.stage.front().zone.size() : 1;
  for (std::size_t z = 0; z < count; ++z) {
    const auto of = [&](const ComparedStage& stage) -> const FieldStatistics& {
      return zoned ? stage.zone[z] : stage.all;
    };
    const std::string& name = of(c.stage.front()).name;
    ChartSeries measured{
        .label = fmt::format("{} measured", name), .mark = ChartMark::points, .colour = static_cast<int>(z)};
    ChartSeries levelled{
        .label = fmt::format("{} levelled", name), .mark = ChartMark::line, .colour = static_cast<int>(z)};
    for (const ComparedStage& stage : c.stage) {
      measured.x.push_back(stage.travel);
      measured.y.push_back(of(stage).measured * degrees_per_radian);
      levelled.x.push_back(stage.travel);
      levelled.y.push_back(of(stage).levelled * degrees_per_radian);
    }
    chart.series.push_back(std::move(levelled));
    chart.series.push_back(std::move(measured));
  }
  return chart;
}

Chart load_chart(const Comparison& c) {
  Chart chart;
  chart.title = "Load";
  chart.x = {.title = fmt::format("travel of {} (mm)", c.grip)};
  chart.y = {.title = "load (N)"};
  chart.series.push_back({.label = "simulated", .x = c.load->travel, .y = c.load->simulated});
  chart.series.push_back({.label = "measured", .x = c.load->travel, .y = c.load->measured, .mark = ChartMark::points});
  return chart;
}

std::string statistics_row(const FieldStatistics& s) {
  return fmt::format("{:>10} {:>7} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f} {:>7.2f} {:>7.2f} {:>9.2f} {:>7.0f} {:>7.3f}\n",
                     s.name, s.points, s.measured * degrees_per_radian, s.levelled * degrees_per_radian,
                     s.raw * degrees_per_radian, s.mean * degrees_per_radian, s.rms * degrees_per_radian,
                     s.noise * degrees_per_radian, s.greatest * degrees_per_radian, 100.0 * s.within, s.correlation);
}

}  // namespace

std::string verdict_table(const Comparison& c) {
  std::string text = fmt::format("measurement against simulation {}\n\n", c.result.string());
  text += fmt::format("registration  {}\n", c.placement.method);
  text += fmt::format("              turned {:.3f} deg, shifted ({:.3f}, {:.3f}) mm onto the blank\n",
                      c.placement.reference.angle * degrees_per_radian, c.placement.reference.shift[0],
                      c.placement.reference.shift[1]);
  if (c.placement.used > 0)
    text += fmt::format("              residual {:.4f} mm rms; {} used, {} rejected as outliers, {} off the fabric\n",
                        c.placement.residual, c.placement.used, c.placement.rejected, c.placement.off_fabric);
  text += fmt::format("instrument    facet {:.3g} mm, step {:.3g} mm, window {} x {} points ({})\n",
                      c.instrument.facet_size, c.instrument.step, c.instrument.window, c.instrument.window,
                      c.instrument.origin);
  if (!c.ply.empty()) text += fmt::format("seen          ply '{}' of the stack\n", c.ply);
  const ComparedStage& last = c.stage.back();
  if (std::isfinite(last.displacement_uncertainty))
    text += fmt::format("uncertainty   {:.4f} mm of a displacement component ({}), agreement within {} of them\n",
                        last.displacement_uncertainty, last.estimated ? "estimated" : "as given", c.coverage);
  else
    text += "uncertainty   unknown: gradients were measured, not displacements\n";
  text += fmt::format("symmetry      {}\n", name_of(c.symmetry));
  for (const std::string& note : last.notes) text += fmt::format("reading       {}\n", note);

  text += fmt::format("\n{:>10} {:>9} {:>9} {:>9} {:>9} {:>7} {:>7} {:>7} {:>10}  verdict\n", "stage", "travel",
                      "measured", "levelled", "mean", "rms", "noise", "corr", "load");
  text += fmt::format("{:>10} {:>9} {:>9} {:>9} {:>9} {:>7} {:>7} {:>7} {:>10}\n", "", "mm", "deg", "deg", "diff. deg",
                      "deg", "deg", "", "meas./sim.");
  for (std::size_t k = 0; k < c.stage.size(); ++k) {
    const ComparedStage& s = c.stage[k];
    const std::string load = s.measured_force && std::abs(s.simulated_force) > 1e-9
                                 ? fmt::format("{:.3f}", *s.measured_force / s.simulated_force)
                                 : "";
    text += fmt::format("{:>10} {:>9.3f} {:>9.2f} {:>9.2f} {:>9.2f} {:>7.2f} {:>7.2f} {:>7.3f} {:>10}  {}\n", k + 1,
                        s.travel, s.all.measured * degrees_per_radian, s.all.levelled * degrees_per_radian,
                        s.all.mean * degrees_per_radian, s.all.rms * degrees_per_radian,
                        s.all.noise * degrees_per_radian, s.all.correlation, load, s.verdict.words);
  }
  text += fmt::format("\nlast stage, {} ({} points, {} rows without values, {} failed correlations)\n", last.label,
                      last.points, last.missing, last.failed);
  text += fmt::format("{:>10} {:>7} {:>9} {:>9} {:>9} {:>9} {:>7} {:>7} {:>9} {:>7} {:>7}\n", "zone", "points",
                      "measured", "levelled", "raw", "mean", "rms", "noise", "greatest", "within", "corr");
  text += fmt::format("{:>10} {:>7} {:>9} {:>9} {:>9} {:>9} {:>7} {:>7} {:>9} {:>7} {:>7}\n", "", "", "deg", "deg",
                      "deg", "diff. deg", "deg", "deg", "deg", "%", "");
  text += statistics_row(last.all);
  for (const FieldStatistics& zone : last.zone)
    if (zone.points > 0) text += statistics_row(zone);
  for (const LineProfile& line : last.line)
    text += fmt::format("line {}: 10-90 % width measured {:.2f}, levelled {:.2f}, raw {:.2f} mm\n", line.name,
                        line.measured_width, line.levelled_width, line.raw_width);
  if (c.load)
    text += fmt::format("load: measured over simulated {:.3f} (least squares), rms difference {:.3g} N\n",
                        c.load->ratio, c.load->rms);
  return text;
}

void write_report(const Comparison& c, const fs::path& output) {
  write_text_whole(output / file_name::stage_table, stages_csv(c));
  if (!c.stage.front().line.empty()) write_text_whole(output / file_name::line_table, lines_csv(c));
  std::vector<std::pair<fs::path, Chart>> charts = {{output / file_name::angle_chart, angle_chart(c)}};
  if (c.load) {
    write_text_whole(output / file_name::load_table, loads_csv(*c.load));
    charts.emplace_back(output / file_name::load_chart, load_chart(c));
  }
  write_charts(charts);
  write_text_whole(output / file_name::comparison, json_text(comparison_json(c)));
}

}  // namespace weaveform::dic
