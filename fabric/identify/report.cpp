// The report of a fit, for readers (Markdown) and for scripts (JSON), and the list of output files.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/json/json_text.hpp"
#include "core/vector/angle.hpp"
#include "fabric/identify/fit_tables.hpp"
#include "fabric/identify/identify.hpp"

namespace weaveform::identify {
namespace {

using Json = nlohmann::ordered_json;

std::string form_name(const ShearForm& form) {
  return form.start ? "polynomial+start" : "polynomial";
}

std::string bullet_list(const std::vector<std::string>& sentences) {
  std::string text;
  for (const auto& sentence : sentences) text += "- " + sentence + "\n";
  return text;
}

double crimp_of(const Identification& found, std::size_t yarn_fit) {
  const std::size_t family = found.yarn[0] == yarn_fit ? 0 : 1;
  return found.spec.yarn[family].crimp / 100.0;
}

std::string yarn_rows(const Identification& found) {
  std::string text;
  for (std::size_t f = 0; f < yarn_families.size(); ++f) {
    const double modulus = found.card.yarn[f].linear_modulus;
    if (!found.yarn[f]) {
      text += fmt::format("| {} yarn: linear modulus | {:.6g} MPa | kept | |\n", yarn_families[f], modulus);
      continue;
    }
    const YarnFit& fit = found.yarns[*found.yarn[f]];
    text += fmt::format(
        "| {} yarn: linear modulus | {:.6g} MPa | {:.6g} to {:.6g} | specimens: {}, deviation {:.3g} MPa |\n",
        yarn_families[f], modulus, fit.band[0], fit.band[1], fit.specimens.size(), fit.deviation);
  }
  return text;
}

std::string shear_rows(const Identification& found) {
  const ShearFit* fit = found.shear();
  if (fit == nullptr) return "| shear law | kept | | |\n";
  const ShearCurve& curve = fit->chosen().pooled.curve;
  std::string text =
      fmt::format("| shear: tests | {}{} | | specimens: {}, to {:.1f} deg |\n",
                  found.shear_from_frame() ? "shear frame" : "bias extension", found.simulated ? ", simulated" : "",
                  fit->specimens.size(), fit->greatest_angle() / degree);
  for (std::size_t n = 1; n < curve.stress.size(); ++n)
    text += fmt::format("| shear stress: coefficient of g^{} | {:.6g} MPa | | |\n", n, curve.stress[n]);
  if (fit->start_chosen)
    text +=
        fmt::format("| shear start: plateau, rise | {:.4g} MPa, {:.4g} | | |\n", curve.start.plateau, curve.start.rise);
  for (const double angle : {10.0, 20.0, 30.0, 40.0, 50.0}) {
    for (const auto& at : fit->law) {
      if (std::abs(at.angle / degree - angle) > 1e-6) continue;
      const std::string deviation =
          fit->specimens.size() < 2 || found.simulated
              ? ""
              : fmt::format("deviation {:.2g} {}", at.deviation, found.shear_from_frame() ? "MPa" : "N of load");
      text += fmt::format("| shear stress at {} deg | {:.4g} MPa | {:.4g} to {:.4g} | {} |\n", angle, at.stress,
                          at.stress - at.half_band, at.stress + at.half_band, deviation);
    }
  }
  return text;
}

std::string bending_row(const BendingFit& fit, const std::string& family) {
  const std::string what =
      fit.sense == BentSense::both ? family : fmt::format("{}, {} outwards", family, name_of(fit.sense));
  if (fit.is_constant())
    return fmt::format("| bending along the {}: rigidity | {:.4g} N mm | {:.4g} to {:.4g} | Peirce, specimens: {} |\n",
                       what, fit.rigidity, fit.rigidity_band[0], fit.rigidity_band[1], fit.rigidities.size());
  const BendingPoint& end = fit.law.back();
  return fmt::format("| bending along the {}: first stiffness | {:.4g} N mm | | {}, specimens: {} |\n", what,
                     fit.first_stiffness(), name_of(fit.source), fit.specimens.size()) +
         fmt::format("| bending along the {}: moment at {:.4g} 1/mm | {:.4g} N | {:.4g} to {:.4g} | {} pieces |\n",
                     what, end.curvature, end.moment, end.moment - end.half_band, end.moment + end.half_band,
                     fit.curve.knot.size());
}

std::string bending_rows(const Identification& found) {
  if (found.bends.empty()) return "";
  std::string text;
  for (std::size_t f = 0; f < yarn_families.size(); ++f) {
    if (!found.bending[f]) {
      text += fmt::format("| bending along the {} | kept | | |\n", yarn_families[f]);
      continue;
    }
    const std::size_t first = *found.bending[f];
    text += bending_row(found.bends[first], yarn_families[f]);
    if (found.bends[first].sense == BentSense::face) text += bending_row(found.bends[first + 1], yarn_families[f]);
  }
  return text;
}

std::string yarn_section(const YarnFit& fit) {
  std::string text = fmt::format(
      "\n## {}: yarn tension\n\nStress is the force over the {} section of {:.4g} mm^2 at true strain. The elastic "
      "part was "
      "{}. A line by least squares gives the modulus; where it meets zero stress is the slack toe, taken out.\n\n"
      "| specimen | modulus (MPa) | elastic part (strain) | points | toe (strain) | residual (MPa) |\n"
      "|---|---|---|---|---|---|\n",
      fit.test, fit.true_stress ? "stretched" : "unstretched", fit.section,
      fit.range_given ? "given" : "found (straight to 1 %)");
  std::string notes;
  for (const auto& yarn : fit.specimens) {
    text += fmt::format("| {} | {:.6g} | {:.4g} to {:.4g} | {} | {:.3g} | {:.3g} |\n", yarn.name, yarn.modulus,
                        yarn.elastic[0], yarn.elastic[1], yarn.points, yarn.toe, yarn.scatter);
    for (const auto& note : yarn.notes) notes += fmt::format("- {}: {}\n", yarn.name, note);
  }
  return text + (notes.empty() ? "" : "\n" + notes);
}

std::string form_row(const FormFit& fit, bool chosen, const char* unit) {
  return fmt::format("| {}{} | {:.4g} {} | {:.1f} | {} | {} |\n", form_name(fit.form), chosen ? " (taken)" : "",
                     fit.misfit, unit, fit.aicc, fit.left_out ? fmt::format("{:.4g} {}", *fit.left_out, unit) : "",
                     fit.pooled.constrained ? "positive only by constraint" : "positive");
}

std::string shear_section(const ShearFit& fit, const std::string& title, const char* unit, bool makes_card) {
  std::string text = fmt::format(
      "\n## {}\n\n{}. Specimens: {}, on {} angles from {:.4g} to {:.4g} deg. Form: {}.\n\n", title,
      makes_card ? "This fit makes the card's shear law" : "For comparison: not in the card", fit.specimens.size(),
      fit.law.size(), fit.law.front().angle / degree, fit.greatest_angle() / degree, fit.reason);
  text +=
      "| form | misfit of the mean curve | AICc | error on a specimen left out | tangent |\n|---|---|---|---|---|\n";
  text += form_row(fit.polynomial, !fit.start_chosen, unit);
  if (fit.with_start) text += form_row(*fit.with_start, fit.start_chosen, unit);
  text += fmt::format(
      "\nThe band is Student's t with {:.3g} degrees of freedom over {}; in the table, `stress_low` to `stress_high` "
      "holds "
      "at each angle, `whole_low` to `whole_high` for the whole curve.\n\n",
      fit.freedom, fit.specimens.size() > 1 ? "the specimens' own curves" : "the residuals of the one specimen");
  text += "| specimen | from (deg) | to (deg) | points |\n|---|---|---|---|\n";
  std::string notes;
  for (const auto& specimen : fit.specimens) {
    text += fmt::format("| {} | {:.4g} | {:.4g} | {} |\n", specimen.name, specimen.angle.front() / degree,
                        specimen.angle.back() / degree, specimen.angle.size());
    for (const auto& note : specimen.notes) notes += fmt::format("- {}: {}\n", specimen.name, note);
  }
  return text + (notes.empty() ? "" : "\n" + notes);
}

// Stresses of both sources at the same angles: what an engineer asks first.
std::string both_sources(const Identification& found) {
  if (!found.frame || !found.bias) return "";
  std::string text =
      "\n## Shear frame against bias extension\n\n| angle (deg) | frame (MPa) | bias (MPa) | frame/bias "
      "|\n|---|---|---|---|\n";
  for (const auto& at : found.frame->law) {
    const double angle = at.angle / degree;
    if (at.angle > found.bias->greatest_angle() + 1e-9 || std::abs(std::remainder(angle, 5.0)) > 1e-6) continue;
    const double bias = stress_of(found.bias->chosen().pooled.curve, at.strain);
    text += fmt::format("| {:.0f} | {:.4g} | {:.4g} | {:.3g} |\n", angle, at.stress, bias, at.stress / bias);
  }
  return text;
}

std::string simulated_unit(const Identification& found) {
  return found.shear_from_frame() ? "MPa" : "N";
}

std::string report_markdown(const Identification& found) {
  std::string text = fmt::format("# Fit of {}\n\n", found.spec.head.name) + summary_markdown(found);
  if (!found.warnings.empty()) text += "\n## Warnings\n\n" + bullet_list(found.warnings);
  text += "\n## Assumed, not measured\n\n" + bullet_list(found.assumptions);
  for (const auto& fit : found.yarns) text += yarn_section(fit);
  if (found.simulated) text += simulation_section(*found.simulated, simulated_unit(found));
  const bool closed = !found.simulated;
  if (found.frame) text += shear_section(*found.frame, "Shear frame", "MPa", closed && found.shear_from_frame());
  if (found.bias) text += shear_section(*found.bias, "Bias extension", "N", closed && !found.shear_from_frame());
  text += both_sources(found);
  for (std::size_t k = 0; k < found.bends.size(); ++k)
    text += bending_section(found.bends[k], found.spec, found.makes_bending(k));
  return text;
}

Json bending_json(const BendingFit& fit, bool makes_card) {
  Json json = {{"name", fit.name()},
               {"source", name_of(fit.source)},
               {"along_warp", fit.along[0]},
               {"along_weft", fit.along[1]},
               {"sense", name_of(fit.sense)},
               {"makes_card", makes_card},
               {"first_stiffness_N_mm", fit.first_stiffness()},
               {"degrees_of_freedom", fit.freedom}};
  if (!fit.senses.empty()) json["senses"] = fit.senses;
  if (fit.is_constant()) {
    json["rigidity_N_mm"] = fit.rigidity;
    json["rigidity_interval_N_mm"] = fit.rigidity_band;
    json["rigidities_N_mm"] = fit.rigidities;
    return json;
  }
  json["greatest_curvature_1_per_mm"] = fit.law.back().curvature;
  json["misfit_N"] = fit.misfit;
  json["pieces"] = fit.curve.knot.size();
  if (fit.friction) json["friction"] = {{"moment_N", fit.friction->moment}, {"rise_1_per_mm", fit.friction->rise}};
  json["specimens"] = Json::array();
  for (const auto& specimen : fit.specimens)
    json["specimens"].push_back({{"name", specimen.name},
                                 {"sense", name_of(specimen.sense)},
                                 {"greatest_curvature_1_per_mm", specimen.reach},
                                 {"first_stiffness_N_mm", specimen.first_stiffness},
                                 {"notes", specimen.notes}});
  json["law"] = Json::array();
  for (const auto& at : fit.law)
    json["law"].push_back({{"curvature_1_per_mm", at.curvature},
                           {"moment_N", at.moment},
                           {"tangent_N_mm", at.tangent},
                           {"half_band_N", at.half_band},
                           {"specimens", at.specimens}});
  return json;
}

Json yarn_json(const YarnFit& fit) {
  Json json = {{"test", fit.test},
               {"modulus_MPa", fit.modulus},
               {"modulus_interval_MPa", fit.band},
               {"modulus_deviation_MPa", fit.deviation},
               {"section_mm2", fit.section},
               {"stress", fit.true_stress ? "true" : "nominal"},
               {"elastic_range", fit.range_given ? "given" : "found"},
               {"specimens", Json::array()}};
  for (const auto& yarn : fit.specimens) {
    json["specimens"].push_back({{"name", yarn.name},
                                 {"modulus_MPa", yarn.modulus},
                                 {"elastic_strains", yarn.elastic},
                                 {"points", yarn.points},
                                 {"toe_strain", yarn.toe},
                                 {"residual_MPa", yarn.scatter},
                                 {"notes", yarn.notes}});
  }
  return json;
}

Json form_json(const FormFit& fit, const std::string& unit) {
  Json json = {{"form", form_name(fit.form)},
               {"stress_coefficients_MPa", fit.pooled.curve.stress},
               {"misfit_" + unit, fit.misfit},
               {"aicc", fit.aicc},
               {"constrained", fit.pooled.constrained}};
  if (fit.form.start)
    json["start"] = {{"plateau_MPa", fit.pooled.curve.start.plateau}, {"rise", fit.pooled.curve.start.rise}};
  if (fit.left_out) json["left_out_error_" + unit] = *fit.left_out;
  return json;
}

Json shear_json(const ShearFit& fit, const std::string& unit) {
  Json json = {{"form", form_name(fit.chosen().form)},
               {"reason", fit.reason},
               {"greatest_angle_deg", fit.greatest_angle() / degree},
               {"degrees_of_freedom", fit.freedom},
               {"forms", Json::array({form_json(fit.polynomial, unit)})},
               {"specimens", Json::array()},
               {"law", Json::array()}};
  if (fit.with_start) json["forms"].push_back(form_json(*fit.with_start, unit));
  for (const auto& specimen : fit.specimens)
    json["specimens"].push_back({{"name", specimen.name},
                                 {"greatest_angle_deg", specimen.angle.back() / degree},
                                 {"points", specimen.angle.size()},
                                 {"notes", specimen.notes}});
  for (const auto& at : fit.law)
    json["law"].push_back({{"angle_deg", at.angle / degree},
                           {"stress_MPa", at.stress},
                           {"tangent_MPa", at.tangent},
                           {"half_band_MPa", at.half_band},
                           {"half_band_whole_MPa", at.half_whole}});
  return json;
}

}  // namespace

Json fit_json(const Identification& found) {
  Json json = {{"name", found.spec.head.name},
               {"confidence_percent", found.spec.head.confidence},
               {"warnings", found.warnings},
               {"assumptions", found.assumptions},
               {"yarns", Json::array()}};
  for (const auto& fit : found.yarns) json["yarns"].push_back(yarn_json(fit));
  if (found.shear() != nullptr) json["shear_from"] = found.shear_from_frame() ? "shear_frame" : "bias_extension";
  if (found.frame) json["shear_frame"] = shear_json(*found.frame, "MPa");
  if (found.bias) json["bias_extension"] = shear_json(*found.bias, "N");
  if (found.simulated) {
    json["simulation"] = simulation_json(*found.simulated);
    json["simulation"]["fit"] = shear_json(found.simulated->fit, simulated_unit(found));
  }
  for (std::size_t k = 0; k < found.bends.size(); ++k)
    json["bending"].push_back(bending_json(found.bends[k], found.makes_bending(k)));
  return json;
}

std::string summary_markdown(const Identification& found) {
  return fmt::format("| parameter | value | {:.4g} % interval | from |\n|---|---|---|---|\n",
                     found.spec.head.confidence) +
         yarn_rows(found) + shear_rows(found) + bending_rows(found);
}

std::vector<OutputFile> output_files(const Identification& found) {
  const double confidence = found.spec.confidence();
  std::vector<OutputFile> files;
  for (std::size_t i = 0; i < found.yarns.size(); ++i) {
    const YarnFit& fit = found.yarns[i];
    files.push_back({.name = fit.test + ".csv", .text = yarn_csv(fit, crimp_of(found, i))});
    files.push_back({.name = fit.test + ".svg", .chart = yarn_chart(fit, crimp_of(found, i), confidence)});
  }
  if (found.frame) {
    files.push_back({.name = "shear_frame.csv", .text = shear_csv(*found.frame, false)});
    files.push_back(
        {.name = "shear_frame.svg", .chart = shear_chart(*found.frame, "shear frame: stress and law", confidence)});
  }
  if (found.bias) {
    files.push_back({.name = "bias_extension.csv", .text = shear_csv(*found.bias, true)});
    files.push_back(
        {.name = "bias_extension.svg", .chart = shear_chart(*found.bias, "shear law from bias extension", confidence)});
    files.push_back({.name = "bias_extension_load.svg", .chart = load_chart(*found.bias)});
  }
  if (found.simulated) {
    const std::string unit = simulated_unit(found);
    files.push_back({.name = "simulated_law.csv", .text = simulated_law_csv(found.simulated->fit)});
    files.push_back({.name = "simulated_law.svg",
                     .chart = shear_chart(found.simulated->fit, "shear law through simulation", confidence)});
    files.push_back({.name = "simulated_load.csv", .text = simulated_load_csv(*found.simulated, unit)});
    files.push_back({.name = "simulated_load.svg", .chart = simulated_load_chart(*found.simulated, unit)});
  }
  for (const auto& fit : found.bends) {
    files.push_back({.name = fit.name() + ".csv", .text = bending_csv(fit)});
    if (!fit.is_constant()) files.push_back({.name = fit.name() + ".svg", .chart = bending_chart(fit, confidence)});
  }
  files.push_back({.name = "report.md", .text = report_markdown(found)});
  files.push_back({.name = "report.json", .text = json_text(fit_json(found))});
  // The card last: whoever finds one finds its report beside it.
  files.push_back({.name = "card.toml", .text = found.card_text});
  return files;
}

}  // namespace weaveform::identify
