#include "fabric/card/card_schema.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace weaveform {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct PieceFile {
  double from = 0.0;         // 1
  std::optional<double> to;  // 1; none: no end
  std::vector<double> coefficients;
};

const std::vector<Key<PieceFile>> piece_keys = {
    key<&PieceFile::from>({.name = "from", .unit = "1", .limits = at_least(0), .required = true}),
    key<&PieceFile::to>({.name = "to", .unit = "1", .limits = above(0)}),
    key<&PieceFile::coefficients>({.name = "coefficients", .unit = "MPa", .required = true}),
};

const std::vector<Key<ShearStart>> start_keys = {
    key<&ShearStart::plateau>({.name = "plateau", .unit = "MPa", .limits = at_least(0), .required = true}),
    key<&ShearStart::rise>({.name = "rise", .unit = "1", .limits = above(0), .required = true}),
};

const std::vector<Key<BendingFriction>> friction_keys = {
    key<&BendingFriction::moment>({.name = "moment", .unit = "N mm", .limits = between(0, 1e6), .required = true}),
    key<&BendingFriction::rise>({.name = "rise", .unit = "1/mm", .limits = above(0, 10), .required = true}),
};

// Each piece begins where the one before ended, the first at zero strain; only the last may have no end.
void check_piece(const toml::node& node, const std::vector<TangentPiece>& before, const TangentPiece& piece,
                 Complaints& complaints) {
  const double begin = before.empty() ? 0.0 : before.back().to;
  if (!std::isfinite(begin)) {
    complaints.add(node, "the piece before has no 'to'; only the last piece may leave it out");
  } else if (piece.from != begin) {
    complaints.add(node, fmt::format("the piece begins at {}; it must begin at {}, where {}", piece.from, begin,
                                     before.empty() ? "strain begins" : "the piece before ends"));
  } else if (!(piece.from < piece.to)) {
    complaints.add(node, fmt::format("the piece ends at {}; it must end above its beginning {}", piece.to, piece.from));
  } else if (piece.coefficient.empty()) {
    complaints.add(node, "the piece has no coefficients; give at least the constant one");
  }
}

std::string piece_text(const TangentPiece& piece) {
  const std::string end = std::isfinite(piece.to) ? fmt::format("to = {}, ", *toml_text(piece.to)) : "";
  return fmt::format("  {{ from = {}, {}coefficients = {} }},\n", *toml_text(piece.from), end,
                     *toml_text(piece.coefficient));
}

}  // namespace

void read_value(const toml::node& node, const KeyRule& rule, std::vector<TangentPiece>& value, Complaints& complaints) {
  const auto* list = node.as_array();
  if (list == nullptr || list->empty()) return complain_type(node, rule, type_words(value), complaints);
  std::vector<TangentPiece> read;
  for (const auto& item : *list) {
    const auto* table = item.as_table();
    if (table == nullptr) return complain_type(item, rule, type_words(value), complaints);
    PieceFile file;
    const std::size_t before = complaints.count();
    read_keys(*table, "a piece of '" + rule.name + "'", piece_keys, file, complaints);
    require_keys(*table, "a piece of '" + rule.name + "'", piece_keys, complaints);
    if (complaints.count() > before) return;  // the pieces after it cannot be judged
    TangentPiece piece{file.from, file.to.value_or(infinity), file.coefficients};
    check_piece(item, read, piece, complaints);
    if (complaints.count() > before) return;
    read.push_back(std::move(piece));
  }
  value = std::move(read);
}

void read_value(const toml::node& node, const KeyRule& rule, ShearStart& value, Complaints& complaints) {
  const auto* table = node.as_table();
  if (table == nullptr) return complain_type(node, rule, type_words(value), complaints);
  read_keys(*table, "'" + rule.name + "'", start_keys, value, complaints);
  require_keys(*table, "'" + rule.name + "'", start_keys, complaints);
}

void read_value(const toml::node& node, const KeyRule& rule, BendingFriction& value, Complaints& complaints) {
  const auto* table = node.as_table();
  if (table == nullptr) return complain_type(node, rule, type_words(value), complaints);
  read_keys(*table, "'" + rule.name + "'", friction_keys, value, complaints);
  require_keys(*table, "'" + rule.name + "'", friction_keys, complaints);
}

TomlText toml_text(const std::vector<TangentPiece>& value) {
  if (value.empty()) return std::nullopt;
  std::string text = "[\n";
  for (const auto& piece : value) text += piece_text(piece);
  return text + "]";
}

TomlText toml_text(const ShearStart& value) {
  if (value.plateau == 0.0) return std::nullopt;
  return fmt::format("{{ plateau = {}, rise = {} }}", *toml_text(value.plateau), *toml_text(value.rise));
}

TomlText toml_text(const BendingFriction& value) {
  if (value.moment == 0.0) return std::nullopt;
  return fmt::format("{{ moment = {}, rise = {} }}", *toml_text(value.moment), *toml_text(value.rise));
}

std::string type_words(const std::vector<TangentPiece>&) {
  return "a list of pieces { from = STRAIN, to = STRAIN, coefficients = [c0, c1, ...] }";
}
std::string type_words(const ShearStart&) {
  return "{ plateau = MPA, rise = STRAIN }";
}
std::string type_words(const BendingFriction&) {
  return "{ moment = N_MM, rise = PER_MM }";
}

const std::vector<Key<HeadFile>>& head_keys() {
  static const std::vector<Key<HeadFile>> keys = {
      key<&HeadFile::name>(
          {.name = "name", .required = true, .identifier = true, .doc = "names the fabric in reports"}),
      key<&HeadFile::source>({.name = "source", .doc = "where the numbers come from"}),
      key<&HeadFile::thickness>({.name = "thickness",
                                 .unit = "mm",
                                 .limits = above(0),
                                 .required = true,
                                 .doc = "of the fabric, after consolidation; shear stress is force per width over it"}),
      key<&HeadFile::through_thickness_stiffness>(
          {.name = "through_thickness_stiffness",
           .unit = "N/mm^3",
           .limits = above(0),
           .doc = "pressure over the way that a rigid face sinks into the fabric, from its middle plane: what rigid "
                  "tools meet, and what spreads the moment that bending has at the edge of a clamp over a length of "
                  "(4 D/k)^(1/4), D the rigidity. Auto: that of `analysis.contact_stiffness`, at most 5 N/mm^3 (our "
                  "choice: docs/contact.md)"}),
  };
  return keys;
}

const std::vector<Key<YarnFile>>& yarn_keys() {
  static const std::vector<Key<YarnFile>> keys = {
      key<&YarnFile::linear_density>({.name = "linear_density",
                                      .unit = "tex",
                                      .limits = above(0, 1e7),
                                      .required = true,
                                      .doc = "mass per length, 1 tex = 1 g/km"}),
      key<&YarnFile::section>({.name = "section",
                               .unit = "mm^2",
                               .limits = above(0),
                               .doc = "cross-section without voids; auto: Eq. 11 from the next three; given with them, "
                                      "both must agree to 1 %"}),
      key<&YarnFile::fibre_volume_fraction>({.name = "fibre_volume_fraction",
                                             .unit = "1",
                                             .limits = above(0, 1),
                                             .doc = "share of the fibres in the section, for Eq. 11"}),
      key<&YarnFile::fibre_density>(
          {.name = "fibre_density", .unit = "g/cm^3", .limits = above(0, 30), .doc = "for Eq. 11"}),
      key<&YarnFile::matrix_density>(
          {.name = "matrix_density", .unit = "g/cm^3", .limits = between(0, 30), .doc = "for Eq. 11; 0 for dry yarns"}),
      key<&YarnFile::interval>({.name = "interval",
                                .unit = "mm",
                                .limits = above(0),
                                .required = true,
                                .doc = "spacing between neighbouring yarns of this family"}),
      key<&YarnFile::crimp>({.name = "crimp",
                             .unit = "%",
                             .limits = between(0, 100),
                             .doc = "(yarn length - fabric length) / fabric length; gives the slack of "
                                    "`model.yarn_law = \"slack\"`, otherwise for information: the tension law already "
                                    "holds the decrimping"}),
      key<&YarnFile::tension>({.name = "tension",
                               .unit = "MPa",
                               .required = true,
                               .doc =
                                   "tangent modulus against true strain in adjoining pieces, each the polynomial c0 + "
                                   "c1 e + c2 e^2 + ... for from <= e < to; a last piece without `to` has no end"}),
      key<&YarnFile::linear_modulus>({.name = "linear_modulus",
                                      .unit = "MPa",
                                      .limits = above(0),
                                      .doc =
                                          "of the straightened yarn; auto: tangent of the last piece, at its end or, "
                                          "without one, where it begins"}),
      key<&YarnFile::valid_to>(
          {.name = "valid_to",
           .unit = "1",
           .limits = above(0, 0.5),
           .doc =
               "true strain up to which `tension` is meant to hold; yarns that bear more than it gives there are a "
               "warning. Auto: where the stress is 2 % of the linear modulus, for glass and carbon break at 2 to 4 % "
               "of elastic strain (our choice: the paper's Table 2 has no end, and the strains its tests reached are "
               "not stated). "
               "`fit` writes what its tests reached"}),
      key<&YarnFile::tearing_strain>(
          {.name = "tearing_strain",
           .unit = "1",
           .limits = above(0, 0.5),
           .doc = "true strain at which the yarn is torn; one that bears more than `tension` gives there ends the run. "
                  "Auto: where the stress is 4 % of the linear modulus, or `valid_to` if that is more"}),
      key<&YarnFile::compression_modulus>({.name = "compression_modulus",
                                           .unit = "MPa",
                                           .limits = at_least(0),
                                           .doc =
                                               "for negative strain; auto: 1 % of the linear modulus (our choice, the "
                                               "paper gives none)"}),
      key<&YarnFile::compression>({.name = "compression",
                                   .unit = "MPa",
                                   .doc = "instead of compression_modulus: tangent modulus against the size of "
                                          "negative true strain, pieces as for `tension`; of trusses and of seatbelts' "
                                          "compression-only partners"}),
      key<&YarnFile::bending_out_of_plane>(
          {.name = "bending_out_of_plane",
           .unit = "N mm^2",
           .doc =
               "flexural stiffness of one yarn out of the fabric's plane, dM/dkappa against its curvature kappa "
               "(1/mm), pieces as for `tension` with `from` and `to` in 1/mm, at most 255 of them and of degree 5; a "
               "constant is one piece; left out: unknown, and a model that bends must say it"}),
      key<&YarnFile::bending_out_of_plane_back>(
          {.name = "bending_out_of_plane_back",
           .unit = "N mm^2",
           .doc = "the same with the fabric's back bent outwards (the back is the convex side), where that differs; "
                  "`bending_out_of_plane` is then the law with the face outwards. `fabric.face` of a scene says which "
                  "way the face looks. Left out: alike in both senses"}),
      key<&YarnFile::bending_in_plane>({.name = "bending_in_plane",
                                        .unit = "N mm^2",
                                        .doc =
                                            "the same in the fabric's plane; left out: that out of the plane, with the "
                                            "face outwards"}),
      key<&YarnFile::bending_friction>(
          {.name = "bending_friction",
           .doc = "friction in bending (Dahl), of one yarn out of the fabric's plane and in it: a moment beside the "
                  "law's that tends to `moment` (N mm), against the curvature's change, over curvatures of the order "
                  "of `rise` (1/mm), whatever element bends; a loop is 2 `moment` wide. Left out: none"}),
  };
  return keys;
}

const std::vector<Key<ShearFile>>& shear_keys() {
  static const std::vector<Key<ShearFile>> keys = {
      key<&ShearFile::tangent>(
          {.name = "tangent",
           .unit = "MPa",
           .required = true,
           .doc = "tangent shear modulus against logarithmic shear strain, pieces as for `tension`"}),
      key<&ShearFile::start>({.name = "start",
                              .doc = "friction-like start of the curve, added to the integral of `tangent`: stress = "
                                     "plateau * g / (g + rise)"}),
      key<&ShearFile::valid_to>({.name = "valid_to",
                                 .unit = "deg",
                                 .limits = above(0, 89),
                                 .doc = "shear angle up to which the law is meant to hold; its tangent must not turn "
                                        "negative below"}),
      key<&ShearFile::tension_coupling>(
          {.name = "tension_coupling",
           .unit = "mm/N",
           .limits = between(0, 100),
           .doc =
               "a in stress (1 + a T): by how much of itself the shear stress grows with each N/mm of tension T, per "
               "width and the mean of warp and weft. It has an energy, so that sheared fabric shortens its yarns by "
               "a/2 thickness times the shear energy per volume (docs/theory.md). Auto: none"}),
  };
  return keys;
}

const std::vector<Key<BendingCard>>& bending_keys() {
  static const std::vector<Key<BendingCard>> keys = {
      key<&BendingCard::rigidity>({.name = "rigidity",
                                   .unit = "N mm",
                                   .limits = at_least(0),
                                   .one_for_all = true,
                                   .doc = "moment per width over curvature of the fabric along warp and weft, as "
                                          "Peirce's cantilever gives it; left out: that of the yarns"}),
      key<&BendingCard::twist>({.name = "twist",
                                .unit = "N mm",
                                .limits = at_least(0),
                                .doc = "twisting stiffness D_66: a corner force P twists a plate by P / (4 D_66)"}),
      key<&BendingCard::transverse_shear>(
          {.name = "transverse_shear",
           .unit = "N/mm",
           .limits = above(0),
           .doc = "force per width over transverse shear angle, for the cells of kind shell"}),
  };
  return keys;
}

std::vector<KeyInfo> card_keys() {
  std::vector<KeyInfo> keys = describe_keys("", head_keys());
  for (const auto& info : describe_keys("yarn", yarn_keys())) keys.push_back(info);
  for (const auto& info : describe_keys("shear", shear_keys())) keys.push_back(info);
  for (const auto& info : describe_keys("bending", bending_keys())) keys.push_back(info);
  return keys;
}

}  // namespace weaveform
