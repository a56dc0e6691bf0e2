#include "fabric/identify/fit_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/vector/angle.hpp"
#include "fabric/identify/decrimping.hpp"

namespace weaveform::identify {
namespace {

std::vector<double> in_degrees(std::vector<double> angles) {
  for (double& angle : angles) angle /= degree;
  return angles;
}

std::string specimen_label(std::size_t index) {
  return fmt::format("specimen_{}", index + 1);
}

// A heading names the specimens by number; the comment above says which file each is.
template <class Specimens>
std::string specimen_comment(const Specimens& specimens) {
  std::string text;
  for (std::size_t k = 0; k < specimens.size(); ++k)
    text += fmt::format("# {}: {}\n", specimen_label(k), specimens[k].name);
  return text;
}

// The axis follows the curves; the band of two specimens would dwarf them, and is cut off instead.
void show_data(Chart& chart) {
  double least = 0.0, greatest = 0.0;
  for (const auto& series : chart.series) {
    for (const double value : series.y) {
      least = std::min(least, value);
      greatest = std::max(greatest, value);
    }
  }
  constexpr double room = 0.08;
  chart.y.from = least < 0.0 ? least - room * (greatest - least) : 0.0;
  chart.y.to = greatest + room * (greatest - least);
}

}  // namespace

std::string yarn_csv(const YarnFit& fit, double crimp) {
  const TangentLaw law(decrimping_law(fit.modulus, crimp));
  const double straight = std::log1p(crimp);
  std::string text =
      specimen_comment(fit.specimens) +
      "# strain_in_fabric = measured strain - slack toe + ln(1 + crimp): where the yarn has that stress in "
      "the fabric; the elastic part alone lies on the law\n"
      "specimen,strain,stress_MPa,elastic,strain_in_fabric,law_MPa,law_low_MPa,law_high_MPa\n";
  for (std::size_t k = 0; k < fit.specimens.size(); ++k) {
    const YarnSpecimen& yarn = fit.specimens[k];
    for (std::size_t i = 0; i < yarn.strain.size(); ++i) {
      const bool elastic = yarn.strain[i] >= yarn.elastic[0] && yarn.strain[i] <= yarn.elastic[1];
      const double in_fabric = yarn.strain[i] - yarn.toe + straight;
      const double stress = in_fabric > 0.0 ? law.stress(in_fabric) : 0.0;
      text += fmt::format("{},{:.8g},{:.8g},{},{:.8g},{:.8g},{:.8g},{:.8g}\n", specimen_label(k), yarn.strain[i],
                          yarn.stress[i], elastic ? 1 : 0, in_fabric, stress, stress * fit.band[0] / fit.modulus,
                          stress * fit.band[1] / fit.modulus);
    }
  }
  return text;
}

Chart yarn_chart(const YarnFit& fit, double crimp, double confidence) {
  const double straight = std::log1p(crimp);
  Chart chart{.title = fmt::format("{}: tension of the yarn in the fabric", fit.test),
              .x = {.title = "true strain (1)"},
              .y = {.title = "stress (MPa)"}};
  double reach = 0.0;
  for (const auto& yarn : fit.specimens) {
    ChartSeries points{.label = "", .mark = ChartMark::points, .colour = 6};
    if (chart.series.empty()) points.label = "tests, elastic part, slack out, crimp in";
    for (std::size_t i = 0; i < yarn.strain.size(); ++i) {
      if (yarn.strain[i] < yarn.elastic[0] || yarn.strain[i] > yarn.elastic[1]) continue;
      points.x.push_back(yarn.strain[i] - yarn.toe + straight);
      points.y.push_back(yarn.stress[i]);
      reach = std::max(reach, points.x.back());
    }
    chart.series.push_back(std::move(points));
  }
  const TangentLaw law(decrimping_law(fit.modulus, crimp));
  ChartBand band{.label = fmt::format("{:.4g} % band", 100.0 * confidence), .colour = 0};
  ChartSeries line{.label = "law", .mark = ChartMark::line, .colour = 0};
  constexpr int steps = 200;
  for (int i = 0; i <= steps; ++i) {
    const double strain = reach * i / steps, stress = law.stress(strain);
    line.x.push_back(strain);
    line.y.push_back(stress);
    band.low.push_back(stress * fit.band[0] / fit.modulus);
    band.high.push_back(stress * fit.band[1] / fit.modulus);
  }
  band.x = line.x;
  chart.bands.push_back(std::move(band));
  chart.series.push_back(std::move(line));
  return chart;
}

std::string shear_csv(const ShearFit& fit, bool load) {
  const std::string unit = load ? "N" : "MPa";
  std::string text = specimen_comment(fit.specimens);
  text += "angle_deg,log_strain,stress_MPa,tangent_MPa,stress_low_MPa,stress_high_MPa,whole_low_MPa,whole_high_MPa,";
  text += fmt::format("mean_{0},deviation_{0},fitted_{0}", unit);
  for (std::size_t k = 0; k < fit.specimens.size(); ++k) text += fmt::format(",{}_{}", specimen_label(k), unit);
  text += "\n";
  for (std::size_t i = 0; i < fit.law.size(); ++i) {
    const LawPoint& at = fit.law[i];
    text +=
        fmt::format("{:.6g},{:.8g},{:.8g},{:.8g},{:.8g},{:.8g},{:.8g},{:.8g},{:.8g},{:.8g},{:.8g}", at.angle / degree,
                    at.strain, at.stress, at.tangent, at.stress - at.half_band, at.stress + at.half_band,
                    at.stress - at.half_whole, at.stress + at.half_whole, at.mean, at.deviation, at.predicted);
    for (const auto& specimen : fit.specimens) text += fmt::format(",{:.8g}", specimen.grid[i].value);
    text += "\n";
  }
  return text;
}

Chart shear_chart(const ShearFit& fit, const std::string& title, double confidence) {
  Chart chart{.title = title, .x = {.title = "shear angle (deg)", .from = 0.0}, .y = {.title = "shear stress (MPa)"}};
  ChartBand band{.label = fmt::format("{:.4g} % band", 100.0 * confidence), .colour = 0};
  ChartSeries line{.label = fit.start_chosen ? "law: start and polynomial" : "law: polynomial",
                   .x = {0.0},
                   .y = {0.0},
                   .mark = ChartMark::line,
                   .colour = 0};
  ChartSeries other{.label = fit.start_chosen ? "polynomial alone" : "with friction-like start",
                    .x = {0.0},
                    .y = {0.0},
                    .mark = ChartMark::dashed,
                    .colour = 1};
  for (const auto& at : fit.law) {
    line.x.push_back(at.angle / degree);
    line.y.push_back(at.stress);
    band.x.push_back(at.angle / degree);
    band.low.push_back(at.stress - at.half_band);
    band.high.push_back(at.stress + at.half_band);
    if (!fit.with_start) continue;
    const FormFit& left = fit.start_chosen ? fit.polynomial : *fit.with_start;
    other.x.push_back(at.angle / degree);
    other.y.push_back(stress_of(left.pooled.curve, at.strain));
  }
  chart.bands.push_back(std::move(band));
  // Stresses are measured in a frame only; a bias extension measures loads (load_chart).
  bool labelled = false;
  for (const auto& specimen : fit.specimens) {
    if (specimen.grid.front().half != 0.0 || !specimen.grid.front().counted.empty()) continue;
    chart.series.push_back({.label = labelled ? "" : "tests",
                            .x = in_degrees(specimen.angle),
                            .y = specimen.value,
                            .mark = ChartMark::points,
                            .colour = 6});
    labelled = true;
  }
  if (fit.with_start) chart.series.push_back(std::move(other));
  chart.series.push_back(std::move(line));
  show_data(chart);
  return chart;
}

Chart load_chart(const ShearFit& fit) {
  Chart chart{.title = "bias extension: loads and their fit",
              .x = {.title = "kinematic shear angle (deg)", .from = 0.0},
              .y = {.title = "load (N)"}};
  for (std::size_t k = 0; k < fit.specimens.size(); ++k) {
    const ShearSpecimen& specimen = fit.specimens[k];
    const int colour = static_cast<int>(k);
    chart.series.push_back({.label = specimen.name,
                            .x = in_degrees(specimen.angle),
                            .y = specimen.value,
                            .mark = ChartMark::points,
                            .colour = colour});
    ChartSeries line{.label = k == 0 ? "law" : "", .mark = ChartMark::line, .colour = colour};
    for (const auto& seen : specimen.grid) {
      line.x.push_back(seen.angle / degree);
      line.y.push_back(predicted(fit.chosen().pooled.curve, seen));
    }
    chart.series.push_back(std::move(line));
  }
  return chart;
}

}  // namespace weaveform::identify
