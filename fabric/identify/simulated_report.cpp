// What is said of an identification through simulation.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/vector/angle.hpp"
#include "fabric/identify/simulated_fit.hpp"

namespace weaveform::identify {
namespace {

std::string size_of(const SimulatedTest& test) {
  if (const auto* rectangle = std::get_if<BiasRectangle>(&test.specimen))
    return fmt::format("{:.4g} x {:.4g} mm", rectangle->width, rectangle->length);
  const auto& frame = std::get<ShearFrame>(test.specimen);
  return fmt::format("{:.4g} mm in a frame of {:.4g} mm", frame.fabric_length, frame.frame_length);
}

const char* word_of(TrialMesh mesh) {
  return mesh == TrialMesh::coarse ? "coarse" : "fine";
}

double travel_of(const SimulatedFit& found, std::size_t specimen, std::size_t i) {
  const auto& window = found.test[found.test_of[specimen]].window[i];
  return 0.5 * (window[0] + window[1]);
}

}  // namespace

std::string simulation_section(const SimulatedFit& found, const std::string& unit) {
  std::string text = fmt::format(
      "\n## Simulation\n\nThe card's shear law is the one for which the simulated tests give the measured loads: {} in "
      "{} rounds and {} runs. With it, simulated loads differ from the measured ones by {:.3g} {} (root mean square), "
      "{:.2g} % of the greatest. From the coarse mesh to the fine one the law changed by {:.2g} % of its greatest "
      "stress.\n\n",
      found.converged ? "found" : "not found: the law did not come to rest", found.round.size(), found.runs,
      found.misfit, unit, 100.0 * found.misfit / found.greatest_value, 100.0 * found.mesh_change);
  if (found.decrimping)
    text += fmt::format("Factor on the crimp: {:.4g}, between {:.4g} and {:.4g}.\n\n", found.decrimping->factor,
                        found.decrimping->band[0], found.decrimping->band[1]);
  text += fmt::format("| round | mesh | misfit ({}) | the law would change by (%) |{}\n|---|---|---|---|{}\n", unit,
                      found.decrimping ? " factor on the crimp |" : "", found.decrimping ? "---|" : "");
  for (std::size_t i = 0; i < found.round.size(); ++i) {
    const SimulationRound& round = found.round[i];
    text += fmt::format("| {} | {} | {:.3g} | {:.2g} |{}\n", i + 1, word_of(round.mesh), round.misfit,
                        100.0 * round.change, found.decrimping ? fmt::format(" {:.4g} |", round.factor) : "");
  }
  text +=
      "\n| simulated | coarsening | cells | duration (s) | inertia (% of loads) | angle in the middle, at the end "
      "(deg) "
      "|\n|---|---|---|---|---|---|\n";
  for (std::size_t t = 0; t < found.test.size(); ++t) {
    const SimulatedCurve& curve = found.last[t];
    text += fmt::format("| {} | {:.4g}, {:.4g} | {} | {:.3g} | {:.2g} | {:.4g} |\n", size_of(found.test[t]),
                        curve.coarsening[0], curve.coarsening[1], curve.cells, curve.duration, 100.0 * curve.inertia,
                        curve.at.back().angle / degree);
  }
  text += fmt::format(
      "\n| specimen | travel (mm) | trellis (deg) | middle (deg) | measured ({0}) | with the closed form's law | with "
      "the law found |\n|---|---|---|---|---|---|---|\n",
      unit);
  for (std::size_t k = 0; k < found.fit.specimens.size(); ++k) {
    const ShearSpecimen& specimen = found.fit.specimens[k];
    const auto& at = found.last[found.test_of[k]].at;
    for (std::size_t i = 4; i < specimen.grid.size(); i += 5)
      text += fmt::format("| {} | {:.4g} | {:.4g} | {:.4g} | {:.4g} | {:.4g} | {:.4g} |\n", specimen.name,
                          travel_of(found, k, i), specimen.grid[i].angle / degree, at[i].angle / degree,
                          specimen.grid[i].value, found.begun[k][i], found.ended[k][i]);
  }
  return text;
}

nlohmann::ordered_json simulation_json(const SimulatedFit& found) {
  using Json = nlohmann::ordered_json;
  Json json = {{"converged", found.converged},
               {"rounds", Json::array()},
               {"runs", found.runs},
               {"misfit", found.misfit},
               {"misfit_share", found.misfit / found.greatest_value},
               {"mesh_change", found.mesh_change}};
  for (const SimulationRound& round : found.round)
    json["rounds"].push_back({{"mesh", word_of(round.mesh)}, {"misfit", round.misfit}, {"change", round.change}});
  if (found.decrimping)
    json["decrimping"] = {{"factor", found.decrimping->factor}, {"interval", found.decrimping->band}};
  json["tests"] = Json::array();
  for (std::size_t t = 0; t < found.test.size(); ++t)
    json["tests"].push_back({{"size", size_of(found.test[t])},
                             {"coarsening", found.last[t].coarsening},
                             {"cells", found.last[t].cells},
                             {"duration_s", found.last[t].duration},
                             {"inertia", found.last[t].inertia},
                             {"middle_angle_deg", found.last[t].at.back().angle / degree}});
  return json;
}

std::string simulated_law_csv(const ShearFit& fit) {
  std::string text =
      "angle_deg,log_strain,stress_MPa,tangent_MPa,stress_low_MPa,stress_high_MPa,whole_low_MPa,whole_high_MPa\n";
  for (const LawPoint& at : fit.law)
    text += fmt::format("{:.6g},{:.8g},{:.8g},{:.8g},{:.8g},{:.8g},{:.8g},{:.8g}\n", at.angle / degree, at.strain,
                        at.stress, at.tangent, at.stress - at.half_band, at.stress + at.half_band,
                        at.stress - at.half_whole, at.stress + at.half_whole);
  return text;
}

std::string simulated_load_csv(const SimulatedFit& found, const std::string& unit) {
  std::string text =
      fmt::format("specimen,travel_mm,trellis_deg,middle_deg,measured_{0},closed_form_{0},found_{0}\n", unit);
  for (std::size_t k = 0; k < found.fit.specimens.size(); ++k) {
    const ShearSpecimen& specimen = found.fit.specimens[k];
    const auto& at = found.last[found.test_of[k]].at;
    for (std::size_t i = 0; i < specimen.grid.size(); ++i)
      text += fmt::format("\"{}\",{:.8g},{:.8g},{:.8g},{:.8g},{:.8g},{:.8g}\n", specimen.name, travel_of(found, k, i),
                          specimen.grid[i].angle / degree, at[i].angle / degree, specimen.grid[i].value,
                          found.begun[k][i], found.ended[k][i]);
  }
  return text;
}

Chart simulated_load_chart(const SimulatedFit& found, const std::string& unit) {
  const bool loads = unit == "N";
  Chart chart{.title = loads ? "bias extension: measured and simulated loads" : "shear frame: measured and simulated",
              .x = {.title = "travel (mm)", .from = 0.0},
              .y = {.title = loads ? "load (N)" : "shear stress (MPa)", .from = 0.0}};
  for (std::size_t k = 0; k < found.fit.specimens.size(); ++k) {
    const ShearSpecimen& specimen = found.fit.specimens[k];
    const int colour = static_cast<int>(k);
    ChartSeries points{.label = specimen.name, .mark = ChartMark::points, .colour = colour};
    ChartSeries begun{.label = k == 0 ? "closed form's law" : "", .mark = ChartMark::dashed, .colour = colour};
    ChartSeries ended{.label = k == 0 ? "law found" : "", .mark = ChartMark::line, .colour = colour};
    for (std::size_t i = 0; i < specimen.grid.size(); ++i) {
      for (ChartSeries* series : {&points, &begun, &ended}) series->x.push_back(travel_of(found, k, i));
      points.y.push_back(specimen.grid[i].value);
      begun.y.push_back(found.begun[k][i]);
      ended.y.push_back(found.ended[k][i]);
    }
    for (ChartSeries* series : {&points, &begun, &ended}) chart.series.push_back(std::move(*series));
  }
  return chart;
}

}  // namespace weaveform::identify
