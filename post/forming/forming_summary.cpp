// The evaluation in numbers: for scripts and for people.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/vector/angle.hpp"
#include "post/forming/forming.hpp"

namespace weaveform {
namespace {

using Json = nlohmann::ordered_json;

constexpr int table_rows = 6;

Json list(const Eigen::Vector3d& a) {
  return Json::array({a.x(), a.y(), a.z()});
}

// null where there is no number
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}
Json number(std::optional<double> value) {
  return value ? number(*value) : Json();
}

std::string text(std::optional<double> value) {
  return value && std::isfinite(*value) ? fmt::format("{:.2f}", *value) : "-";
}

double azimuth_degrees(const Forming& forming, const Eigen::Vector3d& x) {
  return forming.axis.azimuth(x) * degrees_per_radian;
}

std::string punch_lines(const PunchCurve& punch) {
  std::string lines = fmt::format("{} has its largest force {:.1f} N at {:.2f} mm of travel\n", punch.punch,
                                  punch.greatest, punch.greatest_at);
  lines += fmt::format("{:>12}", "travel mm");
  for (const auto& name : punch.tool) lines += fmt::format("{:>12}", fmt::format("{:.9} N", name));
  lines += "   along each tool's direction\n";
  for (int row = 1; row <= table_rows; ++row) {
    const std::size_t k = punch.row_at(static_cast<double>(row) / table_rows);
    lines += fmt::format("{:>12.2f}", punch.travel[k]);
    for (const auto& force : punch.force) lines += fmt::format("{:>12.1f}", force[k]);
    lines += "\n";
  }
  return lines;
}

Json sphere_json(const SphereNetFit& fit) {
  return {{"tool", fit.tool},
          {"radius_mm", fit.radius},
          {"cells", fit.cells},
          {"rms_deg", number(fit.rms * degrees_per_radian)},
          {"largest_deg", number(fit.greatest * degrees_per_radian)},
          {"largest_s", fit.greatest_s},
          {"holds_to_s", fit.holds_to}};
}

std::string sphere_lines(const SphereNetFit& fit) {
  if (fit.cells == 0) return fmt::format("net     no cell lies on {}\n", fit.tool);
  return fmt::format(
      "net     on {} (R {:g} mm, {} cells, |uv/R2| to {:.2f}) the angle is off the inextensible net by {:.2f} deg rms, "
      "{:.2f} at most;\n        within {:g} deg to |uv/R2| = {:.2f}\n",
      fit.tool, fit.radius, fit.cells, fit.greatest_s, fit.rms * degrees_per_radian, fit.greatest * degrees_per_radian,
      holds_within, fit.holds_to);
}

bool is_of_the_mesh(const Forming& forming) {
  return forming.waves.are() == WavesOf::mesh || (forming.wrinkles.area_share > 0.0 && !forming.waves.bends);
}

}  // namespace

Json forming_loads_json(const Forming& forming) {
  Json json;
  json["axis"] = {{"tool", forming.axis.tool.empty() ? Json() : Json(forming.axis.tool)},
                  {"through_mm", list(forming.axis.origin)},
                  {"direction", list(forming.axis.up)}};
  json["punch"] = Json();
  if (forming.punch)
    json["punch"] = {{"tool", forming.punch->punch},
                     {"largest_force_N", forming.punch->greatest},
                     {"at_travel_mm", forming.punch->greatest_at}};
  json["force_balance"] = Json();
  if (forming.balance)
    json["force_balance"] = {{"largest_relative_difference", forming.balance->greatest},
                             {"at_time_s", forming.balance->at_time}};
  return json;
}

Json forming_json(const Forming& forming) {
  const Eigen::Vector3d& at = forming.greatest_angle_at;
  const DrawIn& draw = forming.draw_in;
  const double quarter = std::numbers::pi / 4.0, thickness = forming.flat_thickness;
  Json json = forming_loads_json(forming);
  json["shear_angle"] = {{"largest_deg", forming.greatest_angle * degrees_per_radian},
                         {"at_mm", list(at)},
                         {"azimuth_deg", azimuth_degrees(forming, at)},
                         {"radius_mm", forming.axis.radius(at)},
                         {"height_mm", forming.axis.height(at)}};
  json["draw_in_mm"] = {{"largest", draw.greatest},
                        {"largest_at_deg", draw.greatest_at * degrees_per_radian},
                        {"least", draw.least},
                        {"mean", draw.mean},
                        {"at_0_deg", number(draw.at(0.0))},
                        {"at_45_deg", number(draw.at(quarter))},
                        {"at_90_deg", number(draw.at(2.0 * quarter))}};
  json["wrinkles"] = {{"area_share", forming.wrinkles.area_share},
                      {"relief_mm", forming.wrinkles.greatest_relief},
                      {"curvature_per_mm", forming.wrinkles.greatest_curvature},
                      {"of_the_mesh", is_of_the_mesh(forming)},
                      {"relief_limit_mm", forming.wrinkle_limits.relief(thickness)},
                      {"curvature_limit_per_mm", forming.wrinkle_limits.curvature(thickness)}};
  json["thickness_mm"] = {{"flat", thickness}, {"least", forming.thinnest}, {"largest", forming.thickest}};
  json["sphere_net"] = forming.sphere_net ? sphere_json(*forming.sphere_net) : Json();
  return json;
}

std::string forming_loads_table(const Forming& forming) {
  std::string lines = fmt::format(
      "\nforming, about {}\n", forming.axis.tool.empty() ? "the blank's centre" : "the axis of " + forming.axis.tool);
  if (forming.punch) lines += punch_lines(*forming.punch);
  if (forming.balance)
    lines += fmt::format("balance the tools' forces add up to zero within {:.3g} % at all times (worst at {:.4g} s)\n",
                         100.0 * forming.balance->greatest, forming.balance->at_time);
  return lines;
}

std::string forming_table(const Forming& forming) {
  const Eigen::Vector3d& at = forming.greatest_angle_at;
  const DrawIn& draw = forming.draw_in;
  const double quarter = std::numbers::pi / 4.0, thickness = forming.flat_thickness;
  std::string lines = forming_loads_table(forming);
  lines +=
      fmt::format("shear   largest {:.2f} deg, {:.1f} deg from the warp, {:.1f} mm from the axis, height {:.1f} mm\n",
                  forming.greatest_angle * degrees_per_radian, azimuth_degrees(forming, at), forming.axis.radius(at),
                  forming.axis.height(at));
  lines += fmt::format("draw-in largest {:.2f} mm at {:.0f} deg, mean {:.2f}; at 0, 45, 90 deg {}, {}, {} mm\n",
                       draw.greatest, draw.greatest_at * degrees_per_radian, draw.mean, text(draw.at(0.0)),
                       text(draw.at(quarter)), text(draw.at(2.0 * quarter)));
  lines += fmt::format(
      "wrinkle {:.3g} % of the area (relief above {:.3g} mm, curvature above {:.3g} /mm); relief {:.3g} mm, curvature "
      "{:.3g} /mm at most\n",
      100.0 * forming.wrinkles.area_share, forming.wrinkle_limits.relief(thickness),
      forming.wrinkle_limits.curvature(thickness), forming.wrinkles.greatest_relief,
      forming.wrinkles.greatest_curvature);
  lines += fmt::format("thick   {:.4f} to {:.4f} mm, flat {:.4f}\n", forming.thinnest, forming.thickest, thickness);
  if (forming.sphere_net) lines += sphere_lines(*forming.sphere_net);
  return lines;
}

}  // namespace weaveform
