#include "mesher/scene/overrides.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "core/error.hpp"
#include "core/files/text_words.hpp"
#include "core/keys/nearest_name.hpp"
#include "mesher/scene/schema.hpp"

namespace weaveform {
namespace {

std::vector<std::string> split_at_dots(const std::string& key) {
  std::vector<std::string> parts(1);
  for (const char c : key) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

// A table that holds the value under the key "value": read as TOML, else, a bare word, as text.
std::optional<toml::table> parse_value(const std::string& key, const std::string& text, Complaints& complaints) {
  const std::string source = std::string(override_mark) + key;
  // What begins like a list, a table or a quoted text was meant as one.
  const bool bare_word = !text.empty() && text.find_first_of("[{\"'\n") == std::string::npos;
  std::string reason;
  for (const std::string& line : {"value = " + text, "value = '" + text + "'"}) {
    try {
      toml::table parsed = toml::parse(line, source);
      if (parsed.size() == 1) return parsed;
      reason = "it has several lines";
    } catch (const toml::parse_error& error) {
      if (reason.empty()) reason = error.description();
    }
    if (!bare_word) break;
  }
  complaints.add_override(key, fmt::format("'{}' is not a value ({}); quote texts, put lists in [ ]", text, reason));
  return std::nullopt;
}

const SceneTable* find_table(const std::string& key, const std::string& name, Complaints& complaints) {
  std::vector<std::string> names;
  for (const auto& table : scene_tables()) {
    if (table.name == name) return &table;
    names.push_back(table.name);
  }
  complaints.add_override(key, fmt::format("unknown table '{}'{}", name, did_you_mean(name, names)));
  return nullptr;
}

bool is_index_below(const std::string& text, std::size_t count) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  return error == std::errc{} && end == text.data() + text.size() && index < count;
}

// The element of a list of tables with this name, or at this 0-based index.
toml::table* find_element(toml::table& root, const std::string& key, const std::string& list_name,
                          const std::string& element, Complaints& complaints) {
  toml::array* list = root[list_name].as_array();
  const std::size_t count = list == nullptr ? 0 : list->size();
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) {
    toml::table* table = (*list)[i].as_table();
    if (table == nullptr) continue;
    const auto name = (*table)["name"].value<std::string>();
    if (name == element) return table;
    if (name) names.push_back(*name);
  }
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(element.data(), element.data() + element.size(), index);
  const bool is_index = error == std::errc{} && end == element.data() + element.size();
  if (is_index && index < count && (*list)[index].is_table()) return (*list)[index].as_table();
  const std::string hint = count == 0 ? "; the scene has none" : did_you_mean(element, names);
  complaints.add_override(key, fmt::format("no [[{}]] is called '{}' or has this index{}", list_name, element, hint));
  return nullptr;
}

// The table [group.NAME].
toml::table* find_named(toml::table& root, const std::string& key, const std::string& group, const std::string& name,
                        Complaints& complaints) {
  toml::table* tables = root[group].as_table();
  std::vector<std::string> names;
  if (tables != nullptr) {
    for (auto&& [given, node] : *tables) {
      if (!node.is_table()) continue;
      if (given.str() == name) return node.as_table();
      names.emplace_back(given.str());
    }
  }
  const std::string hint = names.empty() ? "; the scene has none" : did_you_mean(name, names);
  complaints.add_override(key, fmt::format("no [{0}.{1}]{2}", group, name, hint));
  return nullptr;
}

bool leads_to_a_pair(const std::vector<std::string>& parts) {
  return parts.size() > 1 && parts[0] == "stack" && parts[1] == "pair";
}

// The element of [[stack.pair]], which have no names.
toml::table* find_pair(toml::table& root, const std::string& key, const std::vector<std::string>& parts,
                       Complaints& complaints) {
  toml::table* stack = root["stack"].as_table();
  const toml::array* pairs = stack == nullptr ? nullptr : (*stack)["pair"].as_array();
  const std::size_t count = pairs == nullptr ? 0 : pairs->size();
  if (parts.size() == 4 && count > 0 && is_index_below(parts[2], count))
    return find_element(*stack, key, "pair", parts[2], complaints);
  complaints.add_override(key,
                          fmt::format("write stack.pair.NUMBER.KEY=VALUE; the scene has {} [[stack.pair]]{}",
                                      count == 0 ? "no" : std::to_string(count), count == 0 ? "" : ", counted from 0"));
  return nullptr;
}

// The table that the key's last part belongs to; created when the file leaves it out.
toml::table* find_place(toml::table& root, const std::string& key, Complaints& complaints) {
  const auto parts = split_at_dots(key);
  const SceneTable* table = find_table(key, parts[0], complaints);
  if (table == nullptr) return nullptr;
  if (leads_to_a_pair(parts)) return find_pair(root, key, parts, complaints);
  const bool has_name = table->many || table->named;
  if (parts.size() != (has_name ? 3U : 2U)) {
    complaints.add_override(key, fmt::format("write {0}.{1}KEY=VALUE", table->name, has_name ? "NAME." : ""));
    return nullptr;
  }
  if (table->many) return find_element(root, key, parts[0], parts[1], complaints);
  if (table->named) return find_named(root, key, parts[0], parts[1], complaints);
  if (!root.contains(parts[0])) root.insert(parts[0], toml::table{});
  return root[parts[0]].as_table();  // a file that has something else there is complained about when it is read
}

void apply_override(toml::table& root, const std::string& text, Complaints& complaints) {
  const auto equals = text.find('=');
  const std::string key(trimmed(std::string_view(text).substr(0, equals)));
  if (equals == std::string::npos || key.empty()) {
    return complaints.add_override(text, "write --set KEY=VALUE, for example --set blank.size=[100,200]");
  }
  toml::table* place = find_place(root, key, complaints);
  if (place == nullptr) return;
  auto value = parse_value(key, std::string(trimmed(std::string_view(text).substr(equals + 1))), complaints);
  if (!value) return;
  // Moved, not copied: a copy would forget its source.
  std::move(*value->get("value")).visit([&](auto&& node) {
    place->insert_or_assign(split_at_dots(key).back(), std::forward<decltype(node)>(node));
  });
}

}  // namespace

void apply_overrides(toml::table& root, const std::vector<std::string>& overrides, Complaints& complaints) {
  for (const auto& text : overrides) apply_override(root, text, complaints);
}

std::vector<std::string> coarsened(const Scene& scene, double factor) {
  const auto line = [factor](const std::string& key, const std::array<double, 2>& coarsening) {
    return fmt::format("{}.coarsening=[{:.17g},{:.17g}]", key, factor * coarsening[0], factor * coarsening[1]);
  };
  std::vector<std::string> lines = {line("blank", scene.blank.coarsening)};
  for (std::size_t k = 0; k < scene.ply.size(); ++k)
    lines.push_back(line(fmt::format("ply.{}", k), scene.ply[k].blank.coarsening));
  return lines;
}

}  // namespace weaveform
