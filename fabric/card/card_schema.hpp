// A card file as it stands on paper, in the units of the file, and its key table: one row per key.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/keys/key_table.hpp"
#include "fabric/card/card.hpp"

namespace weaveform {

struct HeadFile {
  std::string name;
  std::string source;
  double thickness = 0.0;                             // mm
  std::optional<double> through_thickness_stiffness;  // N/mm^3
};

struct YarnFile {
  double linear_density = 0.0;                                       // tex
  std::optional<double> section;                                     // mm^2
  std::optional<double> fibre_volume_fraction;                       // 1
  std::optional<double> fibre_density;                               // g/cm^3
  std::optional<double> matrix_density;                              // g/cm^3
  double interval = 0.0;                                             // mm
  double crimp = 0.0;                                                // %
  std::vector<TangentPiece> tension;                                 // MPa
  std::optional<double> linear_modulus;                              // MPa
  std::optional<double> valid_to, tearing_strain;                    // 1
  std::optional<double> compression_modulus;                         // MPa
  std::vector<TangentPiece> compression;                             // MPa
  std::vector<TangentPiece> bending_in_plane, bending_out_of_plane;  // N mm^2
  std::vector<TangentPiece> bending_out_of_plane_back;               // N mm^2; none: as with the face outwards
  BendingFriction bending_friction;                                  // N mm, 1/mm
};

struct ShearFile {
  std::vector<TangentPiece> tangent;           // MPa
  ShearStart start;                            // MPa, 1
  double valid_to = ShearCard{}.valid_to_deg;  // deg
  std::optional<double> tension_coupling;      // mm/N
};

// BendingCard itself is the file's [bending].

[[nodiscard]] const std::vector<Key<HeadFile>>& head_keys();
[[nodiscard]] const std::vector<Key<YarnFile>>& yarn_keys();
[[nodiscard]] const std::vector<Key<ShearFile>>& shear_keys();
[[nodiscard]] const std::vector<Key<BendingCard>>& bending_keys();

// Values of a card's own types, for the key table (see key_value.hpp).
void read_value(const toml::node& node, const KeyRule& rule, std::vector<TangentPiece>& value, Complaints& complaints);
void read_value(const toml::node& node, const KeyRule& rule, ShearStart& value, Complaints& complaints);
void read_value(const toml::node& node, const KeyRule& rule, BendingFriction& value, Complaints& complaints);
[[nodiscard]] TomlText toml_text(const std::vector<TangentPiece>& value);
[[nodiscard]] TomlText toml_text(const ShearStart& value);
[[nodiscard]] TomlText toml_text(const BendingFriction& value);
[[nodiscard]] std::string type_words(const std::vector<TangentPiece>&);
[[nodiscard]] std::string type_words(const ShearStart&);
[[nodiscard]] std::string type_words(const BendingFriction&);

}  // namespace weaveform
