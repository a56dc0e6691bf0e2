#include "post/forming/forming_charts.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/vector/angle.hpp"
#include "mesher/drape/sphere_net.hpp"

namespace weaveform {

Chart punch_chart(const PunchCurve& punch) {
  Chart chart{.title = "Force of the tools"};
  chart.x.title = fmt::format("travel of {} (mm)", punch.punch);
  chart.y.title = "force along each tool's direction (N)";
  for (std::size_t t = 0; t < punch.tool.size(); ++t)
    chart.series.push_back({.label = punch.tool[t],
                            .x = punch.travel,
                            .y = punch.force[t],
                            .mark = static_cast<int>(t) == punch.punch_number ? ChartMark::line : ChartMark::dashed});
  return chart;
}

Chart meridian_chart(const Forming& forming) {
  Chart chart{.title = "Shear angle along meridians"};
  chart.x.title = "arc along the fabric from the axis (mm)";
  chart.y.title = "shear angle (deg)";
  for (std::size_t k = 0; k < meridian_azimuths.size(); ++k) {
    ChartSeries series{.label = fmt::format("{:g}° from the warp", meridian_azimuths[k])};
    for (const MeridianPoint& p : forming.meridian[k]) {
      series.x.push_back(p.arc);
      series.y.push_back(p.angle * degrees_per_radian);
    }
    chart.series.push_back(series);
  }
  return chart;
}

Chart sphere_net_chart(const SphereNetFit& fit) {
  ChartSeries on{.label = "on the sphere", .mark = ChartMark::points};
  ChartSeries off{.label = "elsewhere", .mark = ChartMark::points};
  ChartSeries net{.label = "inextensible net g(s)"};
  const double fold = sphere_net_end();
  for (const SphereNetCell& cell : fit.cell) {
    if (std::abs(cell.s) > fold) continue;
    ChartSeries& series = cell.on_sphere ? on : off;
    series.x.push_back(cell.s);
    series.y.push_back(cell.angle * degrees_per_radian);
  }
  for (int k = -100; k <= 100; ++k) {
    net.x.push_back(fold * k / 100.0);
    net.y.push_back(sphere_net_angle(net.x.back()) * degrees_per_radian);
  }
  Chart chart{.title = fmt::format("Shear angle over {}, R = {:g} mm", fit.tool, fit.radius)};
  chart.x.title = "s = u v / R²";
  chart.y.title = "shear angle (deg)";
  chart.series = {off, on, net};
  return chart;
}

}  // namespace weaveform
