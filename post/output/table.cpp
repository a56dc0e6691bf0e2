// The table printed at the end of a run.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "core/vector/angle.hpp"
#include "post/output/percent.hpp"
#include "post/output/summary.hpp"

namespace weaveform {

namespace {

constexpr std::array zone_title = {"A  centre", "B  half shear", "C  at grips"};

constexpr int travel_column = 12;  // characters; of the table over the travel, whose headings are names

// A number at the right of a column; "-" where there is none (a zone without cells, an ideal past 90 deg).
std::string aligned(double value, int decimals = 2, int width = 10) {
  return std::isfinite(value) ? fmt::format("{:{}.{}f}", value, width, decimals) : fmt::format("{:>{}}", "-", width);
}

// Names stand in a column as wide as the longest of them.
template <class Item>
std::size_t name_width(const std::vector<Item>& items, std::size_t least) {
  for (const Item& item : items) least = std::max(least, item.name.size());
  return least;
}

std::string run_lines(const SolveStatistics& s) {
  std::string text = fmt::format(
      "run     {} cells, {} yarn elements, {} nodes; {} steps in {:.3g} s on {} thread{} ({:.3g} million "
      "cell-steps/s)\n",
      s.cells, s.yarns, s.nodes, s.steps, s.wall_s, s.threads, s.threads == 1 ? "" : "s", 1e-6 * s.cell_steps_per_s);
  if (s.symmetry != "none")
    text += fmt::format("        a {} was solved by symmetry, {} cells; forces and energies are those of the whole\n",
                        s.symmetry, s.cells_solved);
  text += fmt::format("step    {:.3g} s at least, set by {}; {:.4g} s in all; damping {:.3g} /s\n", s.step_s,
                      s.step_set_by.empty() ? "the user" : s.step_set_by, s.duration_s, s.damping_per_s);
  text += fmt::format("trust   energy error {}, kinetic/internal {}, damping work {:.3g} mJ\n", percent(s.energy_error),
                      percent(s.kinetic_to_internal), s.damping_work_mJ);
  text += fmt::format("        folded cells {} at the end, {} at worst; {} cells beyond the card's shear law\n",
                      s.folded_cells_at_end, s.folded_cells, s.cells_beyond_card);
  if (!s.perturbation_returned || s.perturbation_distance_mm > 0.0)
    text += fmt::format("        perturbed start: {} the state of the clean run, farthest node {:.3g} mm off\n",
                        s.perturbation_returned ? "returned to" : "DID NOT RETURN to", s.perturbation_distance_mm);
  text += fmt::format("fabric  largest |shear angle| {:.2f} deg, largest yarn strain {:.3g}\n", s.max_shear_angle_deg,
                      s.max_yarn_strain);
  return text;
}

std::string measure_lines(const std::vector<MeasureSummary>& measures) {
  if (measures.empty()) return "";
  const std::size_t width = name_width(measures, 16);
  std::string text = fmt::format("\n{:<{}}{:>10}{:>10}{:>10}{:>10}   shear angle at the end, deg\n", "measure", width,
                                 "mean", "sd", "min", "max");
  for (const MeasureSummary& m : measures)
    text += fmt::format("{:<{}}{}{}{}{}\n", m.name, width, aligned(m.mean), aligned(m.sd), aligned(m.least),
                        aligned(m.greatest));
  return text;
}

// Two grips that pull against each other should feel the same load; inertia, damping and free noise make the
// difference.
std::string load_difference(double first, double second) {
  const double difference = std::abs(first - second);
  const double larger = std::max(std::abs(first), std::abs(second));
  return fmt::format("loads of the two grips differ by {:.3g} N ({} of the larger)\n", difference,
                     larger > 0.0 ? percent(difference / larger) : "0 %");
}

std::string grip_lines(const Summary& summary) {
  if (summary.grip.empty()) return "";
  const std::size_t width = name_width(summary.grip, 16);
  std::string text = fmt::format("\n{:<{}}{:>10}{:>10}{:>10}   along its direction\n", "grip", width, "travel mm",
                                 "end N", "largest N");
  for (const GripSummary& g : summary.grip)
    text += fmt::format("{:<{}}{}{}{}\n", g.name, width, aligned(g.displacement), aligned(g.force, 3),
                        aligned(g.largest_force, 3));
  if (summary.bias && !summary.bias->row.empty()) {
    const BiasRow& end = summary.bias->row.back();
    text += load_difference(end.load[0], end.load[1]);
  }
  return text;
}

std::string tool_lines(const Summary& summary) {
  if (summary.tool.empty()) return "";
  const SolveStatistics& s = summary.statistics;
  std::size_t width = 16;
  for (const ToolSummary& tool : summary.tool) width = std::max(width, tool.motion.name.size() + 1);
  std::string text = fmt::format("\n{:<{}}{:>10}{:>10}{:>10}{:>12}   N along\n", "tool", width, "travel mm", "end N",
                                 "largest N", "contact mm2");
  for (const ToolSummary& tool : summary.tool) {
    text += fmt::format("{:<{}}{}{}{}{:>12.0f}   {}", tool.motion.name, width, aligned(tool.motion.displacement),
                        aligned(tool.motion.force, 3), aligned(tool.motion.largest_force, 3), tool.contact_area,
                        tool.at_rest ? "its axis, at rest" : "its motion");
    if (const auto& f = tool.whole_force; f)
      text += fmt::format("; x, y, z at the end {:.3f}, {:.3f}, {:.3f} N", (*f)[0], (*f)[1], (*f)[2]);
    text += "\n";
  }
  text += fmt::format(
      "contact: greatest penetration {} of the thickness; friction {:.4g} mJ, contact damping {:.4g} mJ; {} of the "
      "time\n",
      percent(s.contact_penetration), s.friction_work_mJ, s.contact_damping_work_mJ,
      percent(s.wall_s > 0.0 ? s.contact_wall_s / s.wall_s : 0.0));
  return text;
}

std::string ply_lines(const Summary& summary) {
  if (summary.ply.empty()) return "";
  const std::size_t width = name_width(summary.ply, 16);
  const bool formed = summary.ply.front().forming.has_value();
  std::string text = fmt::format("\n{:<{}}{:>10}{:>10}{:>10}{:>10}{}\n", "ply", width, "cells", "max deg", "strain %",
                                 "folded", formed ? "   draw-in mm      mean  wrinkled %" : "   zigzags %");
  for (const PlySummary& ply : summary.ply) {
    text += fmt::format("{:<{}}{:>10}{}{}{:>10}", ply.name, width, ply.cells, aligned(ply.max_shear_angle),
                        aligned(100.0 * ply.max_yarn_strain, 3), ply.folded);
    if (ply.forming)
      text += aligned(ply.forming->draw_in.greatest, 2, 13) + aligned(ply.forming->draw_in.mean) +
              aligned(100.0 * ply.forming->wrinkles.area_share, 2, 12);
    if (ply.folds) text += aligned(100.0 * ply.folds->zigzag_share, 2, 12);
    text += "\n";
  }
  for (const PlySummary& ply : summary.ply)
    if (const std::string lines = waves_table(ply.waves); !lines.empty())
      text += fmt::format("of {}\n{}", ply.name, lines);
  return text;
}

std::string pair_lines(const Summary& summary) {
  const auto& pairs = summary.statistics.pairs;
  if (pairs.empty()) return "";
  std::size_t width = 16;
  for (const PairStatistics& pair : pairs) width = std::max(width, pair.lower.size() + pair.upper.size() + 2);
  std::string text = fmt::format("\n{:<{}}{:>10}{:>10}{:>12}{:>12}{:>12}{:>12}{:>12}\n", "between plies", width,
                                 "slip mm", "mean mm", "contact mm2", "force N", "MPa, most", "into mm", "friction mJ");
  for (const PairStatistics& pair : pairs)
    text += fmt::format("{:<{}}{}{}{}{}{:>12.3g}{:>12.3g}{}\n", pair.lower + "/" + pair.upper, width,
                        aligned(pair.max_slip_mm), aligned(pair.mean_slip_mm), aligned(pair.contact_area_mm2, 0, 12),
                        aligned(pair.force_N, 3, 12), pair.max_pressure_MPa, pair.max_penetration_mm,
                        aligned(pair.friction_work_mJ, 3, 12));
  return text;
}

std::string zone_lines(const BiasComparison& bias, const std::vector<PlySummary>& plies) {
  std::string text = fmt::format(
      "\nbias extension, W {:g} x L {:g} mm; ideal: inextensible yarns, three zones (Eq. 14); cells on a zone line "
      "left "
      "out\n{:<16}{:>10}{:>10}{:>10}{:>10}   shear angle at the end, deg\n",
      bias.specimen.width, bias.specimen.length, "zone", "cells", "mean", "sd", "ideal");
  for (std::size_t k = 0; k < bias.zones.size(); ++k) {
    const BiasZoneAngles& zones = bias.zones[k];
    for (std::size_t z = 0; z < zone_title.size(); ++z)
      text += fmt::format(
          "{:<16}{:>10}{}{}{}{}\n", zone_title[z], zones.simulated[z].cells,
          aligned(zones.simulated[z].mean * degrees_per_radian), aligned(zones.simulated[z].sd * degrees_per_radian),
          aligned(zones.ideal[z] * degrees_per_radian), plies.empty() || z > 0 ? "" : "   " + plies[k].name);
  }
  return text;
}

// "name unit" at the right of a column; a longer name is cut, never run into its neighbour.
std::string heading(const std::string& name, const std::string& unit) {
  const std::size_t room = travel_column - 2 - unit.size();
  return fmt::format("{:>{}}", fmt::format("{:.{}} {}", name, room, unit), travel_column);
}

std::string travel_lines(const BiasComparison& bias, const std::vector<MeasureSummary>& measures) {
  const auto column = [](double value, int decimals) { return aligned(value, decimals, travel_column); };
  std::string text = fmt::format("\n{}", heading("travel", "mm"));
  for (const MeasureSummary& m : measures) text += heading(m.name, "deg");
  text += heading("ideal", "deg");
  for (const std::string& grip : bias.specimen.grip) text += heading(grip, "N");
  text += fmt::format("{}\n", heading("ideal", "N"));
  for (const BiasRow& row : bias.row) {
    text += column(row.travel, 2);
    for (const double angle : row.measured_angle) text += column(angle * degrees_per_radian, 2);
    text += column(row.ideal_angle * degrees_per_radian, 2);
    text += fmt::format("{}{}{}\n", column(row.load[0], 3), column(row.load[1], 3), column(row.ideal_load, 3));
  }
  return text;
}

std::string frame_lines(const FrameComparison& frame) {
  return fmt::format(
      "\nshear frame at {:.2f} deg (Eq. 12): load {:.3f} N, of a fabric that follows it {:.3f} N (Eq. 13); from 5 deg "
      "on within {}\n",
      frame.angle * degrees_per_radian, frame.load, frame.ideal_load, percent(frame.worst_error));
}

}  // namespace

std::string summary_table(const Summary& summary) {
  std::string text = run_lines(summary.statistics);
  text += measure_lines(summary.measure);
  text += grip_lines(summary);
  text += tool_lines(summary);
  text += ply_lines(summary);
  text += pair_lines(summary);
  if (!summary.ply.empty() && summary.ply.front().forming) text += forming_loads_table(*summary.ply.front().forming);
  if (summary.frame) text += frame_lines(*summary.frame);
  if (summary.forming) text += forming_table(*summary.forming);
  text += waves_table(summary.waves);
  if (summary.bias) text += zone_lines(*summary.bias, summary.ply) + travel_lines(*summary.bias, summary.measure);
  if (!summary.warning.empty()) text += "\n";
  for (const std::string& line : summary.warning) text += "warning " + line + "\n";
  return text;
}

}  // namespace weaveform
