// Material cards: a fabric as its tests describe it (Tables 1-3 and Eq. 11 of the paper). Units mm, N, MPa, tonne.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "mesher/material/law.hpp"

namespace weaveform {

struct YarnCard {
  double linear_density = 0.0;       // tonne/mm (1 tex = 1e-12 tonne/mm... files give tex)
  double section = 0.0;              // mm^2; given, or Eq. 11 from linear density, fibre volume fraction and densities
  double interval = 0.0;             // mm; spacing between neighbouring yarns of this family
  double crimp = 0.0;                // 1; (yarn length - fabric length) / fabric length
  TangentLaw tension;                // MPa against true strain, e >= 0 (Table 2)
  double linear_modulus = 0.0;       // MPa; tangent of the last piece
  double compression_modulus = 0.0;  // MPa; for e < 0; default 1 % of the linear modulus (ours: the paper gives none)
};

// Friction-like start of a shear curve, added to the polynomial: stress = plateau * g / (g + rise), g = |log shear strain|.
struct ShearStart {
  double plateau = 0.0;  // MPa
  double rise = 0.0;     // 1
};

struct ShearCard {
  TangentLaw tangent;       // MPa against logarithmic engineering shear strain >= 0 (Table 3); odd in the strain's sign
  ShearStart start;         // absent when plateau == 0
  double valid_to_deg = 60;  // deg; the shear angle up to which the law is meant to hold; the law is checked up to here
};

struct Card {
  std::string name;
  std::string source;          // where its numbers come from
  double thickness = 0.0;      // mm; after consolidation (Table 1)
  std::array<YarnCard, 2> yarn;  // [0] warp, [1] weft
  ShearCard shear;

  // tonne/mm^2: sum over both families of linear density / interval
  [[nodiscard]] double area_density() const;
};

// Total shear stress of the card (MPa) at a signed logarithmic shear strain, and the stored energy per reference volume
// w(gamma) = integral of stress d(sin gamma), sin gamma = tanh(strain) (design section 3), by quadrature to 1e-12.
[[nodiscard]] double shear_stress(const ShearCard& card, double log_shear_strain);
[[nodiscard]] double shear_tangent(const ShearCard& card, double log_shear_strain);

// Card by built-in name ("twintex-pw", "twintex-tw") or by file, a relative path being looked up beside `relative_to`.
// Throws InputError (every complaint, file:line:column) or FileError. Complaints include a tangent that turns negative in
// the range its card claims.
[[nodiscard]] Card load_card(const std::string& name_or_path, const std::filesystem::path& relative_to = {});
[[nodiscard]] Card read_card_text(const std::string& text, const std::string& name);
[[nodiscard]] std::string card_to_toml(const Card& card);
[[nodiscard]] std::vector<std::string> builtin_card_names();

}  // namespace weaveform
