#include "core/json/toml_json.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>
#include <vector>

#include "core/keys/toml_document.hpp"

namespace weaveform {
namespace {

using Json = nlohmann::ordered_json;

Json json_of_node(const toml::node& node);

// toml++ keeps a table's keys by their names; people read them in the order of the text.
Json json_of_table(const toml::table& table) {
  std::vector<std::pair<std::string, const toml::node*>> entries;
  for (const auto& [name, node] : table) entries.emplace_back(name.str(), &node);
  std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
    const auto &one = a.second->source().begin, &other = b.second->source().begin;
    return one.line != other.line ? one.line < other.line : one.column < other.column;
  });
  Json json = Json::object();
  for (const auto& [name, node] : entries) json[name] = json_of_node(*node);
  return json;
}

// JSON has neither dates nor times: they are text.
std::string text_of_node(const toml::node& node) {
  std::ostringstream text;
  node.visit([&](const auto& value) {
    if constexpr (toml::is_value<decltype(value)>) text << value;
  });
  return text.str();
}

Json json_of_node(const toml::node& node) {
  if (const auto* table = node.as_table()) return json_of_table(*table);
  if (const auto* list = node.as_array()) {
    Json json = Json::array();
    for (const auto& item : *list) json.push_back(json_of_node(item));
    return json;
  }
  if (const auto* word = node.as_string()) return Json(word->get());
  if (const auto* whole = node.as_integer()) return Json(whole->get());
  if (const auto* number = node.as_floating_point()) return Json(number->get());
  if (const auto* truth = node.as_boolean()) return Json(truth->get());
  return Json(text_of_node(node));
}

}  // namespace

Json toml_file_json(const std::string& text, const std::string& name) {
  return json_of_table(parse_toml(text, name));
}

Json toml_value_json(const std::string& value) {
  if (value.empty()) return nullptr;
  return toml_file_json("value = " + value, "value").at("value");
}

}  // namespace weaveform
