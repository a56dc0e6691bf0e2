#include "post/dic_settings/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "mesher/base/error.hpp"
#include "mesher/base/key_table.hpp"
#include "mesher/material/identify/unit.hpp"

namespace weaveform::dic {
namespace {

const std::vector<Key<MeasurementSpec>> measurement_keys = {
    key<&MeasurementSpec::format>({.name = "format",
                                   .allowed = {"auto", "aramis", "dice", "vic", "pyvale", "columns"},
                                   .doc = "`auto` goes by the column names; `columns`: any table, by the keys below"}),
    key<&MeasurementSpec::delimiter>(
        {.name = "delimiter",
         .doc = "`auto`, `comma`, `semicolon`, `tab`, `space`, or the one character that separates the columns"}),
    key<&MeasurementSpec::decimal>(
        {.name = "decimal", .allowed = {"auto", "point", "comma"}, .doc = "decimal sign of the numbers"}),
    key<&MeasurementSpec::length_unit>(
        {.name = "length_unit",
         .allowed = {"auto", "mm", "cm", "m", "um", "in", "px"},
         .doc = "of positions and displacements; `auto`: as the column names say, which then must say it"}),
    key<&MeasurementSpec::pixel_size>({.name = "pixel_size",
                                       .unit = "mm",
                                       .limits = above(0),
                                       .doc = "length of one pixel on the specimen; needed for positions in pixels"}),
    key<&MeasurementSpec::y_axis>({.name = "y_axis",
                                   .allowed = {"auto", "up", "down"},
                                   .doc = "sense of the file's y (and v); `auto`: the format's, where it has one"}),
    key<&MeasurementSpec::position>({.name = "position",
                                     .allowed = {"reference", "current"},
                                     .doc = "columns: `x`, `y` of the undeformed or of the deformed specimen"}),
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
};

const std::vector<Key<StagesSpec>> stages_keys = {
    key<&StagesSpec::match>({.name = "match",
                             .allowed = {"auto", "displacement", "force", "frame"},
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
         .allowed = {"least-squares", "marks", "axes", "none"},
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
        {.name = "motion",
         .allowed = {"fixed", "free"},
         .doc = "`free`: the specimen also moved as a whole between the stages (or the camera did)"}),
    key<&RegistrationSpec::reject>({.name = "reject",
                                    .unit = "1",
                                    .limits = at_least(2),
                                    .doc = "robust standard deviations beyond which a point counts as an outlier"}),
};

const std::vector<Key<ComparisonSpec>> comparison_keys = {
    key<&ComparisonSpec::symmetry>(
        {.name = "symmetry",
         .allowed = {"none", "x", "y", "xy", "rotation"},
         .doc = "averages every field over its mirror images in the blank's frame: x -> -x, y -> -y, both, or both at "
                "once (a half turn)"}),
    key<&ComparisonSpec::coverage>({.name = "coverage",
                                    .unit = "1",
                                    .limits = above(0),
                                    .doc = "standard uncertainties within which measured and levelled angle agree"}),
    key<&ComparisonSpec::contour_step>(
        {.name = "contour_step", .unit = "deg", .limits = at_least(0.1), .doc = "from isoline to isoline"}),
    key<&ComparisonSpec::fields>({.name = "fields",
                                  .allowed = {"all", "last", "none"},
                                  .doc = "stages whose points are written (CSV, VTU, isolines)"}),
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

// A table of the file: how it is read, and what the reference says of it.
struct Table {
  std::string name;
  bool many = false;
  std::string doc;
  std::vector<KeyInfo> keys;
  std::function<void(const toml::node&, Settings&, Complaints&)> read;
};

bool wrong_kind(const toml::node& node, bool many, const std::string& name, Complaints& complaints) {
  if (many ? node.is_array_of_tables() : node.is_table()) return false;
  complaints.add(node, many ? fmt::format("'{0}' is a list of tables; begin each with [[{0}]]", name)
                            : fmt::format("'{0}' is a table; begin it with [{0}]", name));
  return true;
}

template <auto member, class Spec>
Table one_table(const std::string& name, const std::string& doc, const std::vector<Key<Spec>>& keys) {
  return {name, false, doc, describe_keys(name, keys),
          [name, &keys](const toml::node& node, Settings& settings, Complaints& complaints) {
            if (!wrong_kind(node, false, name, complaints))
              read_keys(*node.as_table(), "[" + name + "]", keys, settings.*member, complaints);
          }};
}

template <auto member, class Spec>
Table list_of_tables(const std::string& name, const std::string& doc, const std::vector<Key<Spec>>& keys) {
  return {name, true, doc, describe_keys(name, keys),
          [name, &keys](const toml::node& node, Settings& settings, Complaints& complaints) {
            if (wrong_kind(node, true, name, complaints)) return;
            for (const auto& item : *node.as_array()) {
              Spec spec;
              read_keys(*item.as_table(), "[[" + name + "]]", keys, spec, complaints);
              require_keys(*item.as_table(), "[[" + name + "]]", keys, complaints);
              (settings.*member).push_back(spec);
            }
          }};
}

const std::vector<Table>& tables() {
  static const std::vector<Table> all = {
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

// "table.key=value" into the tree; the value is TOML, a bare word is text.
void apply_override(toml::table& root, const std::string& text, Complaints& complaints) {
  const auto equals = text.find('='), dot = text.find('.');
  if (equals == std::string::npos || dot == std::string::npos || dot > equals) {
    complaints.add_override(text, "must be TABLE.KEY=VALUE, e.g. --set instrument.facet_size=4");
    return;
  }
  const std::string table = text.substr(0, dot), name = text.substr(dot + 1, equals - dot - 1);
  const std::string value = text.substr(equals + 1), path = table + "." + name;
  const auto known = std::find_if(tables().begin(), tables().end(), [&](const Table& t) { return t.name == table; });
  std::vector<std::string> names;
  for (const Table& t : tables())
    if (!t.many) names.push_back(t.name);
  if (known == tables().end() || known->many) {
    complaints.add_override(path,
                            fmt::format("no table '{}' that --set can reach{}", table, did_you_mean(table, names)));
    return;
  }
  const std::string source = std::string(override_mark) + path;
  toml::table parsed;
  try {
    parsed = toml::parse("value = " + value, source);
  } catch (const toml::parse_error&) {
    try {
      parsed = toml::parse("value = '" + value + "'", source);
    } catch (const toml::parse_error& error) {
      complaints.add_override(path, fmt::format("'{}' is not a value ({})", value, error.description()));
      return;
    }
  }
  if (!root.contains(table)) root.insert(table, toml::table{});
  if (auto* target = root.get_as<toml::table>(table)) target->insert_or_assign(name, std::move(*parsed.get("value")));
}

// Where a key of a table stands, or the table, or the file.
const toml::node& place_of(const toml::table& root, const char* table, const char* key) {
  const toml::node* node = root.get(table);
  if (node == nullptr || !node->is_table()) return root;
  const toml::node* inner = node->as_table()->get(key);
  return inner == nullptr ? *node : *inner;
}

void check_delimiter(const std::string& delimiter, const toml::node& place, Complaints& complaints) {
  const std::vector<std::string> names = {"auto", "comma", "semicolon", "tab", "space"};
  if (delimiter.size() == 1 || std::find(names.begin(), names.end(), delimiter) != names.end()) return;
  complaints.add(
      place, fmt::format("'delimiter' is '{}'; it must be one character{}", delimiter, did_you_mean(delimiter, names)));
}

void check_measurement(const MeasurementSpec& spec, const toml::table& root, Complaints& complaints) {
  check_delimiter(spec.delimiter, place_of(root, "measurement", "delimiter"), complaints);
  const bool mapped = spec.format == "columns";
  using Named = std::pair<const char*, const std::string*>;
  for (const Named& named : {Named{"x", &spec.x}, {"y", &spec.y}, {"u", &spec.u}, {"v", &spec.v}})
    if (mapped && named.second->empty())
      complaints.add(place_of(root, "measurement", "format"),
                     fmt::format("format 'columns' needs '{}': which column is it?", named.first));
  for (const Named& named : {Named{"x", &spec.x},
                             {"y", &spec.y},
                             {"z", &spec.z},
                             {"u", &spec.u},
                             {"v", &spec.v},
                             {"w", &spec.w},
                             {"quality", &spec.quality},
                             {"stage_column", &spec.stage_column}})
    if (!mapped && !named.second->empty())
      complaints.add(
          place_of(root, "measurement", named.first),
          fmt::format("'{}' is only used with format = \"columns\"; add that or remove the key", named.first));
  if (mapped && !spec.quality.empty() && !spec.quality_least && !spec.quality_greatest)
    complaints.add(place_of(root, "measurement", "quality"),
                   "'quality' needs 'quality_least' or 'quality_greatest': which values are good?");
}

void check_marks(const RegistrationSpec& spec, const toml::table& root, Complaints& complaints) {
  if (spec.method != "marks") return;
  const toml::node& place = place_of(root, "registration", "measured_marks");
  const auto pairs = [](const auto& marks) {
    return std::all_of(marks.begin(), marks.end(), [](const auto& mark) { return mark.size() == 2; });
  };
  if (spec.measured_marks.size() < 2 || spec.measured_marks.size() != spec.simulated_marks.size())
    complaints.add(place,
                   fmt::format("method 'marks' has {} measured and {} simulated marks; give at least two of each, "
                               "in the same order",
                               spec.measured_marks.size(), spec.simulated_marks.size()));
  if (!pairs(spec.measured_marks) || !pairs(spec.simulated_marks))
    complaints.add(place, "each mark is [x, y], two numbers");
}

void check(const Settings& settings, const toml::table& root, Complaints& complaints) {
  check_measurement(settings.measurement, root, complaints);
  check_marks(settings.registration, root, complaints);
  if (const auto& window = settings.instrument.window; window && std::fmod(*window, 2.0) != 1.0)
    complaints.add(place_of(root, "instrument", "window"),
                   fmt::format("'window' is {}; it must be an odd whole number of points", *window));
  if (settings.stages.match == "force" && settings.stages.displacement.size() > 0)
    complaints.add(place_of(root, "stages", "displacement"),
                   "'displacement' is not used with match = \"force\"; remove one of them");
  if (settings.virtual_dic.delimiter.size() != 1)
    complaints.add(place_of(root, "virtual", "delimiter"),
                   fmt::format("'delimiter' is '{}'; it must be one character", settings.virtual_dic.delimiter));
  for (std::size_t k = 0; k < settings.zone.size(); ++k) {
    const auto& box = settings.zone[k].box;
    if (!(box[0] < box[2] && box[1] < box[3]))
      complaints.add((*root.get_as<toml::array>("zone"))[k],
                     fmt::format("'box' of zone '{}' must be xmin < xmax and ymin < ymax", settings.zone[k].name));
  }
  for (std::size_t k = 0; k < settings.line.size(); ++k)
    if (settings.line[k].from == settings.line[k].to)
      complaints.add((*root.get_as<toml::array>("line"))[k],
                     fmt::format("'from' and 'to' of line '{}' are the same point", settings.line[k].name));
}

}  // namespace

Settings read_settings(const std::string& file, const std::vector<std::string>& overrides) {
  const std::string name = file.empty() ? "settings" : file;
  Complaints complaints(name);
  toml::table root = file.empty() ? toml::table{} : parse_toml(read_text_file(file), name);
  for (const auto& text : overrides) apply_override(root, text, complaints);
  Settings settings;
  settings.file = file;
  std::vector<std::string> names;
  for (const Table& table : tables()) names.push_back(table.name);
  for (const auto& [key, node] : root) {
    const auto same = [&given = key](const Table& table) { return table.name == given.str(); };
    const auto found = std::find_if(tables().begin(), tables().end(), same);
    if (found != tables().end())
      found->read(node, settings, complaints);
    else
      complaints.add(key.source(), fmt::format("unknown table '{}'{}", key.str(), did_you_mean(key.str(), names)));
  }
  check(settings, root, complaints);
  complaints.throw_if_any();
  return settings;
}

std::string settings_reference_markdown() {
  std::string text =
      "# Settings of the DIC comparison\n\n"
      "Printed by `weaveform post compare --keys` from the key table in `post/dic_settings/settings.cpp`. The file is "
      "TOML; every key may be left out unless it is required. `\"auto\"` lets the program choose. `--set "
      "TABLE.KEY=VALUE` replaces any value but those of lists of tables. [dic.md](dic.md) tells how they are used.\n";
  for (const Table& table : tables()) {
    text +=
        fmt::format("\n## `{}{}{}`\n\n{}\n\n", table.many ? "[[" : "[", table.name, table.many ? "]]" : "]", table.doc);
    text += markdown_table(table.keys);
  }
  return text;
}

}  // namespace weaveform::dic
