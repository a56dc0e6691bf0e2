#include "post/report/run_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/chart/chart_json.hpp"
#include "core/vector/angle.hpp"
#include "post/forming/forming_charts.hpp"
#include "post/report/words.hpp"

namespace weaveform {
namespace {

using Json = nlohmann::ordered_json;

constexpr double bin = 2.0;  // deg; of the distribution of angles

// Over what a run goes on: the travel of what moves most, else time.
struct Progress {
  std::string title;
  std::vector<double> value;
};

Progress progress_of(const Scene& scene, const History& history) {
  std::string mover;
  double most = 0.0;
  const auto look = [&](const std::string& name) {
    if (history.index(name + ".displacement_mm") < 0) return;
    const double way = std::abs(history.values(name + ".displacement_mm").back());
    if (way > most) most = way, mover = name;
  };
  for (const GripSpec& grip : scene.grip) look(grip.name);
  for (const ToolSpec& tool : scene.tools)
    if (!tool.force) look(tool.name);
  if (mover.empty()) return {"time in the analysis (s)", history.values("time_s")};
  return {fmt::format("travel of {} (mm)", mover), history.values(mover + ".displacement_mm")};
}

Chart titled(const std::string& title, const std::string& x, const std::string& y) {
  Chart chart{.title = title};
  chart.x.title = x;
  chart.y.title = y;
  return chart;
}

void add_series(Chart& chart, const std::string& label, const std::vector<double>& x, std::vector<double> y,
                ChartMark mark = ChartMark::line) {
  chart.series.push_back({.label = label, .x = x, .y = std::move(y), .mark = mark});
}

Chart force_chart(const Scene& scene, const History& history, const Progress& progress, const Summary& summary) {
  Chart chart = titled("Force", progress.title, "force along its own motion (N)");
  for (const GripSpec& grip : scene.grip)
    add_series(chart, grip.name, progress.value, history.values(grip.name + ".force_N"));
  if (!summary.bias) return chart;
  ChartSeries ideal{.label = "ideal: inextensible yarns", .mark = ChartMark::dashed};
  for (const BiasRow& row : summary.bias->row) {
    ideal.x.push_back(row.travel);
    ideal.y.push_back(row.ideal_load);
  }
  chart.series.push_back(std::move(ideal));
  return chart;
}

Chart angle_chart(const Scene& scene, const History& history, const Progress& progress, const Summary& summary) {
  Chart chart = titled("Shear angle", progress.title, "shear angle (°)");
  for (const MeasureSpec& measure : scene.measure) {
    add_series(chart, measure.name, progress.value, history.values(measure.name + ".shear_angle_deg"));
    for (const char* end : {"min", "max"})
      add_series(chart, fmt::format("{}, {}", measure.name, std::string(end) == "min" ? "least" : "greatest"),
                 progress.value, history.values(fmt::format("{}.shear_angle_{}_deg", measure.name, end)),
                 ChartMark::dashed);
  }
  if (summary.bias) {
    ChartSeries ideal{.label = "ideal (Eq. 14)", .mark = ChartMark::dashed};
    for (const BiasRow& row : summary.bias->row) {
      ideal.x.push_back(row.travel);
      ideal.y.push_back(row.ideal_angle * degrees_per_radian);
    }
    chart.series.push_back(std::move(ideal));
  }
  return chart;
}

Chart frame_chart(const History& history) {
  Chart chart = titled("Shear frame", "shear angle of the frame (°)", "normalised shear force (N/mm)");
  add_series(chart, "frame", history.values("frame.shear_angle_deg"),
             history.values("frame.normalised_shear_force_N_per_mm"));
  return chart;
}

Chart energy_chart(const History& history, const Progress& progress) {
  Chart chart = titled("Energy", progress.title, "energy (mJ)");
  for (const auto& [column, label] : {std::pair{"external_work_mJ", "work of grips and tools"},
                                      {"internal_energy_mJ", "internal"},
                                      {"damping_work_mJ", "damping and friction"},
                                      {"bending_friction_work_mJ", "friction in bending (part of it)"},
                                      {"kinetic_energy_mJ", "kinetic"},
                                      {"bending_energy_mJ", "bending (part of internal)"}}) {
    if (history.index(column) < 0) continue;
    const std::vector<double> values = history.values(column);
    const bool is_none = std::all_of(values.begin(), values.end(), [](double v) { return v == 0.0; });
    if (!is_none) add_series(chart, label, progress.value, values);
  }
  return chart;
}

// Share of the flat area in each bin of angles up to the greatest.
ChartSeries shares_of(const std::string& label, const Mesh& mesh, const Fields& end, double greatest) {
  double total = 0.0;
  ChartSeries shares;
  shares.label = label;
  for (double from = 0.0; from < greatest; from += bin) {
    shares.x.push_back(from + 0.5 * bin);
    shares.y.push_back(0.0);
  }
  for (std::size_t c = 0; c < end.shear_angle.size(); ++c) {
    const auto place = static_cast<std::size_t>(std::abs(end.shear_angle[c]) * degrees_per_radian / bin);
    shares.y[std::min(place, shares.y.size() - 1)] += mesh.cells.area[c];
    total += mesh.cells.area[c];
  }
  for (double& share : shares.y) share *= 100.0 / std::max(total, 1e-300);
  return shares;
}

// Bars of one ply; of several a line each.
Json distribution(const Resolved& model, const Fields& end) {
  double greatest = bin, limit = model.card.shear.valid_to_deg;
  for (const double angle : end.shear_angle) greatest = std::max(greatest, std::abs(angle) * degrees_per_radian);
  Chart chart = titled("Distribution of shear angles at the end", "shear angle (°)",
                       fmt::format("share of the area in {:g}° (%)", bin));
  if (model.ply.empty()) chart.series.push_back(shares_of("share of the fabric", model.mesh, end, greatest));
  for (std::size_t k = 0; k < model.ply.size(); ++k) {
    chart.series.push_back(
        shares_of(model.mesh.ply[k].name, model.ply[k].mesh, fields_of_ply(end, model.mesh, k), greatest));
    limit = std::min(limit, model.ply[k].card.shear.valid_to_deg);
  }
  Json json = chart_json("distribution", chart);
  if (model.ply.empty()) json["series"][0]["style"] = "bars";
  add_mark(json, limit, "the card's range ends");
  return json;
}

// Of every pair that is recorded, as far as it slides at all.
void add_slip(Json& charts, const History& history, const Progress& progress) {
  Chart slip = titled("Slip between plies", progress.title, "mean slip path where they touched (mm)");
  Chart force = titled("Force between plies", progress.title, "normal force (N)");
  for (const std::string& column : history.column) {
    const auto add = [&](const std::string& ending, Chart& chart) {
      if (column.find('/') == std::string::npos || !column.ends_with(ending)) return;
      const std::vector<double> values = history.values(column);
      if (std::any_of(values.begin(), values.end(), [](double v) { return v != 0.0; }))
        add_series(chart, column.substr(0, column.size() - ending.size()), progress.value, values);
    };
    add(".mean_slip_mm", slip);
    add(".force_N", force);
  }
  if (!slip.series.empty()) charts.push_back(chart_json("slip", slip));
  if (!force.series.empty()) charts.push_back(chart_json("ply_force", force));
}

// The blank's edge before and after, seen along the part's axis.
Chart outline_chart(const Forming& forming, const Mesh& mesh, const Fields& end) {
  Chart chart = titled("Draw-in: the edge before and after", "along the warp (mm)", "across it (mm)");
  for (const bool after : {false, true}) {
    ChartSeries edge{.label = after ? "formed" : "flat", .mark = after ? ChartMark::line : ChartMark::dashed};
    const auto& position = after ? end.position : mesh.flat_positions();
    for (std::size_t k = 0; k <= forming.outline.size() && !forming.outline.empty(); ++k) {
      const Vec3& x = position[static_cast<std::size_t>(forming.outline[k % forming.outline.size()])];
      const Eigen::Vector2d seen = forming.axis.across({x[0], x[1], x[2]});
      edge.x.push_back(seen.x());
      edge.y.push_back(seen.y());
    }
    chart.series.push_back(std::move(edge));
  }
  return chart;
}

// `ply`: its name after each title, "" of a single one.
void add_shape(Json& charts, const Forming& forming, const Mesh& mesh, const Fields& end, const std::string& ply) {
  const auto named = [&](Chart chart) {
    if (!ply.empty()) chart.title += ", ply " + ply;
    return chart;
  };
  const auto key = [&](const char* name) { return ply.empty() ? std::string(name) : fmt::format("{}_{}", name, ply); };
  charts.push_back(chart_json(key("meridians"), named(meridian_chart(forming))));
  charts.push_back(chart_json(key("outline"), named(outline_chart(forming, mesh, end)), true));
}

void add_forming(Json& charts, const Forming& forming, const Mesh& mesh, const Fields& end) {
  if (forming.punch) charts.push_back(chart_json("tool_force", punch_chart(*forming.punch)));
  add_shape(charts, forming, mesh, end, "");
  if (forming.sphere_net) charts.push_back(chart_json("sphere_net", sphere_net_chart(*forming.sphere_net)));
}

void add_forming_of_plies(Json& charts, const Resolved& model, const Evaluation& evaluation) {
  const auto& plies = evaluation.summary.ply;
  if (plies.empty() || !plies.front().forming) return;
  if (plies.front().forming->punch)
    charts.push_back(chart_json("tool_force", punch_chart(*plies.front().forming->punch)));
  for (std::size_t k = 0; k < plies.size(); ++k)
    add_shape(charts, *plies[k].forming, model.ply[k].mesh, fields_of_ply(evaluation.end, model.mesh, k),
              plies[k].name);
}

}  // namespace

Json run_charts(ResultFolder& folder, const Evaluation& evaluation) {
  const Scene& scene = folder.scene();
  const History& history = folder.history();
  const Mesh& mesh = folder.model().mesh;
  const Summary& summary = evaluation.summary;
  const Progress progress = progress_of(scene, history);
  Json charts = Json::array();
  if (!scene.grip.empty()) charts.push_back(chart_json("force", force_chart(scene, history, progress, summary)));
  if (scene.frame) charts.push_back(chart_json("frame", frame_chart(history)));
  if (!scene.measure.empty() || summary.bias)
    charts.push_back(chart_json("angle", angle_chart(scene, history, progress, summary)));
  if (summary.forming) add_forming(charts, *summary.forming, mesh, evaluation.end);
  add_forming_of_plies(charts, folder.model(), evaluation);
  if (!summary.ply.empty()) add_slip(charts, history, progress);
  charts.push_back(distribution(folder.model(), evaluation.end));
  charts.push_back(chart_json("energy", energy_chart(history, progress)));
  return charts;
}

}  // namespace weaveform
