#include "mesher/scene/scene_name.hpp"

#include <nlohmann/json.hpp>
#include <string_view>

namespace weaveform {
namespace {

constexpr std::string_view mark = "# Scene: ";

}  // namespace

std::string scene_name_line(const std::string& name) {
  return std::string(mark) + nlohmann::json(name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string scene_name_in(const std::string& text) {
  const auto at = text.find(mark);
  if (at == std::string::npos) return "";
  const auto begin = at + mark.size();
  const auto found = nlohmann::json::parse(text.substr(begin, text.find('\n', begin) - begin), nullptr, false);
  return found.is_string() ? found.get<std::string>() : "";
}

}  // namespace weaveform
