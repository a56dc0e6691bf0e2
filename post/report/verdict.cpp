#include "post/report/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/vector/angle.hpp"
#include "mesher/mesh/stack.hpp"
#include "post/output/percent.hpp"

namespace weaveform {
namespace {

using Json = nlohmann::ordered_json;

struct Greatest {
  int cell = 0;
  double angle = 0.0;  // deg
  Vec3 at = {0.0, 0.0, 0.0};
};

Greatest greatest_angle(const Mesh& mesh, const Fields& end) {
  const int cell = most_sheared_cell(end);
  return {cell, std::abs(end.shear_angle[static_cast<std::size_t>(cell)]) * degrees_per_radian,
          cell_centre(mesh.cells, cell, end.position)};
}

Json row(const std::string& name, const std::string& value, const std::string& note = "") {
  return {{"name", name}, {"value", value}, {"note", note}};
}

std::string angle_words(double greatest, const Card& card) {
  const double limit = card.shear.valid_to_deg;
  return fmt::format("Greatest shear angle {:.1f}°, {} the {:g}° to which the card's shear law is meant to hold",
                     greatest, greatest <= limit ? "within" : "beyond", limit);
}

// Of a stack, of the ply that has most of it.
double greatest_share(const Summary& summary, double (*share)(const PlySummary&)) {
  double greatest = 0.0;
  for (const PlySummary& ply : summary.ply) greatest = std::max(greatest, share(ply));
  return greatest;
}

std::string wrinkle_words(const Summary& summary) {
  if (!summary.ply.empty() && summary.ply.front().forming) {
    const double share =
        greatest_share(summary, [](const PlySummary& ply) { return ply.forming->wrinkles.area_share; });
    return share > 0.0 ? fmt::format("{} of a ply's area wrinkled", percent(share)) : "no wrinkles";
  }
  if (summary.forming) {
    const double share = summary.forming->wrinkles.area_share;
    return share > 0.0 ? fmt::format("{} of the area wrinkled", percent(share)) : "no wrinkles";
  }
  if (summary.folds) {
    const double share = summary.folds->zigzag_share;
    return share > 0.0 ? fmt::format("{} of the area folded from cell to cell", percent(share)) : "no folds";
  }
  return "";
}

// Of one ply or, for all of a stack have the same tools, of its first.
const Forming* forming_of(const Summary& summary) {
  if (summary.forming) return &*summary.forming;
  return !summary.ply.empty() && summary.ply.front().forming ? &*summary.ply.front().forming : nullptr;
}

std::string force_words(const Summary& summary) {
  if (const Forming* forming = forming_of(summary); forming != nullptr && forming->punch)
    return fmt::format("{} at most {:.3g} N", forming->punch->punch, forming->punch->greatest);
  const GripSummary* most = nullptr;
  for (const GripSummary& grip : summary.grip)
    if (most == nullptr || std::abs(grip.largest_force) > std::abs(most->largest_force)) most = &grip;
  return most == nullptr ? "" : fmt::format("{} at most {:.3g} N", most->name, most->largest_force);
}

std::string headline(const Summary& summary, const Card& card, double greatest) {
  std::string words = angle_words(greatest, card);
  for (const std::string& part : {wrinkle_words(summary), force_words(summary)})
    if (!part.empty()) words += "; " + part;
  return words + ".";
}

void add_forces(Json& rows, const Summary& summary) {
  for (const ToolSummary& tool : summary.tool)
    rows.push_back(
        row(fmt::format("force of {}", tool.motion.name), fmt::format("{:.4g} N", tool.motion.force),
            fmt::format("at the end, after {:.4g} mm; at most {:.4g} N{}", tool.motion.displacement,
                        tool.motion.largest_force,
                        tool.whole_force ? fmt::format("; x, y, z: {:.4g}, {:.4g}, {:.4g} N", (*tool.whole_force)[0],
                                                       (*tool.whole_force)[1], (*tool.whole_force)[2])
                                         : "")));
  for (const GripSummary& grip : summary.grip)
    rows.push_back(
        row(fmt::format("force of {}", grip.name), fmt::format("{:.4g} N", grip.force),
            fmt::format("at the end, after {:.4g} mm; at most {:.4g} N", grip.displacement, grip.largest_force)));
  if (summary.frame)
    rows.push_back(row("load of the shear frame", fmt::format("{:.4g} N", summary.frame->load),
                       fmt::format("{:.4g} N of a fabric that follows the frame", summary.frame->ideal_load)));
}

void add_shape(Json& rows, const Summary& summary) {
  if (summary.forming) {
    const Forming& forming = *summary.forming;
    rows.push_back(
        row("wrinkled area", percent(forming.wrinkles.area_share),
            fmt::format("highest {:.3g} mm; a wrinkle is more than {:.3g} mm high", forming.wrinkles.greatest_relief,
                        forming.wrinkle_limits.relief(forming.flat_thickness))));
    rows.push_back(row(
        "draw-in", fmt::format("{:.4g} mm", forming.draw_in.greatest),
        fmt::format("at most, at {:.0f}° from the warp; at least {:.4g} mm, mean {:.4g} mm",
                    forming.draw_in.greatest_at * degrees_per_radian, forming.draw_in.least, forming.draw_in.mean)));
    rows.push_back(row("thickness", fmt::format("{:.3g} to {:.3g} mm", forming.thinnest, forming.thickest),
                       fmt::format("{:.3g} mm flat", forming.flat_thickness)));
  }
  if (summary.waves.are() != WavesOf::nobody)
    rows.push_back(row("wrinkles' length and height", fmt::format("{:.3g} mm", summary.waves.all.wavelength),
                       waves_in_words(summary.waves)));
  if (summary.ply.empty())
    rows.push_back(
        row("compressed fibre", percent(summary.waves.compressed_share),
            fmt::format("of all, by more than {:g} %: where it will wrinkle next", 100.0 * compressed_from)));
  if (summary.folds)
    rows.push_back(row("folded from cell to cell", percent(summary.folds->zigzag_share),
                       fmt::format("of the area; farthest from its plane {:.3g} mm", summary.folds->out_of_plane)));
}

void add_plies(Json& rows, const Summary& summary) {
  for (const PlySummary& ply : summary.ply) {
    std::string note = fmt::format("{} cells of {}", ply.cells, ply.material);
    if (ply.forming)
      note += fmt::format("; draw-in {:.3g} mm at most, {:.3g} mm in the mean; {} of the area wrinkled",
                          ply.forming->draw_in.greatest, ply.forming->draw_in.mean,
                          percent(ply.forming->wrinkles.area_share));
    if (ply.waves.are() != WavesOf::nobody) note += "; wrinkles are " + waves_in_words(ply.waves);
    rows.push_back(row(fmt::format("ply {}", ply.name), fmt::format("{:.1f}°", ply.max_shear_angle), note));
  }
  for (const PairStatistics& pair : summary.statistics.pairs)
    rows.push_back(
        row(fmt::format("slip of {} on {}", pair.upper, pair.lower), fmt::format("{:.3g} mm", pair.max_slip_mm),
            fmt::format("at most, {:.3g} mm in the mean; pressure {:.3g} MPa and penetration {:.3g} mm at "
                        "most, {:.3g} mJ lost to friction",
                        pair.mean_slip_mm, pair.max_pressure_MPa, pair.max_penetration_mm, pair.friction_work_mJ)));
}

Json rows_of(const Summary& summary, const Card& card, const Greatest& greatest) {
  const SolveStatistics& s = summary.statistics;
  Json rows = Json::array();
  Json angle = row("greatest shear angle", fmt::format("{:.1f}°", greatest.angle),
                   fmt::format("in cell {} at ({:.1f}, {:.1f}, {:.1f}) mm", greatest.cell, greatest.at[0],
                               greatest.at[1], greatest.at[2]));
  angle["cell"] = greatest.cell;
  rows.push_back(std::move(angle));
  rows.push_back(row("cells beyond the card's range", fmt::format("{}", s.cells_beyond_card),
                     fmt::format("of {}; the shear law is meant to hold to {:g}°", s.cells, card.shear.valid_to_deg)));
  add_shape(rows, summary);
  add_plies(rows, summary);
  add_forces(rows, summary);
  rows.push_back(row("greatest yarn strain", fmt::format("{:.2f} %", 100.0 * s.max_yarn_strain)));
  rows.push_back(row("energy error", percent(s.energy_error), "of the greatest energy, at the worst moment"));
  return rows;
}

// What is known of the model's own limits, with numbers of the benchmark (examples/benchmark).
Json trust_of(ResultFolder& folder, const Summary& summary) {
  const SolveStatistics& s = summary.statistics;
  const Scene& scene = folder.scene();
  Json trust = Json::array();
  trust.push_back(
      "Yarns are pinned at their crossings and cannot slide over one another. Against the measured bias extensions of "
      "the international benchmark (Cao et al. 2008), shear laws from a shear frame over-predict the load 1.4 to 6.4 "
      "times, a shear law from one laboratory's bias extension predicts another's within 13 %.");
  trust.push_back(fmt::format(
      "One run does not know the error of its mesh: 'weaveform run --accuracy 2%' or a study of coarsenings tells it. "
      "This "
      "one has {} cells{}.",
      s.cells, s.symmetry == "none" ? "" : fmt::format(", of which a {} was solved by symmetry", s.symmetry)));
  const bool all_bend = scene.ply.empty() ? has_bending(scene.model)
                                          : std::all_of(scene.ply.begin(), scene.ply.end(),
                                                        [](const PlySpec& ply) { return has_bending(ply.model); });
  if (!all_bend)
    trust.push_back(
        "Without bending stiffness folds are as short as the cells: where it wrinkles is the fabric's answer, how "
        "long and how high is the mesh's.");
  trust.push_back(
      fmt::format("Kinetic energy came to {} of the internal energy after the first tenth of the travel, the energy "
                  "balance closes to {}.",
                  percent(s.kinetic_to_internal), percent(s.energy_error)));
  return trust;
}

}  // namespace

Json verdict_json(ResultFolder& folder, const Evaluation& evaluation) {
  const Summary& summary = evaluation.summary;
  const Resolved& model = folder.model();
  const Greatest greatest = greatest_angle(model.mesh, evaluation.end);
  const std::vector<int> ply_of = ply_of_cells(model.mesh);
  const Card& card = model.of_ply(static_cast<std::size_t>(ply_of[static_cast<std::size_t>(greatest.cell)])).card;
  return {{"headline", headline(summary, card, greatest.angle)},
          {"rows", rows_of(summary, card, greatest)},
          {"warnings", summary.warning},
          {"trust", trust_of(folder, summary)}};
}

}  // namespace weaveform
