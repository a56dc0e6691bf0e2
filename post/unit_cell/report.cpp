#include "post/unit_cell/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/vector/angle.hpp"

namespace weaveform {

namespace {

constexpr std::array<double, 4> table_angles = {15.0, 30.0, 45.0, 60.0};  // deg

// The angles shown: about one a degree counted from 0, and both ends.
std::vector<std::size_t> shown_rows(const UnitCellStudy& study) {
  const int increments = study.options.increments;
  const int step = std::max(1, static_cast<int>(std::lround(increments / (study.options.to / degree))));
  std::vector<std::size_t> rows;
  for (int n = -increments; n <= increments; ++n)
    if (n % step == 0 || std::abs(n) == increments) rows.push_back(static_cast<std::size_t>(n + increments));
  return rows;
}

// Half a millionth of a degree: an angle asked for is not lost to rounding.
bool is_within(const UnitCellStudy& study, double angle_deg) {
  return angle_deg * degree <= study.options.to + 1e-8;
}

std::string error_cell(const UnitCellStudy& study, const UnitCellCurve& curve, double angle_deg) {
  if (!is_within(study, angle_deg)) return fmt::format("{:>9}", "-");
  const double percent = 100.0 * error_at(study, curve, angle_deg * degree);
  // No sign on what the two decimals round to nothing.
  return fmt::format("{:>9}", std::abs(percent) < 0.005 ? "0.00 %" : fmt::format("{:+.2f} %", percent));
}

std::string held_cell(const UnitCellStudy& study, const UnitCellCurve& curve) {
  const bool whole = curve.holds_to >= study.options.to;
  return fmt::format("{:>9}", fmt::format("{}{:.1f}", whole ? ">= " : "", curve.holds_to / degree));
}

// Greatest difference between the two senses, relative to the analytical force.
double asymmetry(const UnitCellStudy& study) {
  double greatest = 0.0;
  const std::size_t last = study.angle.size() - 1;
  for (const auto& curve : study.curve)
    for (std::size_t n = 0; n < last / 2; ++n)
      greatest = std::max(greatest, std::abs((curve.force[n] + curve.force[last - n]) / study.analytical[n]));
  return greatest;
}

std::string convergence_table(const UnitCellConvergence& study) {
  std::string text = fmt::format(
      "\n### {}, {:.4g} deg\n\nclosed form {:.9f}, extrapolated {:.9f}\n\n"
      "| increments | returned/analytical | distance from closed form | order |\n|---:|---:|---:|---:|\n",
      study.variant.name(), study.angle / degree, study.closed_form, study.extrapolated);
  for (const auto& row : study.row)
    text += fmt::format("| {} | {:.9f} | {:.2e} | {} |\n", row.increments, row.ratio, row.distance,
                        std::isnan(row.order) ? "-" : fmt::format("{:.2f}", row.order));
  return text;
}

std::string rotation_table(const std::vector<RotationCost>& costs) {
  std::string text = "| increments |", rule = "|---:|";
  for (const auto& cost : costs) {
    text += fmt::format(" {} |", cost.variant.name());
    rule += "---:|";
  }
  text += "\n" + rule + "\n";
  for (std::size_t n = 0; n < costs.front().row.size(); ++n) {
    text += fmt::format("| {} |", costs.front().row[n].increments);
    for (const auto& cost : costs)
      text += fmt::format(" {:.6f} ({:+.1e}) |", cost.row[n].rotated, cost.row[n].rotated - cost.row[n].still);
    text += "\n";
  }
  return text;
}

std::string sides_of(const CellShape& shape) {
  return fmt::format("{}: {:g} mm along the warp, {:g} mm along the weft", shape.name, shape.sides[0], shape.sides[1]);
}

// The values at the rows shown, times a factor.
std::vector<double> picked(const std::vector<double>& values, const std::vector<std::size_t>& rows, double factor) {
  std::vector<double> result;
  for (const std::size_t n : rows) result.push_back(factor * values[n]);
  return result;
}

ChartAxis angle_axis(double from, double to) {
  return {"shear angle (deg)", AxisScale::linear, from / degree, to / degree};
}

// A curve of the square cell as the charts draw it: a colour for each kind, dashes for constant thickness.
struct ChartLine {
  const UnitCellCurve* curve;
  std::string kind, label;
  ChartMark mark;
  int colour;
};

// Curves that lie on each other to this share of the force are drawn once.
constexpr double invisible = 1e-9;

bool same_curve(const UnitCellStudy& study, const UnitCellCurve& a, const UnitCellCurve& b) {
  for (std::size_t n = 0; n < study.angle.size(); ++n)
    if (std::abs(a.error[n] - b.error[n]) > invisible) return false;
  return a.variant.thickness == b.variant.thickness;
}

std::vector<ChartLine> chart_lines(const UnitCellStudy& study) {
  std::vector<ChartLine> lines;
  std::vector<std::string> kinds;  // drawn so far, in the order of their colours
  for (const auto& curve : study.curve) {
    const auto& v = curve.variant;
    if (v.shape.name != "square") continue;
    const std::string kind = (study.options.cells.size() > 1 ? name_of(v.cell) + " " : "") + name_of(v.formulation);
    const auto twin = std::find_if(lines.begin(), lines.end(),
                                   [&](const ChartLine& line) { return same_curve(study, *line.curve, curve); });
    if (twin != lines.end()) {
      twin->kind += " and " + kind;
      continue;
    }
    const auto found = std::find(kinds.begin(), kinds.end(), kind);
    const int colour = static_cast<int>(found - kinds.begin());
    if (found == kinds.end()) kinds.push_back(kind);
    lines.push_back(
        {&curve, kind, "", v.thickness == Thickness::constant ? ChartMark::dashed : ChartMark::line, colour});
  }
  for (auto& line : lines)
    line.label = line.kind + (line.mark == ChartMark::dashed ? ", constant thickness" : ", constant volume");
  return lines;
}

}  // namespace

std::string unit_cell_csv(const UnitCellStudy& study) {
  std::string text = "shear_angle_deg,analytical_N_per_mm";
  for (const auto& curve : study.curve)
    text += fmt::format(",{0}.force_N_per_mm,{0}.relative_error", curve.variant.name());
  text += "\n";
  for (const std::size_t n : shown_rows(study)) {
    text += fmt::format("{:.10g},{:.12g}", study.angle[n] / degree, study.analytical[n]);
    for (const auto& curve : study.curve) {
      text += fmt::format(",{:.12g},", curve.force[n]);
      if (study.analytical[n] != 0.0) text += fmt::format("{:.6g}", curve.error[n]);
    }
    text += "\n";
  }
  return text;
}

std::string unit_cell_table(const UnitCellStudy& study) {
  std::size_t width = 7;
  for (const auto& curve : study.curve) width = std::max(width, curve.variant.name().size());
  std::string text = fmt::format("| {:<{}} | 5 % to  ", "variant", width);
  for (const double angle : table_angles) text += fmt::format(" | {:>9}", fmt::format("{:g} deg", angle));
  text += fmt::format(" | off limit |\n|{:-<{}}|----------:", "", width + 2);
  for (std::size_t n = 0; n <= table_angles.size(); ++n) text += "|----------:";
  text += "|\n";
  for (const auto& curve : study.curve) {
    text += fmt::format("| {:<{}} | {}", curve.variant.name(), width, held_cell(study, curve));
    for (const double angle : table_angles) text += " | " + error_cell(study, curve, angle);
    text += fmt::format(" | {:>9.1e} |\n", curve.closed_form_distance);
  }
  return text;
}

std::string unit_cell_markdown(const UnitCellStudy& study, const std::string& made_by) {
  const auto shapes = cell_shapes(study.card);
  std::string text = fmt::format(
      "# Unit cell of {}\n\nWritten by {}.\n\n- {}\n- {}\n- sheared to {:g} deg in either sense in {} increments; the "
      "card's shear law is meant to hold to {:g} deg\n\n## Errors of the normalised shear force\n\n"
      "Each variant is named SHAPE.CELL.FORMULATION.THICKNESS. \"5 % to\": shear angle in degrees up to which the "
      "error "
      "stays within 5 % in both senses. The errors are those of positive angles; the two senses differ by {:.1e} of "
      "the "
      "analytical force at most. \"off limit\": greatest distance, over all angles, of returned/analytical from the "
      "variant's own closed form (docs/unit_cell.md).\n\n",
      study.card.name, made_by, sides_of(shapes[0]), sides_of(shapes[1]), study.options.to / degree,
      study.options.increments, study.card.shear.valid_to_deg, asymmetry(study));
  text += unit_cell_table(study);
  if (study.convergence.empty()) return text;
  text += "\n## Convergence with the increments\n";
  for (const auto& convergence : study.convergence) text += convergence_table(convergence);
  text += fmt::format(
      "\n## A rigid rotation by 90 deg during the shear\n\nReturned/analytical at {:.4g} deg of shear, in brackets "
      "what "
      "the rotation changed.\n\n",
      study.rotation.front().angle / degree);
  return text + rotation_table(study.rotation);
}

nlohmann::ordered_json unit_cell_json(const UnitCellStudy& study) {
  using Json = nlohmann::ordered_json;
  Json json = {{"card", study.card.name},
               {"to_deg", study.options.to / degree},
               {"increments", study.options.increments},
               {"tolerance", unit_cell_tolerance},
               {"variants", Json::array()}};
  for (const auto& curve : study.curve) {
    Json errors = Json::object();
    for (const double angle : table_angles)
      errors[fmt::format("{:g}", angle)] =
          is_within(study, angle) ? Json(error_at(study, curve, angle * degree)) : Json(nullptr);
    json["variants"].push_back({{"name", curve.variant.name()},
                                {"shape", curve.variant.shape.name},
                                {"cell", name_of(curve.variant.cell)},
                                {"formulation", name_of(curve.variant.formulation)},
                                {"thickness", name_of(curve.variant.thickness)},
                                {"holds_to_deg", curve.holds_to / degree},
                                {"holds_to_the_end", curve.holds_to >= study.options.to},
                                {"relative_error_at_deg", errors},
                                {"closed_form_distance", curve.closed_form_distance}});
  }
  return json;
}

Chart unit_cell_chart(const UnitCellStudy& study) {
  constexpr int black = 6;
  const auto rows = shown_rows(study);
  const auto angle = picked(study.angle, rows, 1.0 / degree);
  Chart chart;
  chart.title = "Unit cell of " + study.card.name;
  chart.x = angle_axis(-study.options.to, study.options.to);
  chart.y.title = "normalised shear force (N/mm)";
  chart.height = 620;
  // A variant that leaves every bound must not flatten the others.
  const double bound = 1.6 * std::abs(study.analytical.back());
  chart.y.from = -bound;
  chart.y.to = bound;
  for (const auto& line : chart_lines(study))
    chart.series.push_back({line.label, angle, picked(line.curve->force, rows, 1.0), line.mark, line.colour});
  chart.series.push_back({"analytical", angle, picked(study.analytical, rows, 1.0), ChartMark::points, black});
  return chart;
}

Chart unit_cell_error_chart(const UnitCellStudy& study) {
  auto rows = shown_rows(study);
  std::erase_if(rows, [&](std::size_t n) { return study.angle[n] < 0.0; });
  const auto angle = picked(study.angle, rows, 1.0 / degree);
  Chart chart;
  chart.title = "Unit cell of " + study.card.name + ": error of the normalised shear force";
  chart.x = angle_axis(0.0, study.options.to);
  chart.y.title = "returned / analytical - 1 (%)";
  chart.y.from = -60.0;  // the side frame passes through -100 %, no force at all, and beyond
  chart.y.to = 60.0;
  const double tolerance = 100.0 * unit_cell_tolerance;
  chart.bands.push_back({fmt::format("within {:g} %", tolerance), angle, std::vector<double>(rows.size(), -tolerance),
                         std::vector<double>(rows.size(), tolerance), 6});
  for (const auto& line : chart_lines(study))
    chart.series.push_back({line.label, angle, picked(line.curve->error, rows, 100.0), line.mark, line.colour});
  return chart;
}

}  // namespace weaveform
