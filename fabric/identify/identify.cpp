#include "fabric/identify/identify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/vector/angle.hpp"
#include "fabric/identify/carried_parts.hpp"
#include "fabric/identify/decrimping.hpp"
#include "fabric/identify/shear_tests.hpp"

namespace weaveform::identify {
namespace {

constexpr double percent = 0.01;
constexpr double greatest_claim = 0.5;    // 1; that a card may claim
constexpr double suspicious_ratio = 3.0;  // between a fitted modulus and the base card's

// A number of a card with seven significant digits: far finer than any test, and legible.
double legible(double value) {
  return std::stod(fmt::format("{:.7g}", value));
}

// Eq. 11 in the card's own words: let the card reader work it out from a card that is complete but for its laws.
double section_of(const YarnFile& yarn) {
  if (yarn.section) return *yarn.section;
  constexpr double tex = 1e-12, g_per_cm3 = 1e-9;  // tonne/mm, tonne/mm^3
  return section_from_densities(yarn.linear_density * tex, *yarn.fibre_volume_fraction, *yarn.fibre_density * g_per_cm3,
                                *yarn.matrix_density * g_per_cm3);
}

void fit_yarns(Identification& found) {
  const FitSpec& spec = found.spec;
  for (const auto& test : spec.tensile) {
    const std::size_t family = test.yarn == TestedYarn::weft ? 1 : 0;
    const double section = section_of(spec.yarn[family]);
    if (test.yarn == TestedYarn::both && section != section_of(spec.yarn[1]))
      throw InputError(
          fmt::format("{}: the test '{}' stands for both yarns, but their sections differ; give each its own "
                      "[[tensile]]",
                      spec.file, test.name));
    for (std::size_t f = 0; f < yarn_families.size(); ++f) {
      if (stands_for(test, f)) found.yarn[f] = found.yarns.size();
    }
    found.yarns.push_back(fit_yarn(test, spec.file, section, spec.confidence()));
    const auto& warnings = found.yarns.back().warnings;
    found.warnings.insert(found.warnings.end(), warnings.begin(), warnings.end());
  }
}

// Tension law of a yarn that was measured; the modulus of compression follows the base card's share of the linear one,
// while a compression law stays as it is.
YarnFile fitted_yarn(const YarnFile& before, const YarnFit& fit) {
  YarnFile yarn = before;
  const double modulus = legible(fit.modulus);
  yarn.tension = decrimping_law(modulus, before.crimp * percent);
  for (auto& piece : yarn.tension) {
    for (auto& coefficient : piece.coefficient) coefficient = legible(coefficient);
  }
  const bool had_share = before.compression_modulus && before.linear_modulus;
  yarn.compression_modulus =
      had_share ? std::optional(legible(*before.compression_modulus / *before.linear_modulus * modulus)) : std::nullopt;
  yarn.linear_modulus = modulus;
  // the stress that the tests reached; beyond, nothing was measured
  yarn.valid_to = legible(std::min(greatest_claim, strain_at_stress(TangentLaw(yarn.tension), fit.greatest_stress())));
  if (yarn.tearing_strain && *yarn.tearing_strain < *yarn.valid_to) yarn.tearing_strain = std::nullopt;
  return yarn;
}

ShearFile fitted_shear(const ShearFit& fit) {
  const ShearCurve& curve = fit.chosen().pooled.curve;
  ShearFile shear;
  shear.valid_to = std::floor(fit.greatest_angle() / degree * 1e3 + 1e-6) / 1e3;
  Polynomial tangent = derivative_of(curve.stress);
  for (auto& coefficient : tangent) coefficient = legible(coefficient);
  shear.tangent = {{0.0, legible(fit.end), tangent}};
  if (curve.start.plateau > 0.0) shear.start = {legible(curve.start.plateau), legible(curve.start.rise)};
  return shear;
}

YarnFile yarn_file(const Identification& found, std::size_t f) {
  const auto& fit = found.yarn[f];
  const YarnFile& before = found.spec.yarn[f];
  YarnFile yarn = fit ? fitted_yarn(before, found.yarns[*fit]) : before;
  if (!found.simulated || !found.simulated->decrimping) return yarn;
  const YarnCard law = with_decrimping(found.card, found.simulated->decrimping->factor).yarn[f];
  yarn.tension = law.tension.pieces();
  for (auto& piece : yarn.tension)
    for (auto& coefficient : piece.coefficient) coefficient = legible(coefficient);
  yarn.valid_to = legible(std::min(greatest_claim, law.valid_to));
  yarn.tearing_strain = legible(std::clamp(law.tearing_strain, *yarn.valid_to, greatest_claim));
  return yarn;
}

std::string shear_text(const Identification& found) {
  const ShearCard& kept = found.spec.base.shear;
  const ShearFit* fit = found.shear();
  ShearFile shear = fit != nullptr ? fitted_shear(*fit)
                                   : ShearFile{kept.tangent.pieces(), kept.start, kept.valid_to_deg, std::nullopt};
  if (kept.tension_coupling > 0.0) shear.tension_coupling = kept.tension_coupling;
  return "\n[shear]\n" + write_keys(shear_keys(), shear, Echo::given);
}

// `back`: the law of the other sense; none: `fit` is that of both.
void put_curve(const BendingFit& fit, const BendingFit* back, bool with_friction, YarnFile& yarn) {
  yarn.bending_out_of_plane = pieces_of(fit.curve, yarn.interval);
  if (back != nullptr) yarn.bending_out_of_plane_back = pieces_of(back->curve, yarn.interval);
  auto friction = fit.friction;
  if (back != nullptr && back->friction)
    friction = friction ? BendingFriction{0.5 * (friction->moment + back->friction->moment),
                                          0.5 * (friction->rise + back->friction->rise)}
                        : *back->friction;
  if (friction && with_friction)
    yarn.bending_friction = {legible(friction->moment * yarn.interval), legible(friction->rise)};
}

// Who of the two directions bends as what was measured. Curves are laws of the yarns, which every kind of element that
// bends takes where the card gives no rigidity; a direction that was not measured keeps the rigidity it had.
void put_bending(const Identification& found, CardParts& parts) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  const auto fit_of = [&](std::size_t f) { return found.bending[f] ? &found.bends[*found.bending[f]] : nullptr; };
  const std::array<const BendingFit*, 2> fits = {fit_of(0), fit_of(1)};
  if (fits[0] == nullptr && fits[1] == nullptr) return;
  const auto needs_laws = [](const BendingFit* fit) {
    return fit != nullptr && (!fit->is_constant() || fit->sense != BentSense::both);
  };
  const bool curves = needs_laws(fits[0]) || needs_laws(fits[1]);
  const auto back_of = [](const BendingFit* fit) { return fit->sense == BentSense::face ? fit + 1 : nullptr; };
  const auto before = parts.bending.rigidity;
  std::array<double, 2> rigidity = {0.0, 0.0};
  for (std::size_t f = 0; f < yarn_families.size(); ++f) {
    YarnFile& yarn = parts.yarn[f];
    const auto& own = yarn.bending_out_of_plane;
    const double of_yarn = own.empty() ? 0.0 : TangentLaw(own).tangent(0.0) / yarn.interval;
    const BendingFit* other = fits[1 - f];
    rigidity[f] = legible(fits[f] != nullptr ? fits[f]->first_stiffness()
                          : before           ? (*before)[f]
                          : of_yarn > 0.0    ? of_yarn
                                             : other->first_stiffness());
    if (!curves) continue;
    if (fits[f] != nullptr || before || own.empty()) yarn.bending_out_of_plane_back.clear();
    if (fits[f] != nullptr && !fits[f]->is_constant())
      put_curve(*fits[f], back_of(fits[f]), found.spec.bending_law.friction, yarn);
    else if (fits[f] != nullptr || before || own.empty())
      yarn.bending_out_of_plane = {{0.0, endless, {legible(rigidity[f] * yarn.interval)}}};
    if (fits[f] != nullptr && fits[f]->is_constant() && back_of(fits[f]) != nullptr)
      yarn.bending_out_of_plane_back = {{0.0, endless, {legible(back_of(fits[f])->rigidity * yarn.interval)}}};
  }
  parts.bending.rigidity = curves ? std::nullopt : std::optional(rigidity);
}

void make_card(Identification& found, const std::string& replaced, const std::string& file) {
  const FitHead& head = found.spec.head;
  std::string source = head.source;
  if (found.spec.has_base)
    source += fmt::format("{}parts not measured are those of {}", source.empty() ? "" : "; ", head.base);
  CardParts parts{{yarn_file(found, 0), yarn_file(found, 1)}, found.spec.bending};
  put_bending(found, parts);
  const bool bends = found.bending[0] || found.bending[1];
  if (!replaced.empty()) {
    const auto said = carry_typed_parts(replaced, file, bends, parts);
    found.warnings.insert(found.warnings.end(), said.begin(), said.end());
    found.replaces_other = !said.empty();
  }
  found.card_text =
      "# Made by weaveform fit. Units: mm, MPa, tex; angles in degrees.\n" +
      write_keys(head_keys(),
                 HeadFile{head.name, source, found.spec.thickness(), found.spec.base.through_thickness_stiffness},
                 Echo::given);
  for (std::size_t f = 0; f < yarn_families.size(); ++f)
    found.card_text +=
        fmt::format("\n[yarn.{}]\n{}", yarn_families[f], write_keys(yarn_keys(), parts.yarn[f], Echo::given));
  found.card_text += shear_text(found);
  if (parts.bending != BendingCard{})
    found.card_text += "\n[bending]\n" + write_keys(bending_keys(), parts.bending, Echo::given);
  // The card's own reader has the last word: ranges, Eq. 11, tangents that turn negative.
  found.card = read_card_text(found.card_text, "card.toml");
}

void assume_bending(Identification& found) {
  if (found.bends.empty()) return;
  const auto assume = [&](std::string sentence) { found.assumptions.push_back(std::move(sentence)); };
  const Card& card = found.card;
  for (std::size_t f = 0; f < yarn_families.size(); ++f)
    if (!found.bending[f])
      assume(fmt::format("no test of bending along the {}: its stiffness is {}", yarn_families[f],
                         found.spec.bending.rigidity || !found.spec.yarn[f].bending_out_of_plane.empty()
                             ? "that of the fit file or of the base card"
                             : "the first of the other direction's"));
  assume(card.yarn[0].bending_in_plane == card.yarn[0].bending_out_of_plane.face()
             ? "bending in the fabric's plane is not measured: that out of the plane"
             : "bending in the fabric's plane is not measured: that of the fit file or of the base card");
  assume(card.bending.twist
             ? fmt::format("twist is not measured: {} N mm, of the fit file or of the base card", *card.bending.twist)
             : std::string("twist is not measured and not given: rotation-free and shell cells need "
                           "'twist' of [bending]"));
  if (std::any_of(found.bends.begin(), found.bends.end(),
                  [](const BendingFit& fit) { return fit.source == BendingSource::cantilever; }))
    assume(
        "hanging strips: the strip is inextensible and bears its own weight alone; the moment follows from its shape");
}

void state_assumptions(Identification& found) {
  const auto assume = [&](std::string sentence) { found.assumptions.push_back(std::move(sentence)); };
  const FitSpec& spec = found.spec;
  for (std::size_t f = 0; f < yarn_families.size(); ++f) {
    if (!found.yarn[f]) {
      assume(fmt::format("no tensile test stands for the {} yarn: its tension law is {}", yarn_families[f],
                         spec.has_base ? "that of the base card " + spec.head.base : "that of the fit file"));
      continue;
    }
    const double crimp = spec.yarn[f].crimp;
    assume(crimp > 0.0
               ? fmt::format("decrimping of the {} yarn is not measured: a e^4 from the crimp ratio {} %, joining the "
                             "line of the straight yarn in value and slope at 4/3 ln(1 + crimp) (Table 2 of the "
                             "paper)",
                             yarn_families[f], crimp)
               : fmt::format("the {} yarn has no crimp: its law is the linear modulus from zero strain on",
                             yarn_families[f]));
    if (!spec.yarn[f].compression_modulus && spec.yarn[f].compression.empty())
      assume(fmt::format("compression of the {} yarn is not measured: 1 % of the linear modulus", yarn_families[f]));
  }
  assume_bending(found);
  if (found.card.bending != BendingCard{} && found.bends.empty())
    assume("no test of bending: [bending] is that of the fit file, of the base card or of the card that was replaced");
  if (found.shear() == nullptr) assume("no test of shear: the shear law is that of the base card " + spec.head.base);
  if (found.shear() != nullptr)
    assume(fmt::format("the shear law is fitted to {:.1f} deg; beyond, its tangent keeps its value there",
                       found.shear()->greatest_angle() / degree));
  if (found.simulated)
    assume(
        "simulated tests: yarns are pinned at their crossings, and their tension is the card's; what else a "
        "measured load holds (slip, friction of yarns under tension) is taken for shear. The law is that of the mesh "
        "it was found on");
  if (found.frame) assume("shear frame: the angle is uniform and equal to the frame's (Eq. 12)");
  if (found.bias)
    assume(
        "bias extension: yarns are inextensible, pinned at their crossings and straight within the three zones; loads "
        "of "
        "slip and of decrimping are taken for shear");
}

double first_rigidity(const Card& card, std::size_t f) {
  if (card.bending.rigidity) return (*card.bending.rigidity)[f];
  return card.yarn[f].bending_out_of_plane.first_stiffness() / card.yarn[f].interval;
}

void compare_bending(Identification& found) {
  constexpr double suspicious = 20.0;  // preforms are that much stiffer than their fabrics; units are wrong by more
  for (std::size_t f = 0; f < yarn_families.size(); ++f) {
    const double before = first_rigidity(found.spec.base, f);
    if (!found.bending[f] || !(before > 0.0)) continue;
    const double ratio = found.bends[*found.bending[f]].first_stiffness() / before;
    if (ratio > suspicious || ratio < 1.0 / suspicious)
      found.warnings.push_back(
          fmt::format("along the {} the first bending stiffness is {:.3g} times the base card's {:.3g} "
                      "N mm; check units and weight",
                      yarn_families[f], ratio, before));
  }
}

void compare_with_base(Identification& found) {
  if (!found.spec.has_base) return;
  compare_bending(found);
  for (std::size_t f = 0; f < yarn_families.size(); ++f) {
    if (!found.yarn[f]) continue;
    const double before = found.spec.base.yarn[f].linear_modulus;
    const double ratio = found.card.yarn[f].linear_modulus / before;
    if (ratio > suspicious_ratio || ratio < 1.0 / suspicious_ratio)
      found.warnings.push_back(
          fmt::format("the {} yarn's modulus is {:.3g} times the base card's {:.0f} MPa; check units "
                      "and section",
                      yarn_families[f], ratio, before));
  }
}

// The closed form's card is what the rounds begin with.
void simulate(Identification& found, const Simulation& simulation) {
  if (!simulation.run)
    throw InputError(
        fmt::format("{}: method = \"simulation\" of [shear] needs somebody to run the simulations, as "
                    "'weaveform fit' does",
                    found.spec.file));
  make_card(found, "", "card.toml");
  found.simulated = fit_simulated(*found.closed_form(), found.spec, found.card, simulation);
  for (const auto& warning : found.simulated->warnings)
    found.warnings.push_back(fmt::format("simulation: {}", warning));
}

}  // namespace

bool Identification::makes_bending(std::size_t fit) const {
  const std::size_t first = bends[fit].sense == BentSense::back ? fit - 1 : fit;
  return bending[0] == first || bending[1] == first;
}

bool Identification::shear_from_frame() const {
  return frame.has_value() && spec.shear.from != ShearSource::bias_extension;
}

const ShearFit* Identification::shear() const {
  return simulated ? &simulated->fit : closed_form();
}

const ShearFit* Identification::closed_form() const {
  if (shear_from_frame()) return &*frame;
  return bias ? &*bias : nullptr;
}

Identification identify(const FitSpec& spec, const std::string& replaced, const std::string& file,
                        const Simulation& simulation) {
  Identification found;
  found.spec = spec;
  fit_yarns(found);
  const auto warn = [&](const char* kind, const std::optional<ShearFit>& fit) {
    if (!fit) return;
    for (const auto& warning : fit->warnings) found.warnings.push_back(fmt::format("{}: {}", kind, warning));
  };
  if (!spec.shear_frame.empty()) found.frame = fit_shear_frames(spec);
  if (!spec.bias_extension.empty()) found.bias = fit_bias_extensions(spec);
  warn("shear frame", found.frame);
  warn("bias extension", found.bias);
  found.bends = fit_bending(spec);
  for (std::size_t f = 0; f < yarn_families.size(); ++f) found.bending[f] = bending_of(found.bends, spec, f);
  for (const auto& fit : found.bends)
    for (const auto& warning : fit.warnings) found.warnings.push_back(fmt::format("{}: {}", fit.name(), warning));
  if (spec.shear.method == ShearMethod::simulation) simulate(found, simulation);
  make_card(found, replaced, file);
  compare_with_base(found);
  state_assumptions(found);
  return found;
}

}  // namespace weaveform::identify
