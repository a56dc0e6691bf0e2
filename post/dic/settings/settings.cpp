#include "post/dic/settings/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "post/dic/settings/schema.hpp"

namespace weaveform::dic {
namespace {

// "table.key=value" into the tree; the value is TOML, a bare word is text.
void apply_override(toml::table& root, const std::string& text, Complaints& complaints) {
  const auto equals = text.find('='), dot = text.find('.');
  if (equals == std::string::npos || dot == std::string::npos || dot > equals) {
    complaints.add_override(text, "must be TABLE.KEY=VALUE, e.g. --set instrument.facet_size=4");
    return;
  }
  const std::string table = text.substr(0, dot), name = text.substr(dot + 1, equals - dot - 1);
  const std::string value = text.substr(equals + 1), path = table + "." + name;
  const auto known = std::find_if(settings_tables().begin(), settings_tables().end(),
                                  [&](const SettingsTable& t) { return t.name == table; });
  std::vector<std::string> names;
  for (const SettingsTable& t : settings_tables())
    if (!t.many) names.push_back(t.name);
  if (known == settings_tables().end() || known->many) {
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
  const auto names = choice_names<Delimiter>();
  if (delimiter.size() == 1 || std::find(names.begin(), names.end(), delimiter) != names.end()) return;
  complaints.add(
      place, fmt::format("'delimiter' is '{}'; it must be one character{}", delimiter, did_you_mean(delimiter, names)));
}

void check_measurement(const MeasurementSpec& spec, const toml::table& root, Complaints& complaints) {
  check_delimiter(spec.delimiter, place_of(root, "measurement", "delimiter"), complaints);
  const bool mapped = spec.format == MeasurementFormat::columns;
  for (const NamedColumn& named : {NamedColumn{"x", &spec.x}, {"y", &spec.y}, {"u", &spec.u}, {"v", &spec.v}})
    if (mapped && named.second->empty())
      complaints.add(place_of(root, "measurement", "format"),
                     fmt::format("format 'columns' needs '{}': which column is it?", named.first));
  for (const NamedColumn& named : columns_asked(spec))
    if (!mapped)
      complaints.add(
          place_of(root, "measurement", named.first),
          fmt::format("'{}' is only used with format = \"columns\"; add that or remove the key", named.first));
  if (mapped && !spec.quality.empty() && !spec.quality_least && !spec.quality_greatest)
    complaints.add(place_of(root, "measurement", "quality"),
                   "'quality' needs 'quality_least' or 'quality_greatest': which values are good?");
}

void check_marks(const RegistrationSpec& spec, const toml::table& root, Complaints& complaints) {
  if (spec.method != RegistrationMethod::marks) return;
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
  if (settings.stages.match == MatchBy::force && !settings.stages.displacement.empty())
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
  toml::table root = file.empty() ? toml::table{} : parse_toml(read_text_file(file, most_written_by_hand), name);
  for (const auto& text : overrides) apply_override(root, text, complaints);
  Settings settings;
  settings.file = file;
  std::vector<std::string> names;
  for (const SettingsTable& table : settings_tables()) names.push_back(table.name);
  for (const auto& [key, node] : root) {
    const auto same = [&given = key](const SettingsTable& table) { return table.name == given.str(); };
    const auto found = std::find_if(settings_tables().begin(), settings_tables().end(), same);
    if (found != settings_tables().end())
      found->read(node, settings, complaints);
    else
      complaints.add(key.source(), fmt::format("unknown table '{}'{}", key.str(), did_you_mean(key.str(), names)));
  }
  check(settings, root, complaints);
  complaints.throw_if_any();
  return settings;
}

std::vector<KeyInfo> settings_keys() {
  std::vector<KeyInfo> all;
  for (const SettingsTable& table : settings_tables()) all.insert(all.end(), table.keys.begin(), table.keys.end());
  return all;
}

std::string settings_reference_markdown() {
  std::string text =
      "# Settings of the DIC comparison\n\n"
      "Printed by `weaveform post compare --keys` from the key table in `post/dic/settings/schema.cpp`. The file is "
      "TOML; every key may be left out unless it is required. `\"auto\"` lets the program choose. `--set "
      "TABLE.KEY=VALUE` replaces any value but those of lists of tables. [dic.md](dic.md) tells how they are used.\n";
  for (const SettingsTable& table : settings_tables()) {
    text +=
        fmt::format("\n## `{}{}{}`\n\n{}\n\n", table.many ? "[[" : "[", table.name, table.many ? "]]" : "]", table.doc);
    text += markdown_table(table.keys);
  }
  return text;
}

}  // namespace weaveform::dic
