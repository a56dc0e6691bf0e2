#include "post/output/summary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/json/json_text.hpp"
#include "core/vector/angle.hpp"
#include "solver/result/statistics.hpp"

namespace weaveform {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array zone_name = {"A", "B", "C"};
constexpr std::array component = {".force_x_N", ".force_y_N", ".force_z_N"};

double last_value(const History& history, const std::string& column) {
  const std::vector<double> values = history.values(column);
  if (values.empty()) throw InputError("history has no row; solve again");
  return values.back();
}

GripSummary summarise_motion(const std::string& name, const History& history) {
  const std::vector<double> force = history.values(name + ".force_N");
  const double displacement = last_value(history, name + ".displacement_mm");
  const auto largest =
      std::max_element(force.begin(), force.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  return {name, displacement, force.back(), *largest};
}

Json motion_json(const GripSummary& motion) {
  return {
      {"displacement_mm", motion.displacement}, {"force_N", motion.force}, {"largest_force_N", motion.largest_force}};
}

Json zones_json(const BiasZoneAngles& angles) {
  Json zones = Json::object();
  for (std::size_t z = 0; z < zone_name.size(); ++z)
    zones[zone_name[z]] = {{"cells", angles.simulated[z].cells},
                           {"area_mm2", angles.simulated[z].area},
                           {"shear_angle_deg", angles.simulated[z].mean * degrees_per_radian},
                           {"sd", angles.simulated[z].sd * degrees_per_radian},
                           {"ideal_deg", angles.ideal[z] * degrees_per_radian}};
  return zones;
}

Json travel_json(const BiasComparison& bias, const std::vector<MeasureSummary>& measure) {
  Json rows = Json::array();
  for (const BiasRow& row : bias.row) {
    Json measures = Json::object();
    for (std::size_t m = 0; m < measure.size(); ++m)
      measures[measure[m].name] = row.measured_angle[m] * degrees_per_radian;
    rows.push_back({{"travel_mm", row.travel},
                    {"shear_angle_deg", measures},
                    {"ideal_deg", row.ideal_angle * degrees_per_radian},
                    {"force_N", {{bias.specimen.grip[0], row.load[0]}, {bias.specimen.grip[1], row.load[1]}}},
                    {"ideal_force_N", row.ideal_load}});
  }
  return rows;
}

// Zones of plies stand with each ply.
void add_bias(Json& json, const BiasComparison& bias, const std::vector<MeasureSummary>& measure,
              std::size_t of_plies) {
  const ZoneAreas area = zone_areas(bias.specimen);
  json["bias_extension"] = {{"width_mm", bias.specimen.width},
                            {"length_mm", bias.specimen.length},
                            {"axis", bias.specimen.axis == 0 ? "x" : "y"},
                            {"zone_area_mm2", {{"A", area.a}, {"B", area.b}, {"C", area.c}}}};
  if (of_plies == 0) json["zones"] = zones_json(bias.zones.front());
  if (bias.row.empty()) return;
  const BiasRow& end = bias.row.back();
  json["ideal"] = {{"travel_mm", end.travel},
                   {"shear_angle_deg", end.ideal_angle * degrees_per_radian},
                   {"force_N", end.ideal_load}};
  json["travel"] = travel_json(bias, measure);
}

Json frame_json(const FrameComparison& frame) {
  return {{"shear_angle_deg", frame.angle * degrees_per_radian},
          {"force_N", frame.load},
          {"ideal_force_N", frame.ideal_load},
          {"worst_force_error", frame.worst_error}};
}

Json folds_json(const Folds& folds) {
  return {{"out_of_plane_mm", folds.out_of_plane},
          {"zigzag_height_mm", folds.zigzag_height},
          {"zigzag_share", folds.zigzag_share}};
}

Json taken_json(const std::vector<TakenSummary>& taken) {
  Json list = Json::array();
  for (const TakenSummary& one : taken) {
    Json entry = {{"key", one.taken.key}, {"value", one.taken.value}, {"why", one.taken.why}};
    if (!one.taken.missed.empty()) entry["missed"] = one.taken.missed;
    if (!one.assumed.empty()) {
      entry["assumed"] = one.assumed;
      entry["held"] = one.held;
    }
    list.push_back(std::move(entry));
  }
  return list;
}

Json ply_json(const PlySummary& ply) {
  Json json = {{"material", ply.material},
               {"cells", ply.cells},
               {"max_shear_angle_deg", ply.max_shear_angle},
               {"max_shear_angle_at_mm", ply.at},
               {"max_yarn_strain", ply.max_yarn_strain},
               {"folded_cells_at_end", ply.folded},
               {"cells_beyond_card", ply.beyond_card}};
  if (ply.forming) {
    json["forming"] = forming_json(*ply.forming);
    for (const char* of_all : {"axis", "punch", "force_balance"}) json["forming"].erase(of_all);
  }
  if (ply.folds) json["folds"] = folds_json(*ply.folds);
  json["wrinkles"] = waves_json(ply.waves);
  return json;
}

void add_plies(const Summary& summary, Json& json) {
  if (summary.ply.front().forming) json["forming"] = forming_loads_json(*summary.ply.front().forming);
  for (std::size_t k = 0; k < summary.ply.size(); ++k) {
    Json& ply = json["plies"][summary.ply[k].name] = ply_json(summary.ply[k]);
    if (summary.bias) ply["zones"] = zones_json(summary.bias->zones[k]);
  }
  json["pairs"] = Json::object();
  for (const PairStatistics& pair : summary.statistics.pairs) {
    Json& entry = json["pairs"][pair.lower + "/" + pair.upper];
    for_each_pair_statistic(pair, [&](const char* name, const auto& value) { entry[name] = value; });
    entry["mean_pressure_MPa"] = pair.contact_area_mm2 > 0.0 ? pair.force_N / pair.contact_area_mm2 : 0.0;
  }
}

}  // namespace

std::vector<GripSummary> summarise_grips(const Scene& scene, const History& history) {
  std::vector<GripSummary> summary;
  for (const GripSpec& grip : scene.grip) summary.push_back(summarise_motion(grip.name, history));
  return summary;
}

std::vector<ToolSummary> summarise_tools(const Scene& scene, const History& history) {
  std::vector<ToolSummary> summary;
  for (const ToolSpec& tool : scene.tools) {
    ToolSummary one{summarise_motion(tool.name, history), tool.travel == 0.0 && !tool.force,
                    last_value(history, tool.name + ".contact_area_mm2")};
    if (history.index(tool.name + ".force_x_N") >= 0) {
      one.whole_force.emplace();
      for (std::size_t c = 0; c < 3; ++c) (*one.whole_force)[c] = last_value(history, tool.name + component[c]);
    }
    summary.push_back(one);
  }
  return summary;
}

std::vector<MeasureSummary> summarise_measures(const Scene& scene, const History& history) {
  std::vector<MeasureSummary> summary;
  for (const MeasureSpec& measure : scene.measure) {
    const std::string angle = measure.name + ".shear_angle_";
    summary.push_back({measure.name, last_value(history, angle + "deg"), last_value(history, angle + "sd_deg"),
                       last_value(history, angle + "min_deg"), last_value(history, angle + "max_deg")});
  }
  return summary;
}

Json summary_json(const Summary& summary) {
  Json json;
  for_each_statistic(summary.statistics, [&](const char* name, const auto& value) { json[name] = value; });
  json["measures"] = Json::object();
  for (const MeasureSummary& m : summary.measure)
    json["measures"][m.name] = {{"shear_angle_deg", m.mean}, {"sd", m.sd}, {"min", m.least}, {"max", m.greatest}};
  json["grips"] = Json::object();
  for (const GripSummary& g : summary.grip) json["grips"][g.name] = motion_json(g);
  json["tools"] = Json::object();
  for (const ToolSummary& tool : summary.tool) {
    Json entry = motion_json(tool.motion);
    entry["contact_area_mm2"] = tool.contact_area;
    if (tool.whole_force)
      for (std::size_t c = 0; c < 3; ++c) entry[component[c] + 1] = (*tool.whole_force)[c];
    json["tools"][tool.motion.name] = entry;
  }
  if (summary.bias) add_bias(json, *summary.bias, summary.measure, summary.ply.size());
  if (summary.frame) json["frame"] = frame_json(*summary.frame);
  if (summary.forming) json["forming"] = forming_json(*summary.forming);
  if (summary.folds) json["folds"] = folds_json(*summary.folds);
  if (summary.ply.empty())
    json["wrinkles"] = waves_json(summary.waves);
  else
    add_plies(summary, json);
  if (!summary.taken.empty()) json["taken"] = taken_json(summary.taken);
  json["warnings"] = summary.warning;
  return json;
}

void write_summary(const Summary& summary, const std::filesystem::path& file) {
  write_text_whole(file, json_text(summary_json(summary)));
}

}  // namespace weaveform
