#include "app/study/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/keys/nearest_name.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "post/output/summary.hpp"
#include "solver/result/file_names.hpp"
#include "solver/result/result.hpp"

namespace weaveform::study {

namespace {

std::optional<double> number_of(const nlohmann::json& json) {
  if (json.is_null()) return std::numeric_limits<double>::quiet_NaN();
  if (json.is_boolean()) return json.get<bool>() ? 1.0 : 0.0;
  if (json.is_number()) return json.get<double>();
  return std::nullopt;
}

// The number at the end of the path. A name in the file may itself hold dots, so each name that fits is followed.
std::optional<double> find_number(const nlohmann::json& json, const std::string& path) {
  if (path.empty()) return number_of(json);
  if (!json.is_structured()) return std::nullopt;
  for (const auto& item : json.items()) {
    const std::string& name = item.key();
    if (!path.starts_with(name)) continue;
    const bool ends = path.size() == name.size();
    if (!ends && path[name.size()] != '.') continue;
    const auto found = find_number(item.value(), ends ? "" : path.substr(name.size() + 1));
    if (found) return found;
  }
  return std::nullopt;
}

void list_numbers(const nlohmann::json& json, const std::string& path, std::vector<std::string>& names) {
  if (number_of(json)) names.push_back(path);
  if (!json.is_structured()) return;
  for (const auto& item : json.items())
    list_numbers(item.value(), path.empty() ? item.key() : path + "." + item.key(), names);
}

nlohmann::json read_summary(const std::filesystem::path& file) {
  nlohmann::json json = nlohmann::json::parse(read_text_file(file), nullptr, false);
  if (json.is_discarded()) throw InputError(fmt::format("{}: not JSON; run the case again", file.string()));
  return json;
}

double from_summary(const std::filesystem::path& file, const std::string& name) {
  const nlohmann::json json = read_summary(file);
  if (const auto number = find_number(json, name)) return *number;
  std::vector<std::string> names;
  list_numbers(json, "", names);
  throw InputError(fmt::format("no number '{}' in summary.json{}", name, did_you_mean(name, names)));
}

// "top.force_N" of "last(top.force_N)", or "" when the name is not of this form.
std::string argument_of(const std::string& name, const std::string& function) {
  const bool form = name.starts_with(function + "(") && name.ends_with(")");
  return form ? name.substr(function.size() + 1, name.size() - function.size() - 2) : "";
}

double from_history(const std::filesystem::path& file, const std::string& function, const std::string& column) {
  const History history = read_history(file);
  if (history.index(column) < 0)
    throw InputError(fmt::format("no column '{}' in history.csv{}", column, did_you_mean(column, history.column)));
  const std::vector<double> values = history.values(column);
  if (values.empty()) throw InputError(fmt::format("{}: has no row; run the case again", file.string()));
  if (function == "last") return values.back();
  return function == "max" ? *std::max_element(values.begin(), values.end())
                           : *std::min_element(values.begin(), values.end());
}

}  // namespace

double measure(const std::filesystem::path& directory, const std::string& name) {
  for (const char* function : {"last", "max", "min"}) {
    const std::string column = argument_of(name, function);
    if (!column.empty()) return from_history(directory / file_name::history, function, column);
  }
  return from_summary(directory / file_name::summary, name);
}

std::vector<std::string> warnings_of(const std::filesystem::path& directory) {
  const std::filesystem::path file = directory / file_name::summary;
  const nlohmann::json json = read_summary(file);
  const auto found = json.find("warnings");
  const auto is_text = [](const nlohmann::json& item) { return item.is_string(); };
  if (found == json.end() || !found->is_array() || !std::all_of(found->begin(), found->end(), is_text))
    throw InputError(fmt::format("{}: has no list of warnings; run the case again", file.string()));
  return found->get<std::vector<std::string>>();
}

std::vector<std::string> default_measures(const Scene& scene) {
  std::vector<std::string> names = {"max_shear_angle_deg"};
  for (const GripSpec& grip : scene.grip) names.push_back("grips." + grip.name + ".force_N");
  if (scene.frame) names.push_back("last(" + scene.frame->grip + ".force_N)");
  for (const ToolSpec& tool : scene.tools) names.push_back("tools." + tool.name + ".force_N");
  return names;
}

double mesh_size(const std::filesystem::path& directory) {
  const Mesh mesh = read_mesh(directory / file_name::mesh);
  return std::sqrt(mesh.spacing[0] * mesh.spacing[1]);
}

}  // namespace weaveform::study
