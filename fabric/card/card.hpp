// Material cards: a fabric as its tests describe it (Tables 1-3 and Eq. 11 of the paper). Units mm, N, MPa, tonne.
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/keys/key_info.hpp"
#include "fabric/card/yarn_section.hpp"
#include "fabric/law/bending_law.hpp"
#include "fabric/law/shear_law.hpp"
#include "fabric/law/tangent_law.hpp"

namespace weaveform {

// In the order of every array of two: what a yarn of family f is called.
inline const std::vector<std::string> yarn_families = {"warp", "weft"};

// Friction in bending (Dahl 1968): a moment beside the law's that tends to `moment`, against the curvature's change, over
// curvatures of the order of `rise`; after a reversal it is moment (1 - 2 exp(-|change|/rise)). Zero moment: none.
struct BendingFriction {
  double moment = 0.0;  // N mm; of one yarn
  double rise = 0.0;    // 1/mm
  bool operator==(const BendingFriction&) const = default;
};

struct YarnCard {
  double linear_density = 0.0;  // tonne/mm; card files give tex, 1 tex = 1 g/km = 1e-12 tonne/mm
  double section = 0.0;         // mm^2; given, or Eq. 11 from linear density, fibre volume fraction and densities
  double interval = 0.0;        // mm; spacing between neighbouring yarns of this family
  double crimp = 0.0;           // 1; (yarn length - fabric length) / fabric length
  TangentLaw tension;           // MPa against true strain, e >= 0 (Table 2)
  double linear_modulus = 0.0;  // MPa; tangent of the last piece: at its end, or where it begins when it has no end
  // 1; true strain: the tension law is meant to hold up to the one, no yarn bears more than the law gives at the other.
  double valid_to = std::numeric_limits<double>::infinity(), tearing_strain = valid_to;
  double compression_modulus = 0.0;  // MPa; for e < 0; default 1 % of the linear modulus (ours: the paper gives none)
  TangentLaw compression;            // MPa against |e|, e < 0; no pieces: the compression modulus at every strain
  // Moment of one yarn (N mm) against its curvature (1/mm) as a tangent law in N mm^2; in the fabric's plane, odd in the
  // curvature's sign, and out of it. No pieces: the card does not say. A fibre bundle bends far more easily than E I.
  TangentLaw bending_in_plane;
  BendingLaw bending_out_of_plane;
  BendingFriction bending_friction;  // out of the plane and in it alike
  bool operator==(const YarnCard&) const = default;
};

// Bending of the fabric as a sheet, per width; what its yarns bear is part of it.
struct BendingCard {
  std::optional<std::array<double, 2>> rigidity;  // N mm; moment per width over curvature along warp and weft (Peirce)
  std::optional<double> twist;                    // N mm; D_66: energy per area 2 D_66 w,12^2
  std::optional<double> transverse_shear;         // N/mm; force per width over transverse shear angle
  bool operator==(const BendingCard&) const = default;
};

struct Card {
  std::string name;
  std::string source;      // where its numbers come from
  double thickness = 0.0;  // mm; after consolidation (Table 1)
  // N/mm^3; pressure of a rigid face over the way it sinks in. None: not known.
  std::optional<double> through_thickness_stiffness;
  std::array<YarnCard, 2> yarn;  // [0] warp, [1] weft
  ShearCard shear;
  BendingCard bending;

  // tonne/mm^2: sum over both families of linear density / interval
  [[nodiscard]] double area_density() const;
  bool operator==(const Card&) const = default;
};

// Fibres break at a stress of a few hundredths of their modulus: glass and carbon at 2 to 4 % of elastic strain. Unless
// a card says otherwise its tension law is meant to hold up to the strain of the first share of the linear modulus, and
// its yarns are torn at that of the second.
inline constexpr double valid_share = 0.02, tearing_share = 0.04;

// The least true strain from 0 to 1 at which the law bears `stress` (MPa) or more; 1 when it never does.
[[nodiscard]] double strain_at_stress(const TangentLaw& law, double stress);

// Card by built-in name ("twintex-pw", "twintex-tw") or by file. A relative path is looked up beside `relative_to` (a
// scene file, or a folder). Throws InputError (every complaint, file:line:column) or FileError. Complaints include a
// tangent that turns negative in the range its card claims: tension up to a tenth past its last finite strain, shear up
// to valid_to.
[[nodiscard]] Card load_card(const std::string& name_or_path, const std::filesystem::path& relative_to = {});
// The same from text in memory; `name` stands for the file in messages.
[[nodiscard]] Card read_card_text(const std::string& text, const std::string& name);
// The text of a card as it stands, found as load_card finds it. Throws the same.
[[nodiscard]] std::string card_text_of(const std::string& name_or_path, const std::filesystem::path& relative_to = {});
// The complete card as TOML; reading it back gives the same card, to the bit.
[[nodiscard]] std::string card_to_toml(const Card& card);
// Every valid key of a card file; `table` is "", "yarn" (also for yarn.warp and yarn.weft) or "shear".
[[nodiscard]] std::vector<KeyInfo> card_keys();
// docs/card.md, generated from the key table: every key of a card file.
[[nodiscard]] std::string card_reference_markdown();

[[nodiscard]] std::vector<std::string> builtin_card_names();
[[nodiscard]] bool is_builtin_card(const std::string& name);
// Whether a name that is no built-in card can only mean a file: it has a '/' or ends in .toml.
[[nodiscard]] bool is_card_path(const std::string& name);
// Where load_card looks for a card file.
[[nodiscard]] std::filesystem::path card_path(const std::string& path, const std::filesystem::path& relative_to);

}  // namespace weaveform
