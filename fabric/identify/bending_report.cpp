// The report's section on a test of bending.
#include <fmt/format.h>

#include <cmath>

#include "fabric/card/card.hpp"
#include "fabric/identify/bending_fit.hpp"
#include "fabric/identify/hanging_strip.hpp"

namespace weaveform::identify {
namespace {

std::string kind_title(const BendingFit& fit) {
  std::string title = fit.source == BendingSource::moment_curvature ? "Moment and curvature"
                      : fit.source == BendingSource::cantilever     ? "Shapes of hanging strips"
                                                                    : "Peirce's numbers";
  if (!fit.along[0] || !fit.along[1]) title += ", along the " + yarn_families[fit.along[0] ? 0 : 1];
  return fit.sense == BentSense::both ? title : title + ", " + name_of(fit.sense) + " outwards";
}

std::string numbers_section(const BendingFit& fit) {
  std::string text = "| specimen | rigidity (N mm) |\n|---|---|\n";
  for (std::size_t k = 0; k < fit.rigidities.size(); ++k)
    text += fmt::format("| {} | {:.4g} |\n", k + 1, fit.rigidities[k]);
  return text + fmt::format("\nMean {:.4g} N mm, interval {:.4g} to {:.4g}, deviation {:.3g}.\n", fit.rigidity,
                            fit.rigidity_band[0], fit.rigidity_band[1], fit.rigidity_deviation);
}

std::string law_table(const BendingFit& fit) {
  std::string text =
      "| curvature (1/mm) | moment (N) | interval | stiffness (N mm) | specimens |\n|---|---|---|---|---|\n";
  double next = 0.0;
  for (const auto& at : fit.law) {
    if (at.curvature < next) continue;
    next = at.curvature + 0.1 * fit.law.back().curvature;
    text += fmt::format("| {:.4g} | {:.4g} | {:.4g} to {:.4g} | {:.4g} | {} |\n", at.curvature, at.moment,
                        at.moment - at.half_band, at.moment + at.half_band, at.tangent, at.specimens);
  }
  return text;
}

// What the law makes of strips, beside what its first stiffness would: the number that a user can measure.
std::string tips_table(const BendingFit& fit, double weight) {
  const double length = std::cbrt(fit.curve.tangent.front() / weight);
  const BendingCurve constant{{0.0, 1.0}, {fit.curve.tangent.front(), fit.curve.tangent.front()}};
  std::string text = fmt::format(
      "\nWhat a strip of this law does under the yarns' weight, {:.4g} N/m^2 (clamped level):\n\n"
      "| overhang (mm) | tip below the clamp (mm) | with the first stiffness alone (mm) | "
      "curvature at the clamp (1/mm) |\n|---|---|---|---|\n",
      weight * 1e6);
  for (const double share : {0.75, 1.0, 1.25, 1.5}) {
    const double overhang = std::round(share * length);
    const HangingTip tip = hanging_tip(fit.curve, weight, overhang), first = hanging_tip(constant, weight, overhang);
    text +=
        fmt::format("| {:.0f} | {:.1f} | {:.1f} | {:.4g}{} |\n", overhang, tip.drop, first.drop, tip.greatest_curvature,
                    tip.greatest_curvature > fit.law.back().curvature ? ", beyond what was measured" : "");
  }
  return text;
}

}  // namespace

std::string bending_section(const BendingFit& fit, const FitSpec& spec, bool makes_card) {
  std::string text = fmt::format("\n## {}\n\n{}. ", kind_title(fit),
                                 makes_card ? "This fit makes the card's bending" : "For comparison: not in the card");
  const std::string senses = fit.senses.empty() ? "" : fit.senses + "\n\n";
  if (fit.is_constant()) return text + "\n\n" + senses + numbers_section(fit);
  text += fmt::format(
      "Specimens: {}. The law is monotone, {}, with {} pieces to {:.4g} 1/mm (a radius of {:.3g} "
      "mm), "
      "beyond which its last stiffness goes on; it lies within {:.2g} N of the specimens' mean. Its first stiffness is "
      "{:.4g} N mm. The band is Student's t over {}.\n\n",
      fit.specimens.size(),
      fit.sense == BentSense::both ? std::string("the same in both senses")
                                   : "of bending with the " + name_of(fit.sense) + " outwards",
      fit.curve.knot.size(), fit.law.back().curvature, 1.0 / fit.law.back().curvature, fit.misfit,
      fit.curve.tangent.front(),
      fit.specimens.size() > 1 ? "the specimens' own curves" : "the residuals of the one specimen");
  if (fit.friction)
    text += fmt::format(
        "The records go to and fro: friction of {:.4g} N over a rise of {:.4g} 1/mm (mean of the specimens).\n\n",
        fit.friction->moment, fit.friction->rise);
  text += senses + law_table(fit) + tips_table(fit, spec.area_weight());
  text +=
      fmt::format("\n| specimen | bent | to (1/mm) | first stiffness (N mm) | misfit ({}) |\n|---|---|---|---|---|\n",
                  fit.source == BendingSource::cantilever ? "mm" : "N");
  std::string notes;
  for (const auto& specimen : fit.specimens) {
    text += fmt::format("| {} | {} | {:.4g} | {:.4g} | {:.3g} |\n", specimen.name, name_of(specimen.sense),
                        specimen.reach, specimen.first_stiffness, specimen.misfit);
    for (const auto& note : specimen.notes) notes += fmt::format("- {}: {}\n", specimen.name, note);
  }
  return text + (notes.empty() ? "" : "\n" + notes);
}

}  // namespace weaveform::identify
