// What a fit file asks for, as plain data in the units of the file. Defaults are written here and nowhere else;
// fit_schema.cpp names each key, its unit, type and range.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/files/csv_format.hpp"
#include "core/keys/key_info.hpp"
#include "fabric/card/card_schema.hpp"
#include "fabric/identify/choices.hpp"

namespace weaveform::identify {

// The fabric and the fit as a whole: keys before the first table.
struct FitHead {
  std::string name;                 // of the card
  std::string source;               // where the tests come from
  std::string base;                 // card whose parts are kept where nothing was measured; "" for none
  std::optional<double> thickness;  // mm; none: the base card's
  double confidence = 95.0;         // %; of every band and interval
};

// [shear]: how the shear law is made from the tests of shear.
struct ShearFitSpec {
  ShearSource from =
      ShearSource::automatic;  // which kind of test makes the card's law; auto: the frame if there is one
  ShearMethod method = ShearMethod::closed_form;
  FormAsked form = FormAsked::automatic;
  int degree = 4;                               // of the stress polynomial
  std::optional<std::array<double, 2>> angles;  // deg; range of the frame tests that is fitted; none: what all reach
  std::array<double, 2> bias_angles = {0.0, 45.0};  // deg; the same of the bias extensions, kinematic angles
  double angle_step = 1.0;                          // deg; of the common grid
};

// [simulation]: how the tests of shear are simulated.
struct SimulationSpec {
  // 1; for warp and weft, of the mesh whose loads are to be the measured ones; none: chosen by its cells
  std::optional<std::array<double, 2>> coarsening;
  std::vector<std::string> settings;  // KEY=VALUE of [model] and [analysis] of the simulated scenes
  double tolerance = 1.0;             // %; of the greatest stress, by which the law may still change
  int rounds = 10;                    // at most, on each mesh
  bool decrimping = false;            // the yarns' decrimping too
};

// [bending_law]: how the moment-curvature law is made from the tests of bending.
struct BendingFitSpec {
  BendingSource from = BendingSource::automatic;  // which kind of test makes the card's law; auto: the first there is
  bool friction = true;                           // of records to and fro goes into the card
  int pieces = 12;                                // of the law, at most
  std::optional<double> greatest_curvature;       // 1/mm; that is fitted; none: what the tests reach
};

// One kind of test on one kind of specimen: its files, what their columns mean, and the specimen.
struct TestSpec {
  std::string name;
  std::vector<std::string> files;  // relative to the fit file; one specimen each, unless specimen_column says otherwise
  Delimiter delimiter = Delimiter::automatic;
  DecimalSign decimal = DecimalSign::automatic;
  int skip_lines = 0;
  std::string specimen_column;  // tells the specimens of one file apart; "" for one specimen per file
  bool trust_units = false;     // take implausible magnitudes as they are

  std::string displacement_column;
  std::string displacement_unit = "mm";
  double displacement_factor = 1.0;
  std::string force_column;
  std::string force_unit = "N";
  double force_factor = 1.0;

  // [[tensile]]
  TestedYarn yarn = TestedYarn::both;
  std::string strain_column;
  std::string strain_unit = "1";
  double strain_factor = 1.0;
  StrainKind strain = StrainKind::true_strain;
  std::string stress_column;
  std::string stress_unit = "MPa";
  double stress_factor = 1.0;
  StressKind stress = StressKind::true_stress;         // the law's; nominal: force over the unstretched section
  std::optional<double> gauge_length;                  // mm
  std::optional<std::array<double, 2>> elastic_range;  // 1; true strain; none: found

  // [[shear_frame]]
  std::string angle_column;
  std::string angle_unit = "deg";
  double angle_factor = 1.0;
  std::string normalised_force_column;
  std::string normalised_force_unit = "N/mm";
  double normalised_force_factor = 1.0;
  std::optional<double> frame_length;   // mm; L_F
  std::optional<double> fabric_length;  // mm; L_f

  // [[bias_extension]]
  std::optional<double> width;   // mm
  std::optional<double> length;  // mm

  // [[moment_curvature]], [[cantilever]] and [[peirce]]
  TestedDirection direction = TestedDirection::both;
  BentSense sense = BentSense::both;
  // [[moment_curvature]]
  std::string curvature_column;
  std::string curvature_unit = "1/m";
  double curvature_factor = 1.0;
  std::string moment_column;
  std::string moment_unit = "N m/m";
  double moment_factor = 1.0;
  std::optional<double> specimen_width;  // mm; for moments of the whole specimen
  // [[cantilever]]
  std::string x_column, y_column;
  std::string x_unit = "mm", y_unit = "mm";
  double x_factor = 1.0, y_factor = 1.0;
  std::vector<double> overhangs;       // mm; of each file; also of [[peirce]]
  std::optional<double> clamp_margin;  // mm; along the strip from the clamp, not used
  std::optional<double> weight;        // N/m^2; of the fabric; also of [[peirce]]
  // [[peirce]]
  std::vector<double> bending_lengths;  // mm
  std::vector<double> rigidities;       // N mm
  double angle = 41.5;                  // deg; of the chord below the horizontal at those overhangs
};

// Whether the strips bend along the yarns of a family, 0 warp and 1 weft.
[[nodiscard]] inline bool bends_along(const TestSpec& test, std::size_t family) {
  return test.direction == TestedDirection::both || (test.direction == TestedDirection::weft) == (family == 1);
}

// Whether the specimens stand for the yarns of a family, 0 warp and 1 weft.
[[nodiscard]] inline bool stands_for(const TestSpec& test, std::size_t family) {
  return test.yarn == TestedYarn::both || (test.yarn == TestedYarn::weft) == (family == 1);
}

struct FitSpec {
  std::string file;  // where it was read from
  FitHead head;
  Card base;  // the base card, or one without laws
  bool has_base = false;
  std::array<YarnFile, 2> yarn;  // base completed by the file's [yarn], [yarn.warp], [yarn.weft]
  BendingCard bending;           // base completed by the file's [bending]
  ShearFitSpec shear;
  SimulationSpec simulation;
  BendingFitSpec bending_law;
  std::vector<TestSpec> tensile, shear_frame, bias_extension, moment_curvature, cantilever, peirce;
  [[nodiscard]] double confidence() const { return head.confidence / 100.0; }
  [[nodiscard]] double thickness() const { return head.thickness.value_or(base.thickness); }  // mm
  [[nodiscard]] double area_weight() const;  // N/mm^2; of the yarns, under standard gravity
};

// Reads and checks a fit file. Throws InputError with every complaint ("file:line:column: ...") or FileError.
[[nodiscard]] FitSpec read_fit(const std::filesystem::path& file);
// The same from text in memory; `name` stands for the file in messages, and relative paths are beside it.
[[nodiscard]] FitSpec read_fit_text(const std::string& text, const std::string& name);

// Tables of every key of a fit file (Markdown), from the key table; docs/fit.md holds them.
[[nodiscard]] std::string fit_reference_markdown();
// The same keys; of [shear] and the kinds of test `table` is the name.
[[nodiscard]] std::vector<KeyInfo> fit_keys();

}  // namespace weaveform::identify
