#include "mesher/scene/values.hpp"

#include <toml++/toml.h>

#include <sstream>

#include "core/keys/toml_document.hpp"
#include "mesher/scene/reader.hpp"

namespace weaveform {

namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

bool is_list_of_tables(const toml::node& node) {
  const toml::array* list = node.as_array();
  return list != nullptr && !list->empty() && list->get(0)->is_table();
}

void flatten(const toml::table& table, const std::string& path, Values& values);

void flatten_list(const toml::array& list, const std::string& path, Values& values) {
  for (std::size_t k = 0; k < list.size(); ++k) {
    const toml::table& element = *list.get(k)->as_table();
    const auto name = element["name"].value<std::string>();
    flatten(element, path + "." + name.value_or(std::to_string(k)), values);
  }
}

void flatten(const toml::table& table, const std::string& path, Values& values) {
  for (const auto& [key, node] : table) {
    const std::string here = path.empty() ? std::string(key.str()) : path + "." + std::string(key.str());
    if (const toml::table* inner = node.as_table()) {
      flatten(*inner, here, values);
    } else if (is_list_of_tables(node)) {
      flatten_list(*node.as_array(), here, values);
    } else {
      std::ostringstream text;
      node.visit([&](const auto& value) { text << value; });
      values.emplace_back(here, text.str());
    }
  }
}

}  // namespace

Values scene_values(const Scene& scene) {
  Values values;
  flatten(parse_toml(scene_to_toml(scene), "scene"), "", values);
  return values;
}

}  // namespace weaveform
