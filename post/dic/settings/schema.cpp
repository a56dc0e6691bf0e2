#include "post/dic/settings/schema.hpp"

#include <fmt/format.h>

#include "fabric/identify/unit.hpp"

namespace weaveform::dic {
namespace {

const std::vector<Key<MeasurementSpec>> measurement_keys = {
    key<&MeasurementSpec::format>({.name = "format",
                                   .doc =
                                       "`auto` goes by all the column names; `matrix`: a matrix for each component, in "
                                       "files whose names say U and V; `columns`: any table, by the keys below"}),
    key<&MeasurementSpec::delimiter>(
        {.name = "delimiter",
         .doc = "`auto`, `comma`, `semicolon`, `tab`, `space`, or the one character that separates the columns"}),
    key<&MeasurementSpec::decimal>({.name = "decimal", .doc = "decimal sign of the numbers"}),
    key<&MeasurementSpec::length_unit>(
        {.name = "length_unit",
         .doc = "of positions and displacements; `auto`: as the column names say, which then must say it"}),
    key<&MeasurementSpec::pixel_size>({.name = "pixel_size",
                                       .unit = "mm",
                                       .limits = above(0),
                                       .doc = "length of one pixel on the specimen; needed for positions in pixels"}),
    key<&MeasurementSpec::y_axis>(
        {.name = "y_axis", .doc = "sense of the file's y (and v); `auto`: the format's, where it has one"}),
    key<&MeasurementSpec::position>(
        {.name = "position", .doc = "columns: `x`, `y` of the undeformed or of the deformed specimen"}),
    key<&MeasurementSpec::x>({.name = "x", .doc = "columns: name of the column, or its number as text"}),
    key<&MeasurementSpec::y>({.name = "y", .doc = "columns: the same"}),
    key<&MeasurementSpec::z>({.name = "z", .doc = "columns: the same; may be left out"}),
    key<&MeasurementSpec::u>({.name = "u", .doc = "columns: displacement along x"}),
    key<&MeasurementSpec::v>({.name = "v", .doc = "columns: displacement along y"}),
    key<&MeasurementSpec::w>({.name = "w", .doc = "columns: displacement along z; may be left out"}),
    key<&MeasurementSpec::quality>({.name = "quality",
                                    .doc = "columns: a number that tells good points from bad, or a flag; a point "
                                           "without it is bad"}),
    key<&MeasurementSpec::quality_least>(
        {.name = "quality_least", .unit = "1", .doc = "columns: least quality of a good point"}),
    key<&MeasurementSpec::quality_greatest>(
        {.name = "quality_greatest", .unit = "1", .doc = "columns: greatest quality of a good point"}),
    key<&MeasurementSpec::stage_column>(
        {.name = "stage_column", .doc = "columns: number that tells the stages of one file apart"}),
    key<&MeasurementSpec::grid_step>({.name = "grid_step",
                                      .unit = "px",
                                      .limits = above(0),
                                      .doc = "matrix: pixels from one point to the next (Ncorr: its spacing plus 1)"}),
    key<&MeasurementSpec::grid_pitch>(
        {.name = "grid_pitch", .unit = "mm", .limits = above(0), .doc = "matrix: the same in mm, instead"}),
    key<&MeasurementSpec::grid_first>(
        {.name = "grid_first", .unit = "px", .doc = "matrix: column and row of the first point in the image"}),
    key<&MeasurementSpec::grid_zeros>(
        {.name = "grid_zeros",
         .doc = "matrix: what points with displacements of exactly zero are; `auto`: measured when they are few, else "
                "asked"}),
    key<&MeasurementSpec::displacement_signal>(
        {.name = "displacement_signal",
         .doc = "aramis: signal of the header that is the crosshead's displacement; left out: `displacement`"}),
    key<&MeasurementSpec::displacement_factor>({.name = "displacement_factor",
                                                .unit = "1",
                                                .doc = "travel in mm = factor x signal + offset; -1 turns the sense"}),
    key<&MeasurementSpec::displacement_offset>(
        {.name = "displacement_offset", .unit = "mm", .doc = "makes the travel 0 at the reference stage"}),
    key<&MeasurementSpec::force_signal>(
        {.name = "force_signal", .doc = "aramis: signal of the header that is the load; left out: `force`"}),
    key<&MeasurementSpec::force_factor>({.name = "force_factor", .unit = "1", .doc = "load in N = factor x signal"}),
};

const std::vector<Key<InstrumentSpec>> instrument_keys = {
    key<&InstrumentSpec::facet_size>({.name = "facet_size",
                                      .unit = "mm",
                                      .limits = at_least(0),
                                      .doc = "side of a facet (subset) on the specimen; 0 for none. `auto`: from the "
                                             "header's facet and step in pixels, which then must be there"}),
    key<&InstrumentSpec::step>(
        {.name = "step",
         .unit = "mm",
         .limits = above(0),
         .doc = "from facet to facet; `auto`: half a facet (virtual), the points' own (compare)"}),
    key<&InstrumentSpec::window>({.name = "window",
                                  .unit = "1",
                                  .limits = between(3, 99),
                                  .doc = "points across the strain window, odd; `auto`: as the header says, else 5"}),
    key<&InstrumentSpec::uncertainty>(
        {.name = "uncertainty",
         .unit = "mm",
         .limits = at_least(0),
         .doc = "standard deviation of a displacement component; `auto`: from the scatter of measured minus simulated "
                "displacements within the strain windows"}),
    key<&InstrumentSpec::fill>(
        {.name = "fill",
         .unit = "1",
         .limits = between(0.1, 1),
         .doc = "least part of a strain window's points, and of a facet's area, that must be there"}),
    key<&InstrumentSpec::ply>(
        {.name = "ply",
         .identifier = true,
         .doc = "of a simulated stack: name of the ply that the camera sees; left out: the highest"}),
};

const std::vector<Key<StagesSpec>> stages_keys = {
    key<&StagesSpec::match>({.name = "match",
                             .doc = "what a measured and a simulated stage have in common; `frame`: the k-th stage is "
                                    "the k-th frame after the start; `auto`: the travel, which then must be known"}),
    key<&StagesSpec::displacement>(
        {.name = "displacement", .unit = "mm", .doc = "the crosshead's travel at each stage, in the files' order"}),
    key<&StagesSpec::force>({.name = "force", .unit = "N", .doc = "the load at each stage, in the files' order"}),
    key<&StagesSpec::grip>(
        {.name = "grip", .doc = "whose travel and load; left out: the only grip or tool that moves"}),
};

const std::vector<Key<RegistrationSpec>> registration_keys = {
    key<&RegistrationSpec::method>(
        {.name = "method",
         .doc = "how the measurement is laid on the blank: by the displacement field, by marks, by the specimen's "
                "origin and angle, or as it is"}),
    key<&RegistrationSpec::measured_marks>(
        {.name = "measured_marks", .unit = "mm", .doc = "marks: [x, y] of each in the measurement, y up"}),
    key<&RegistrationSpec::simulated_marks>(
        {.name = "simulated_marks", .unit = "mm", .doc = "marks: [x, y] of each in the blank's frame"}),
    key<&RegistrationSpec::origin>(
        {.name = "origin", .unit = "mm", .doc = "axes: where the blank's centre lies in the measurement, y up"}),
    key<&RegistrationSpec::angle>({.name = "angle",
                                   .unit = "deg",
                                   .limits = between(-360, 360),
                                   .doc =
                                       "from the measurement's x axis to the blank's, counter-clockwise; axes: as it "
                                       "is (`auto`: 0); least squares: within some 20 deg, where a symmetric field "
                                       "leaves a choice"}),
    key<&RegistrationSpec::motion>(
        {.name = "motion", .doc = "`free`: the specimen also moved as a whole between the stages (or the camera did)"}),
    key<&RegistrationSpec::reject>({.name = "reject",
                                    .unit = "1",
                                    .limits = at_least(2),
                                    .doc = "robust standard deviations beyond which a point counts as an outlier"}),
};

const std::vector<Key<ComparisonSpec>> comparison_keys = {
    key<&ComparisonSpec::symmetry>(
        {.name = "symmetry",
         .doc = "averages every field over its mirror images in the blank's frame: x -> -x, y -> -y, both, or both at "
                "once (a half turn)"}),
    key<&ComparisonSpec::coverage>({.name = "coverage",
                                    .unit = "1",
                                    .limits = above(0),
                                    .doc = "standard uncertainties within which measured and levelled angle agree"}),
    key<&ComparisonSpec::contour_step>(
        {.name = "contour_step", .unit = "deg", .limits = at_least(0.1), .doc = "from isoline to isoline"}),
    key<&ComparisonSpec::fields>({.name = "fields", .doc = "stages whose points are written (CSV, VTU, isolines)"}),
};

const std::vector<Key<ZoneSpec>> zone_keys = {
    key<&ZoneSpec::name>({.name = "name", .required = true, .identifier = true, .doc = "of the zone"}),
    key<&ZoneSpec::box>({.name = "box",
                         .unit = "mm",
                         .required = true,
                         .doc = "xmin, ymin, xmax, ymax on the flat blank, from its centre"}),
};

const std::vector<Key<LineSpec>> line_keys = {
    key<&LineSpec::name>({.name = "name", .required = true, .identifier = true, .doc = "of the line"}),
    key<&LineSpec::from>({.name = "from", .unit = "mm", .required = true, .doc = "on the flat blank, from its centre"}),
    key<&LineSpec::to>({.name = "to", .unit = "mm", .required = true, .doc = "its other end"}),
    key<&LineSpec::points>({.name = "points", .unit = "1", .limits = between(2, 100000), .doc = "along the line"}),
};

const std::vector<Key<LoadSpec>> load_keys = {
    key<&LoadSpec::file>({.name = "file", .doc = "measured load curve (CSV), relative to the settings file"}),
    key<&LoadSpec::displacement_column>(
        {.name = "displacement_column", .doc = "travel: a heading, or a column's number as text"}),
    key<&LoadSpec::force_column>({.name = "force_column", .doc = "load: a heading, or a column's number as text"}),
    key<&LoadSpec::displacement_unit>({.name = "displacement_unit",
                                       .allowed = identify::unit_names(identify::Quantity::length),
                                       .doc = "of the travel"}),
    key<&LoadSpec::force_unit>(
        {.name = "force_unit", .allowed = identify::unit_names(identify::Quantity::force), .doc = "of the load"}),
};

const std::vector<Key<VirtualSpec>> virtual_keys = {
    key<&VirtualSpec::noise>({.name = "noise",
                              .unit = "mm",
                              .limits = at_least(0),
                              .doc = "standard deviation of the normal noise on each displacement component"}),
    key<&VirtualSpec::seed>({.name = "seed", .unit = "1", .limits = at_least(0), .doc = "of noise and lost points"}),
    key<&VirtualSpec::drop>(
        {.name = "drop", .unit = "1", .limits = between(0, 0.9), .doc = "part of the points left out of each stage"}),
    key<&VirtualSpec::fail>({.name = "fail",
                             .unit = "1",
                             .limits = between(0, 0.9),
                             .doc = "part of the points whose correlation failed: flagged by MATCH and SIGMA (dice), "
                                    "without displacement (aramis)"}),
    key<&VirtualSpec::rotation>({.name = "rotation",
                                 .unit = "deg",
                                 .limits = between(-360, 360),
                                 .doc = "from the measurement's x axis to the blank's, counter-clockwise"}),
    key<&VirtualSpec::shift>({.name = "shift", .unit = "mm", .doc = "the blank's centre in the measurement"}),
    key<&VirtualSpec::margin>({.name = "margin",
                               .unit = "mm",
                               .limits = at_least(0),
                               .doc = "band along the blank's outline without facets, beyond the half facet"}),
    key<&VirtualSpec::stages>(
        {.name = "stages", .unit = "1", .limits = at_least(0), .doc = "spread over the frames; 0: one for each"}),
    key<&VirtualSpec::pixel_size>({.name = "pixel_size",
                                   .unit = "mm",
                                   .limits = above(0),
                                   .doc = "dice: length of a pixel; aramis: that of the facet size in the header"}),
    key<&VirtualSpec::delimiter>({.name = "delimiter", .doc = "dice: the character between the columns"}),
    key<&VirtualSpec::decimal_comma>({.name = "decimal_comma", .doc = "aramis: numbers with a decimal comma"}),
};

bool wrong_kind(const toml::node& node, bool many, const std::string& name, Complaints& complaints) {
  if (many ? node.is_array_of_tables() : node.is_table()) return false;
  complaints.add(node, many ? fmt::format("'{0}' is a list of tables; begin each with [[{0}]]", name)
                            : fmt::format("'{0}' is a table; begin it with [{0}]", name));
  return true;
}

template <auto member, class Spec>
SettingsTable one_table(const std::string& name, const std::string& doc, const std::vector<Key<Spec>>& keys) {
  return {name,
          false,
          doc,
          describe_keys(name, keys),
          [name, &keys](const toml::node& node, Settings& settings, Complaints& complaints) {
            if (!wrong_kind(node, false, name, complaints))
              read_keys(*node.as_table(), "[" + name + "]", keys, settings.*member, complaints);
          },
          [&keys](const Settings& settings) {
            std::vector<std::string> values;
            for (const auto& key : keys) {
              const std::string value = key.write(settings.*member).value_or("");
              values.push_back(value == key.write(Spec{}).value_or("") ? "" : value);
            }
            return values;
          }};
}

template <auto member, class Spec>
SettingsTable list_of_tables(const std::string& name, const std::string& doc, const std::vector<Key<Spec>>& keys) {
  return {name,
          true,
          doc,
          describe_keys(name, keys),
          [name, &keys](const toml::node& node, Settings& settings, Complaints& complaints) {
            if (wrong_kind(node, true, name, complaints)) return;
            for (const auto& item : *node.as_array()) {
              Spec spec;
              read_keys(*item.as_table(), "[[" + name + "]]", keys, spec, complaints);
              require_keys(*item.as_table(), "[[" + name + "]]", keys, complaints);
              (settings.*member).push_back(spec);
            }
          },
          [](const Settings&) { return std::vector<std::string>{}; }};
}

}  // namespace

const std::vector<SettingsTable>& settings_tables() {
  static const std::vector<SettingsTable> all = {
      one_table<&Settings::measurement>("measurement", "How the measurement's files are to be read.", measurement_keys),
      one_table<&Settings::instrument>("instrument", "The instrument through which the simulation is seen.",
                                       instrument_keys),
      one_table<&Settings::stages>("stages", "Which simulated state a measured stage is compared with.", stages_keys),
      one_table<&Settings::registration>("registration", "How the measurement is laid on the blank.",
                                         registration_keys),
      one_table<&Settings::comparison>("comparison", "What is compared and written.", comparison_keys),
      list_of_tables<&Settings::zone>("zone",
                                      "Part of the flat blank over which fields are averaged. A bias extension has its "
                                      "zones A, B and C by itself.",
                                      zone_keys),
      list_of_tables<&Settings::line>("line", "Line on the flat blank along which the fields are written.", line_keys),
      one_table<&Settings::load>("load", "A measured load curve, laid over the simulated one.", load_keys),
      one_table<&Settings::virtual_dic>("virtual", "What `weaveform post virtual` does to the fields it exports.",
                                        virtual_keys),
  };
  return all;
}

}  // namespace weaveform::dic
