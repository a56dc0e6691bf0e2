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

}  // namespace

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

std::vector<KeyInfo> fit_keys() {
  std::vector<KeyInfo> all;
  for (const auto& keys : {describe_keys("", fit_head_keys()), describe_keys("shear", shear_fit_keys()),
                           describe_keys("tensile", tensile_keys()), describe_keys("shear_frame", shear_frame_keys()),
                           describe_keys("bias_extension", bias_extension_keys())})
    all.insert(all.end(), keys.begin(), keys.end());
  return all;
}

std::string fit_reference_markdown() {
  const auto section = [](const char* title, const char* doc, const std::vector<KeyInfo>& keys) {
    return std::string("\n### ") + title + "\n\n" + doc + "\n\n" + markdown_table(keys);
  };
  return section("The fabric", "Before the first table of the file.", describe_keys("", fit_head_keys())) +
         section("`[shear]`", "How the shear law is made.", describe_keys("shear", shear_fit_keys())) +
         section("`[[tensile]]`", "Tensile tests of single yarns; as many tables as needed.",
                 describe_keys("tensile", tensile_keys())) +
         section("`[[shear_frame]]`", "Shear-frame (picture-frame) tests; as many tables as needed.",
                 describe_keys("shear_frame", shear_frame_keys())) +
         section("`[[bias_extension]]`", "Bias-extension tests; as many tables as needed.",
                 describe_keys("bias_extension", bias_extension_keys())) +
         "\n### `[yarn]`, `[yarn.warp]`, `[yarn.weft]`, `[bending]`\n\nThe keys of a card (`docs/card.md`), each "
         "optional when the base card has it. `section` and the three keys of Eq. 11 replace each other, "
         "and so do `compression_modulus` and `compression`.\n";
}

}  // namespace weaveform::identify
