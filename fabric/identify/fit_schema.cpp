#include "fabric/identify/fit_schema.hpp"

#include "fabric/identify/unit.hpp"

namespace weaveform::identify {
namespace {

using Keys = std::vector<Key<TestSpec>>;

// What every test needs: its files and how they are written.
Keys file_keys() {
  return {
      key<&TestSpec::name>(
          {.name = "name", .required = true, .identifier = true, .doc = "of the test, in the report and on charts"}),
      key<&TestSpec::files>({.name = "files",
                             .required = true,
                             .doc = "test files, relative to the fit file; one specimen each, unless "
                                    "`specimen_column` tells them apart"}),
      key<&TestSpec::delimiter>({.name = "delimiter", .doc = "what separates the columns"}),
      key<&TestSpec::decimal>({.name = "decimal", .doc = "decimal sign of the numbers"}),
      key<&TestSpec::skip_lines>({.name = "skip_lines",
                                  .unit = "1",
                                  .limits = between(0, 1e6),
                                  .doc = "lines before the heading; blank lines and those that begin with # are "
                                         "skipped anyway"}),
      key<&TestSpec::specimen_column>(
          {.name = "specimen_column", .doc = "column that names the specimen of each row, for files with several"}),
      key<&TestSpec::trust_units>(
          {.name = "trust_units", .doc = "true takes implausible magnitudes as they are instead of asking back"}),
  };
}

Keys load_keys() {
  return {
      key<&TestSpec::displacement_column>(
          {.name = "displacement_column", .doc = "crosshead displacement: a heading, or a column's number as text"}),
      key<&TestSpec::displacement_unit>(
          {.name = "displacement_unit", .allowed = unit_names(Quantity::length), .doc = "its unit"}),
      key<&TestSpec::displacement_factor>(
          {.name = "displacement_factor", .unit = "1", .doc = "times the column, e.g. -1, or that of a linkage"}),
      key<&TestSpec::force_column>({.name = "force_column", .doc = "load of the machine"}),
      key<&TestSpec::force_unit>({.name = "force_unit", .allowed = unit_names(Quantity::force), .doc = "its unit"}),
      key<&TestSpec::force_factor>(
          {.name = "force_factor", .unit = "1", .doc = "times the column, e.g. -1, or 0.1 for ten yarns at once"}),
  };
}

Keys joined(Keys first, const Keys& second, const Keys& third) {
  first.insert(first.end(), second.begin(), second.end());
  first.insert(first.end(), third.begin(), third.end());
  return first;
}

Keys tensile_only() {
  return {
      key<&TestSpec::gauge_length>({.name = "gauge_length",
                                    .unit = "mm",
                                    .limits = above(0),
                                    .doc = "between the grips; needed with a displacement"}),
      key<&TestSpec::yarn>({.name = "yarn", .doc = "the family the specimens stand for"}),
      key<&TestSpec::strain_column>({.name = "strain_column", .doc = "instead of displacement and force"}),
      key<&TestSpec::strain_unit>(
          {.name = "strain_unit", .allowed = unit_names(Quantity::strain), .doc = "of `strain_column`"}),
      key<&TestSpec::strain_factor>({.name = "strain_factor", .unit = "1", .doc = "times `strain_column`, e.g. -1"}),
      key<&TestSpec::strain>(
          {.name = "strain", .doc = "what `strain_column` holds; the law uses true strain, ln(1 + l/l0)"}),
      key<&TestSpec::stress_column>(
          {.name = "stress_column", .doc = "force over the unstretched section; goes with `strain_column`"}),
      key<&TestSpec::stress_unit>(
          {.name = "stress_unit", .allowed = unit_names(Quantity::stress), .doc = "of `stress_column`"}),
      key<&TestSpec::stress_factor>({.name = "stress_factor", .unit = "1", .doc = "times `stress_column`, e.g. -1"}),
      key<&TestSpec::stress>({.name = "stress",
                              .doc = "the law's stress: over the stretched section, so that a model with "
                                     "`section = \"incompressible\"` gives the measured force back, or over the "
                                     "unstretched one (the paper's) for `section = \"constant\"`"}),
      key<&TestSpec::elastic_range>({.name = "elastic_range",
                                     .unit = "1",
                                     .limits = between(0, 1),
                                     .doc = "true strains between which the yarn is elastic; found when left out"}),
  };
}

Keys frame_only() {
  return {
      key<&TestSpec::frame_length>(
          {.name = "frame_length", .unit = "mm", .limits = above(0), .doc = "L_F, between the frame's pins"}),
      key<&TestSpec::fabric_length>(
          {.name = "fabric_length", .unit = "mm", .limits = above(0), .doc = "L_f, of the sheared square of fabric"}),
      key<&TestSpec::angle_column>({.name = "angle_column", .doc = "shear angle, instead of displacement and force"}),
      key<&TestSpec::angle_unit>(
          {.name = "angle_unit", .allowed = unit_names(Quantity::angle), .doc = "of `angle_column`"}),
      key<&TestSpec::angle_factor>({.name = "angle_factor", .unit = "1", .doc = "times `angle_column`, e.g. -1"}),
      key<&TestSpec::normalised_force_column>(
          {.name = "normalised_force_column", .doc = "shear force of Eq. 13; goes with `angle_column`"}),
      key<&TestSpec::normalised_force_unit>({.name = "normalised_force_unit",
                                             .allowed = unit_names(Quantity::force_per_length),
                                             .doc = "of `normalised_force_column`"}),
      key<&TestSpec::normalised_force_factor>(
          {.name = "normalised_force_factor", .unit = "1", .doc = "times `normalised_force_column`, e.g. -1"}),
  };
}

Keys bias_only() {
  return {
      key<&TestSpec::width>(
          {.name = "width", .unit = "mm", .limits = above(0), .required = true, .doc = "W, across the pull"}),
      key<&TestSpec::length>({.name = "length",
                              .unit = "mm",
                              .limits = above(0),
                              .required = true,
                              .doc = "L, from grip to grip, greater than the width"}),
  };
}

const auto direction_key = key<&TestSpec::direction>(
    {.name = "direction", .doc = "the yarns along which the strips are bent: 'warp', 'weft', or 'both' alike"});
const auto sense_key = key<&TestSpec::sense>(
    {.name = "sense",
     .doc = "the side that is bent outwards (the convex one: of a hanging strip the upper); of a table that goes both "
            "ways, at positive curvatures. Where both are tested and differ by more than their bands, the card has a "
            "law for each; 'both': counts for either, and a table that goes both ways is one law, its odd part"});
const auto weight_key = key<&TestSpec::weight>({.name = "weight",
                                                .unit = "N/m^2",
                                                .limits = above(0, 1e4),
                                                .doc = "of the fabric per area; auto: that of the card's yarns under "
                                                       "9.80665 m/s^2"});

std::vector<std::string> moment_units() {
  auto names = unit_names(Quantity::moment_per_length);
  for (const auto& name : unit_names(Quantity::moment)) names.push_back(name);
  return names;
}

Keys moment_only() {
  return {
      key<&TestSpec::curvature_column>(
          {.name = "curvature_column", .required = true, .doc = "curvature: a heading, or a column's number as text"}),
      key<&TestSpec::curvature_unit>(
          {.name = "curvature_unit", .allowed = unit_names(Quantity::curvature), .doc = "its unit"}),
      key<&TestSpec::curvature_factor>({.name = "curvature_factor", .unit = "1", .doc = "times the column, e.g. -1"}),
      key<&TestSpec::moment_column>({.name = "moment_column", .required = true, .doc = "moment"}),
      key<&TestSpec::moment_unit>({.name = "moment_unit",
                                   .allowed = moment_units(),
                                   .doc = "its unit, per width of the specimen or, with `specimen_width`, of the whole "
                                          "specimen"}),
      key<&TestSpec::moment_factor>({.name = "moment_factor", .unit = "1", .doc = "times the column, e.g. -1"}),
      key<&TestSpec::specimen_width>({.name = "specimen_width",
                                      .unit = "mm",
                                      .limits = above(0),
                                      .doc = "by which moments of the whole specimen are divided; goes with a unit "
                                             "that is not per width"}),
      direction_key,
      sense_key,
  };
}

Keys cantilever_only() {
  return {
      key<&TestSpec::x_column>({.name = "x_column",
                                .required = true,
                                .doc = "digitised profile, rows along the strip: level distance from the clamp's edge; "
                                       "a heading, or a column's number as text"}),
      key<&TestSpec::x_unit>({.name = "x_unit", .allowed = unit_names(Quantity::length), .doc = "its unit"}),
      key<&TestSpec::x_factor>({.name = "x_factor", .unit = "1", .doc = "times the column, e.g. mm per pixel"}),
      key<&TestSpec::y_column>({.name = "y_column", .required = true, .doc = "height, upwards"}),
      key<&TestSpec::y_unit>({.name = "y_unit", .allowed = unit_names(Quantity::length), .doc = "its unit"}),
      key<&TestSpec::y_factor>(
          {.name = "y_factor", .unit = "1", .doc = "times the column, e.g. -1 where heights count downwards"}),
      key<&TestSpec::overhangs>({.name = "overhangs",
                                 .unit = "mm",
                                 .limits = above(0, greatest_length),
                                 .doc = "free lengths, one for each of `files` or one for all; checked against the "
                                        "profiles; when left out, the profiles' own lengths"}),
      key<&TestSpec::clamp_margin>({.name = "clamp_margin",
                                    .unit = "mm",
                                    .limits = between(0, greatest_length),
                                    .doc =
                                        "of the strip beside the clamp that is left out, where it lifts or kinks; then "
                                        "nothing is supposed of the clamp; auto: none, and the strip leaves the "
                                        "clamp's edge level to a degree or so"}),
      weight_key,
      direction_key,
      sense_key,
  };
}

Keys peirce_only() {
  return {
      key<&TestSpec::name>({.name = "name", .required = true, .identifier = true, .doc = "of the test, in the report"}),
      key<&TestSpec::bending_lengths>({.name = "bending_lengths",
                                       .unit = "mm",
                                       .limits = above(0, greatest_length),
                                       .doc = "Peirce's bending length c of each specimen; rigidity = weight * c^3"}),
      key<&TestSpec::overhangs>({.name = "overhangs",
                                 .unit = "mm",
                                 .limits = above(0, greatest_length),
                                 .doc =
                                     "instead: overhang of each specimen whose tip lies `angle` below the clamp; c = "
                                     "overhang (cos(angle/2) / (8 tan(angle)))^(1/3), Peirce (1930)"}),
      key<&TestSpec::angle>({.name = "angle",
                             .unit = "deg",
                             .limits = between(5, 75),
                             .doc = "of the line from the clamp's edge to the tip, with `overhangs`"}),
      key<&TestSpec::rigidities>(
          {.name = "rigidities",
           .unit = "N mm",
           .limits = above(0),
           .doc = "instead: flexural rigidity per width of each specimen; 1e5 mg cm are 1 N mm"}),
      weight_key,
      direction_key,
      sense_key,
      key<&TestSpec::trust_units>(
          {.name = "trust_units", .doc = "true takes implausible magnitudes as they are instead of asking back"}),
  };
}

}  // namespace

const std::vector<Key<BendingFitSpec>>& bending_fit_keys() {
  static const std::vector<Key<BendingFitSpec>> keys = {
      key<&BendingFitSpec::from>({.name = "from",
                                  .doc = "the tests that make the card's law of a direction; the others are reported "
                                         "beside it; auto: the first of these that there is"}),
      key<&BendingFitSpec::friction>(
          {.name = "friction",
           .doc = "friction that records to and fro tell goes into the card as `bending_friction`; false: the card has "
                  "none, and the law is that of loading from flat, friction included"}),
      key<&BendingFitSpec::pieces>({.name = "pieces",
                                    .unit = "1",
                                    .limits = between(2, 60),
                                    .doc = "of the law, at most; as many are taken as the tests can tell apart, each "
                                           "with a stiffness that is linear in the curvature"}),
      key<&BendingFitSpec::greatest_curvature>(
          {.name = "greatest_curvature",
           .unit = "1/mm",
           .limits = above(0, 10),
           .doc = "that is fitted; auto: the greatest that two specimens reach, or the only one"}),
  };
  return keys;
}

const std::vector<Key<FitHead>>& fit_head_keys() {
  static const std::vector<Key<FitHead>> keys = {
      key<&FitHead::name>({.name = "name", .required = true, .identifier = true, .doc = "of the card"}),
      key<&FitHead::source>({.name = "source", .doc = "where the tests come from; goes into the card"}),
      key<&FitHead::base>({.name = "base",
                           .doc = "card (built-in name, or file relative to the fit file) whose parts are kept where "
                                  "nothing was measured"}),
      key<&FitHead::thickness>({.name = "thickness",
                                .unit = "mm",
                                .limits = above(0),
                                .doc = "of the fabric, after consolidation; auto: the base card's"}),
      key<&FitHead::confidence>({.name = "confidence",
                                 .unit = "%",
                                 .limits = between(50, 99.9),
                                 .doc = "of every band and interval in the report"}),
  };
  return keys;
}

const std::vector<Key<ShearFitSpec>>& shear_fit_keys() {
  static const std::vector<Key<ShearFitSpec>> keys = {
      key<&ShearFitSpec::from>({.name = "from",
                                .doc = "the tests that make the card's law; the others are reported beside it; auto: "
                                       "the shear frame when there is one"}),
      key<&ShearFitSpec::method>(
          {.name = "method",
           .doc = "closed_form: Eqs. 12 and 13, or the three zones; simulation: the law for which the simulated test "
                  "gives the measured load, found from there on in rounds ([simulation])"}),
      key<&ShearFitSpec::form>({.name = "form",
                                .doc = "stress through zero, with or without a friction-like start plateau g / (g + "
                                       "rise); auto: the one that describes the tests better"}),
      key<&ShearFitSpec::degree>({.name = "degree",
                                  .unit = "1",
                                  .limits = between(1, 8),
                                  .doc = "of the stress polynomial in the logarithmic shear strain; the paper's is 4"}),
      key<&ShearFitSpec::angles>({.name = "angles",
                                  .unit = "deg",
                                  .limits = between(0, 89),
                                  .doc = "shear angles of the frame tests that are fitted; when left out, from zero to "
                                         "the greatest that all specimens reach"}),
      key<&ShearFitSpec::bias_angles>(
          {.name = "bias_angles",
           .unit = "deg",
           .limits = between(0, 89),
           .doc = "the same for bias extensions, in kinematic angles (Eq. 14), which yarns that slip do not follow"}),
      key<&ShearFitSpec::angle_step>({.name = "angle_step",
                                      .unit = "deg",
                                      .limits = between(0.05, 10),
                                      .doc = "of the common grid on which specimens are averaged and fitted"}),
  };
  return keys;
}

const std::vector<Key<SimulationSpec>>& simulation_keys() {
  static const std::vector<Key<SimulationSpec>> keys = {
      key<&SimulationSpec::coarsening>(
          {.name = "coarsening",
           .unit = "1",
           .limits = between(0.1, 100),
           .one_for_all = true,
           .doc = "of the mesh whose loads are to be the measured ones; the rounds begin with cells of up to twice the "
                  "size. "
                  "Auto: the coarsest of 4, 2, 1, 1/2 and 1/4 with 200 cells or more, of a frame with 16"}),
      key<&SimulationSpec::settings>(
          {.name = "settings",
           .doc = "of the simulated scenes, as for `--set`: keys of [model] and [analysis]. Without them a bias "
                  "extension has the defaults, its yarns decrimp; a shear frame is rigid, its yarns linear and of ten "
                  "times the modulus"}),
      key<&SimulationSpec::tolerance>(
          {.name = "tolerance",
           .unit = "%",
           .limits = between(0.01, 20),
           .doc = "of the law's greatest stress, by which it may still change from one round to the next"}),
      key<&SimulationSpec::rounds>(
          {.name = "rounds", .unit = "1", .limits = between(1, 100), .doc = "at most, on each of the two meshes"}),
      key<&SimulationSpec::decrimping>(
          {.name = "decrimping",
           .doc =
               "true: a factor on the crimp that the yarns' decrimping law is made from, too; needs bias extensions"}),
  };
  return keys;
}

const Keys& tensile_keys() {
  static const Keys keys = joined(file_keys(), load_keys(), tensile_only());
  return keys;
}
const Keys& shear_frame_keys() {
  static const Keys keys = joined(file_keys(), load_keys(), frame_only());
  return keys;
}
const Keys& bias_extension_keys() {
  static const Keys keys = joined(file_keys(), load_keys(), bias_only());
  return keys;
}

const Keys& moment_curvature_keys() {
  static const Keys keys = joined(file_keys(), moment_only(), {});
  return keys;
}
const Keys& cantilever_keys() {
  static const Keys keys = joined(file_keys(), cantilever_only(), {});
  return keys;
}
const Keys& peirce_keys() {
  static const Keys keys = peirce_only();
  return keys;
}

std::vector<KeyInfo> fit_keys() {
  std::vector<KeyInfo> all;
  for (const auto& keys :
       {describe_keys("", fit_head_keys()), describe_keys("shear", shear_fit_keys()),
        describe_keys("simulation", simulation_keys()), describe_keys("tensile", tensile_keys()),
        describe_keys("shear_frame", shear_frame_keys()), describe_keys("bias_extension", bias_extension_keys()),
        describe_keys("bending_law", bending_fit_keys()), describe_keys("moment_curvature", moment_curvature_keys()),
        describe_keys("cantilever", cantilever_keys()), describe_keys("peirce", peirce_keys())})
    all.insert(all.end(), keys.begin(), keys.end());
  return all;
}

std::string fit_reference_markdown() {
  const auto section = [](const char* title, const char* doc, const std::vector<KeyInfo>& keys) {
    return std::string("\n### ") + title + "\n\n" + doc + "\n\n" + markdown_table(keys);
  };
  return section("The fabric", "Before the first table of the file.", describe_keys("", fit_head_keys())) +
         section("`[shear]`", "How the shear law is made.", describe_keys("shear", shear_fit_keys())) +
         section("`[simulation]`", "How the tests are simulated where `method` of `[shear]` is `\"simulation\"`.",
                 describe_keys("simulation", simulation_keys())) +
         section("`[[tensile]]`", "Tensile tests of single yarns; as many tables as needed.",
                 describe_keys("tensile", tensile_keys())) +
         section("`[[shear_frame]]`", "Shear-frame (picture-frame) tests; as many tables as needed.",
                 describe_keys("shear_frame", shear_frame_keys())) +
         section("`[[bias_extension]]`", "Bias-extension tests; as many tables as needed.",
                 describe_keys("bias_extension", bias_extension_keys())) +
         section("`[bending_law]`", "How the moment-curvature law is made.",
                 describe_keys("bending_law", bending_fit_keys())) +
         section("`[[moment_curvature]]`",
                 "Tables of moment against curvature (KES, rotating clamps); as many tables as needed.",
                 describe_keys("moment_curvature", moment_curvature_keys())) +
         section("`[[cantilever]]`", "Digitised shapes of strips that hang over an edge; as many tables as needed.",
                 describe_keys("cantilever", cantilever_keys())) +
         section("`[[peirce]]`", "Peirce's single numbers, one of the three lists; as many tables as needed.",
                 describe_keys("peirce", peirce_keys())) +
         "\n### `[yarn]`, `[yarn.warp]`, `[yarn.weft]`, `[bending]`\n\nThe keys of a card (`docs/card.md`), each "
         "optional when the base card has it. `section` and the three keys of Eq. 11 replace each other, "
         "and so do `compression_modulus` and `compression`.\n";
}

}  // namespace weaveform::identify
