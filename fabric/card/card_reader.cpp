// Reads, checks and writes card files; the key table is in card_schema.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/keys/nearest_name.hpp"
#include "core/keys/toml_document.hpp"
#include "core/vector/angle.hpp"
#include "fabric/card/builtin_cards.hpp"
#include "fabric/card/card.hpp"
#include "fabric/card/card_schema.hpp"

namespace weaveform {
namespace {

constexpr double tex_per_tonne_per_mm = 1e12;        // 1 tex = 1 g/km = 1e-6 tonne / 1e6 mm
constexpr double g_per_cm3_per_tonne_per_mm3 = 1e9;  // 1 g/cm^3 = 1e-6 tonne / 1e3 mm^3
constexpr double percent = 100.0;
constexpr double compression_share = 0.01;  // of the linear modulus; ours, the paper gives none
constexpr double greatest_tearing = 0.5;    // 1; where a run ends whatever the card says (reach.hpp)
constexpr double section_agreement = 0.01;  // relative, between a given section and Eq. 11

// The table of one yarn family and the common [yarn] it falls back on; a key of the family wins.
struct YarnTables {
  const toml::table* own = nullptr;
  const toml::table* common = nullptr;
  [[nodiscard]] bool has(const char* key) const { return own->contains(key) || common->contains(key); }
  [[nodiscard]] const toml::node& place(const char* key) const {
    if (const auto* node = own->get(key)) return *node;
    if (const auto* node = common->get(key)) return *node;
    return *own;
  }
};

const toml::table* table_of(const toml::table& parent, const std::string& name, const std::string& title,
                            Complaints& complaints) {
  const toml::node* node = parent.get(name);
  if (node == nullptr) return nullptr;
  if (!node->is_table()) complaints.add(*node, fmt::format("'{}' must be a table; begin it with [{}]", name, title));
  return node->as_table();
}

// Eq. 11 when the section is not given; a complaint when both are given and disagree, or neither can be had.
double section_of(const YarnFile& file, const YarnTables& tables, const std::string& yarn_name,
                  Complaints& complaints) {
  const bool all = file.fibre_volume_fraction && file.fibre_density && file.matrix_density;
  if (!all) {
    // A section of the wrong type or range was complained about where it was read.
    const bool left_out = !tables.has("section") || tables.place("section").value<std::string>() == "auto";
    if (left_out) {
      complaints.add(*tables.own, fmt::format("the {} lacks 'section' (mm^2); add it, or fibre_volume_fraction, "
                                              "fibre_density and matrix_density for Eq. 11",
                                              yarn_name));
    }
    return file.section.value_or(0.0);
  }
  const double eq11 = section_from_densities(file.linear_density / tex_per_tonne_per_mm, *file.fibre_volume_fraction,
                                             *file.fibre_density / g_per_cm3_per_tonne_per_mm3,
                                             *file.matrix_density / g_per_cm3_per_tonne_per_mm3);
  const double section = file.section.value_or(eq11);
  if (file.linear_density > 0.0 && std::abs(section / eq11 - 1.0) > section_agreement) {
    complaints.add(tables.place("section"),
                   fmt::format("section {} mm^2 of the {} differs by {:.1f} % from {:.4g} mm^2 of Eq. 11; correct one "
                               "of them or leave one out",
                               section, yarn_name, percent * (section / eq11 - 1.0), eq11));
  }
  return section;
}

// Laws are checked a tenth past their last finite strain, or to 10 % when they have none.
void check_law(const TangentLaw& law, const char* key, const YarnTables& tables, const std::string& yarn_name,
               Complaints& complaints) {
  double last = 0.0;
  for (const auto& piece : law.pieces()) last = std::isfinite(piece.to) ? piece.to : piece.from;
  const std::string negative = law.negative_range(0.0, last > 0.0 ? 1.1 * last : 0.1);
  if (negative.empty()) return;
  complaints.add(tables.place(key),
                 fmt::format("{} tangent of the {} turns negative, {}; a yarn must not soften, change the coefficients "
                             "or the pieces",
                             key, yarn_name, negative));
}

double last_tangent(const TangentLaw& law) {
  const TangentPiece& last = law.pieces().back();
  return law.tangent(std::isfinite(last.to) ? last.to : last.from);
}

// Flexural stiffness must not be negative up to a fold: a curvature of a tenth of the yarn's interval as radius.
TangentLaw flexure_of(const std::vector<TangentPiece>& pieces, const char* key, const YarnFile& file,
                      const YarnTables& tables, const std::string& yarn_name, Complaints& complaints) {
  if (pieces.empty()) return {};
  TangentLaw law(pieces);
  const std::string negative = law.negative_range(0.0, 10.0 / std::max(file.interval, 1e-9));
  if (!negative.empty())
    complaints.add(tables.place(key), fmt::format("{} of the {} turns negative, {}; change the coefficients or the "
                                                  "pieces",
                                                  key, yarn_name, negative));
  return law;
}

BendingLaw bending_of(const YarnFile& file, const YarnTables& tables, const std::string& yarn_name,
                      Complaints& complaints) {
  const TangentLaw face =
      flexure_of(file.bending_out_of_plane, "bending_out_of_plane", file, tables, yarn_name, complaints);
  if (file.bending_out_of_plane_back.empty()) return face;
  if (file.bending_out_of_plane.empty())
    complaints.add(tables.place("bending_out_of_plane_back"),
                   fmt::format("the {} has 'bending_out_of_plane_back' alone; add 'bending_out_of_plane', the law with "
                               "the face outwards, or give that alone, for both senses",
                               yarn_name));
  return {face,
          flexure_of(file.bending_out_of_plane_back, "bending_out_of_plane_back", file, tables, yarn_name, complaints)};
}

// What the card says of how far its yarns can be pulled, or what fibres bear (card.hpp).
void limit_tension(const YarnFile& file, const YarnTables& tables, const std::string& yarn_name, YarnCard& yarn,
                   Complaints& complaints) {
  const auto strain_at = [&](double share) {
    return std::min(greatest_tearing, strain_at_stress(yarn.tension, share * yarn.linear_modulus));
  };
  const double torn = file.tearing_strain.value_or(greatest_tearing);
  yarn.valid_to = file.valid_to.value_or(std::min(torn, strain_at(valid_share)));
  yarn.tearing_strain = file.tearing_strain.value_or(std::max(yarn.valid_to, strain_at(tearing_share)));
  if (yarn.tearing_strain < yarn.valid_to)
    complaints.add(tables.place("tearing_strain"),
                   fmt::format("the {} tears at a strain of {}, below {}, to which its tension is meant to hold; raise "
                               "'tearing_strain' or lower 'valid_to'",
                               yarn_name, yarn.tearing_strain, yarn.valid_to));
}

YarnCard yarn_of(const YarnFile& file, const YarnTables& tables, const std::string& yarn_name, Complaints& complaints) {
  YarnCard yarn;
  yarn.linear_density = file.linear_density / tex_per_tonne_per_mm;
  yarn.interval = file.interval;
  yarn.crimp = file.crimp / percent;
  yarn.section = section_of(file, tables, yarn_name, complaints);
  if (file.tension.empty()) return yarn;  // complained about where it was read
  yarn.tension = TangentLaw(file.tension);
  check_law(yarn.tension, "tension", tables, yarn_name, complaints);
  yarn.linear_modulus = file.linear_modulus.value_or(last_tangent(yarn.tension));
  limit_tension(file, tables, yarn_name, yarn, complaints);
  yarn.compression_modulus = file.compression_modulus.value_or(compression_share * yarn.linear_modulus);
  if (!file.compression.empty()) {
    yarn.compression = TangentLaw(file.compression);
    check_law(yarn.compression, "compression", tables, yarn_name, complaints);
    if (file.compression_modulus) {
      complaints.add(tables.place("compression"),
                     fmt::format("the {} has both 'compression_modulus' and 'compression'; keep one", yarn_name));
    }
    yarn.compression_modulus = yarn.compression.tangent(0.0);
  }
  yarn.bending_out_of_plane = bending_of(file, tables, yarn_name, complaints);
  yarn.bending_in_plane = flexure_of(file.bending_in_plane, "bending_in_plane", file, tables, yarn_name, complaints);
  yarn.bending_friction = file.bending_friction;
  if (file.bending_in_plane.empty()) yarn.bending_in_plane = yarn.bending_out_of_plane.face();
  if (!(yarn.linear_modulus > 0.0)) {
    complaints.add(tables.place("tension"),
                   fmt::format("the {}'s last piece has tangent {} MPa; it must be > 0, or give "
                               "'linear_modulus'",
                               yarn_name, yarn.linear_modulus));
  }
  return yarn;
}

// The families have tables of their own, [yarn.warp] and [yarn.weft], which [yarn] completes; [yarn] alone serves both.
void read_yarns(const toml::table& root, Card& card, Complaints& complaints) {
  const toml::table* common = table_of(root, "yarn", "yarn", complaints);
  if (common == nullptr) {
    if (!root.contains("yarn")) complaints.add(root, "the card lacks [yarn], or [yarn.warp] and [yarn.weft]; add them");
    return;
  }
  YarnFile shared;
  read_keys(*common, "[yarn]", yarn_keys(), shared, complaints, yarn_families);
  for (std::size_t f = 0; f < yarn_families.size(); ++f) {
    const std::string title = "yarn." + yarn_families[f];
    const toml::table* own = table_of(*common, yarn_families[f], title, complaints);
    YarnFile file = shared;
    if (own != nullptr) {
      // either of the two replaces what the common yarn says of compression
      if (own->contains("compression")) file.compression_modulus.reset();
      if (own->contains("compression_modulus")) file.compression.clear();
      // a law of its own is one for both senses, unless it has the other as well
      if (own->contains("bending_out_of_plane")) file.bending_out_of_plane_back.clear();
      read_keys(*own, "[" + title + "]", yarn_keys(), file, complaints);
    }
    const YarnTables tables{own != nullptr ? own : common, common};
    // A family without a table of its own complains in the words of the common yarn, so that both say the same, once.
    const std::string yarn = own != nullptr ? yarn_families[f] + " yarn" : "yarn";
    require_keys(*tables.own, own != nullptr ? "[" + title + "]" : "[yarn]", yarn_keys(), complaints, common);
    card.yarn[f] = yarn_of(file, tables, yarn, complaints);
  }
}

// The tangent with its start, times (g + rise)^2 > 0, is a polynomial again: same sign, and its intervals can be had
// exactly.
TangentLaw with_start(const std::vector<TangentPiece>& pieces, const ShearStart& start) {
  if (start.plateau == 0.0) return TangentLaw(pieces);
  const Polynomial square = {start.rise * start.rise, 2.0 * start.rise, 1.0};
  std::vector<TangentPiece> scaled = pieces;
  for (auto& piece : scaled) {
    piece.coefficient = sum_of(product_of(piece.coefficient, square), {start.plateau * start.rise});
  }
  return TangentLaw(scaled);
}

void check_shear(const ShearCard& shear, const std::vector<TangentPiece>& pieces, const toml::node& place,
                 Complaints& complaints) {
  const double limit = log_shear_strain(shear.valid_to_deg * degree);
  const auto angle = [](double strain) { return std::asin(std::tanh(strain)) / degree; };
  for (const auto& [from, to] : with_start(pieces, shear.start).negative_intervals(0.0, limit)) {
    complaints.add(place,
                   fmt::format("shear tangent is negative for strain {:.4g} to {:.4g} ({:.1f} to {:.1f} deg), where "
                               "the card claims to hold to {} deg; change the coefficients, add a 'start' or lower "
                               "'valid_to'",
                               from, to, angle(from), angle(to), shear.valid_to_deg));
  }
}

void read_shear(const toml::table& root, Card& card, Complaints& complaints) {
  const toml::table* table = table_of(root, "shear", "shear", complaints);
  if (table == nullptr) {
    if (!root.contains("shear")) complaints.add(root, "the card lacks [shear]; add it with its 'tangent'");
    return;
  }
  ShearFile file;
  read_keys(*table, "[shear]", shear_keys(), file, complaints);
  require_keys(*table, "[shear]", shear_keys(), complaints);
  if (file.tangent.empty()) return;
  card.shear = {TangentLaw(file.tangent), file.start, file.valid_to, file.tension_coupling.value_or(0.0)};
  check_shear(card.shear, file.tangent, *table->get("tangent"), complaints);
}

void read_bending(const toml::table& root, Card& card, Complaints& complaints) {
  const toml::table* table = table_of(root, "bending", "bending", complaints);
  if (table != nullptr) read_keys(*table, "[bending]", bending_keys(), card.bending, complaints);
}

// The number x in the file's unit whose reading, x / factor, gives back `value` to the bit; the shortest such.
double in_file_unit(double value, double factor) {
  for (const int digits : {15, 16, 17}) {
    const double rounded = std::stod(fmt::format("{:.{}g}", value * factor, digits));
    if (rounded / factor == value) return rounded;
  }
  const double product = value * factor;
  for (const double side : {0.0, HUGE_VAL}) {
    const double neighbour = std::nextafter(product, side);
    if (neighbour / factor == value) return neighbour;
  }
  return product;
}

YarnFile file_of(const YarnCard& yarn) {
  YarnFile file;
  file.linear_density = in_file_unit(yarn.linear_density, tex_per_tonne_per_mm);
  file.section = yarn.section;
  file.interval = yarn.interval;
  file.crimp = in_file_unit(yarn.crimp, percent);
  file.tension = yarn.tension.pieces();
  file.linear_modulus = yarn.linear_modulus;
  file.valid_to = yarn.valid_to;
  file.tearing_strain = yarn.tearing_strain;
  file.compression = yarn.compression.pieces();
  if (file.compression.empty()) file.compression_modulus = yarn.compression_modulus;
  file.bending_out_of_plane = yarn.bending_out_of_plane.face().pieces();
  if (!yarn.bending_out_of_plane.is_odd()) file.bending_out_of_plane_back = yarn.bending_out_of_plane.back().pieces();
  file.bending_in_plane = yarn.bending_in_plane.pieces();
  file.bending_friction = yarn.bending_friction;
  return file;
}

}  // namespace

Card read_card_text(const std::string& text, const std::string& name) {
  Complaints complaints(name);
  const toml::table root = parse_toml(text, name);
  HeadFile head;
  read_keys(root, "a card", head_keys(), head, complaints, {"yarn", "shear", "bending"});
  require_keys(root, "the card", head_keys(), complaints);
  Card card{.name = head.name,
            .source = head.source,
            .thickness = head.thickness,
            .through_thickness_stiffness = head.through_thickness_stiffness,
            .yarn = {},
            .shear = {},
            .bending = {}};
  read_yarns(root, card, complaints);
  read_shear(root, card, complaints);
  read_bending(root, card, complaints);
  complaints.throw_if_any();
  return card;
}

std::string card_to_toml(const Card& card) {
  std::string text = write_keys(
      head_keys(), HeadFile{card.name, card.source, card.thickness, card.through_thickness_stiffness}, Echo::given);
  for (std::size_t f = 0; f < yarn_families.size(); ++f) {
    text += "\n[yarn." + yarn_families[f] + "]\n" + write_keys(yarn_keys(), file_of(card.yarn[f]), Echo::given);
  }
  ShearFile shear{card.shear.tangent.pieces(), card.shear.start, card.shear.valid_to_deg, std::nullopt};
  if (card.shear.tension_coupling > 0.0) shear.tension_coupling = card.shear.tension_coupling;
  text += "\n[shear]\n" + write_keys(shear_keys(), shear, Echo::given);
  if (card.bending == BendingCard{}) return text;
  return text + "\n[bending]\n" + write_keys(bending_keys(), card.bending, Echo::given);
}

std::string card_reference_markdown() {
  const auto section = [](const char* title, const char* doc, const std::vector<KeyInfo>& keys) {
    return fmt::format("\n## {}\n\n{}\n\n{}", title, doc, markdown_table(keys));
  };
  return "# Material cards\n\n"
         "Generated from the key table in `fabric/card/card_schema.cpp`. A card is a TOML file; the built-in ones "
         "are in "
         "`fabric/cards`.\n" +
         section("The fabric", "Before the first table of the file.", describe_keys("", head_keys())) +
         section("`[yarn]`, `[yarn.warp]`, `[yarn.weft]`",
                 "Keys in `[yarn]` serve both families; those in `[yarn.warp]` and `[yarn.weft]` win.",
                 describe_keys("yarn", yarn_keys())) +
         section("`[shear]`", "In-plane shear.", describe_keys("shear", shear_keys())) +
         section("`[bending]`", "Bending of the fabric as a sheet. May be left out.",
                 describe_keys("bending", bending_keys()));
}

}  // namespace weaveform
