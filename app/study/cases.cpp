#include "app/study/cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "fabric/card/card.hpp"
#include "mesher/resolve/stack_laws.hpp"
#include "mesher/scene/reader.hpp"

namespace weaveform::study {

namespace {

constexpr std::size_t most_cases = 100000;

// FNV-1a, 64 bit (Fowler, Noll & Vo 1991): the same on every machine. Among 10^5 cases two share it with probability
// 3e-10, and then the texts tell them apart (runner.cpp).
std::uint64_t digest(const std::string& text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return hash;
}

std::string file_line(const std::filesystem::path& file) {
  return fmt::format("# {}: digest {:016x}\n", file.string(), digest(read_text_file(file)));
}

// All points of the product that begin with `variant`, from the given axis on.
void combine(const std::vector<Axis>& axes, std::size_t axis, const Variant& variant, std::vector<Variant>& all) {
  if (axis == axes.size()) {
    all.push_back(variant);
    return;
  }
  for (const Variant& point : axes[axis].point) {
    Variant joined = variant;
    joined.settings.insert(joined.settings.end(), point.settings.begin(), point.settings.end());
    if (!point.series.empty()) joined.series = point.series;
    combine(axes, axis + 1, joined, all);
  }
}

// A complaint about an override is one about the value in the study file that became it.
void complain(const std::string& line, const Settings& settings, Complaints& complaints,
              std::vector<std::string>& others) {
  for (const Setting& setting : settings) {
    const std::string begin = fmt::format("{}{}: ", override_mark, setting.key);
    if (line.starts_with(begin))
      return complaints.add(setting.where, fmt::format("{}: {}", setting.key, line.substr(begin.size())));
  }
  if (std::find(others.begin(), others.end(), line) == others.end()) others.push_back(line);
}

}  // namespace

const Setting* setting_of(const Case& one, const std::string& key) {
  const auto found = std::find_if(one.settings.begin(), one.settings.end(),
                                  [&](const Setting& setting) { return setting.key == key; });
  return found == one.settings.end() ? nullptr : &*found;
}

std::string describe(const Case& one) {
  std::string text;
  for (const Setting& setting : one.settings)
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", setting.key, setting.value);
  return text.empty() ? "the scene as it is" : text;
}

std::string case_text(const Scene& scene) {
  const Scene whole = with_absolute_paths(scene);
  std::string text = scene_to_toml(whole);
  const auto add = [&](const FabricSpec& fabric, const BlankSpec& blank) {
    if (!is_builtin_card(fabric.material)) text += file_line(fabric.material);
    if (!blank.outline.empty()) text += file_line(blank.outline);
  };
  add(whole.fabric, whole.blank);
  for (const PlySpec& ply : whole.ply) add(ply.fabric, ply.blank);
  for (const std::string& law : law_files(whole)) text += file_line(law);
  for (const ToolSpec& tool : whole.tools)
    if (!tool.file.empty()) text += file_line(tool.file);
  return text;
}

std::string case_name(const std::string& text) {
  return fmt::format("{:016x}", digest(text));
}

std::vector<Case> expand(const Study& study) {
  return cases_of(study, read_text_file(scene_path(study)), combinations(study));
}

std::vector<Variant> combinations(const Study& study) {
  std::size_t count = 1;
  for (const Axis& axis : study.axes) count = std::min(count * axis.point.size(), most_cases + 1);
  if (count > most_cases)
    throw InputError(fmt::format("{}: more than {} cases; vary less at once", study.file.string(), most_cases));
  std::vector<Variant> all;
  combine(study.axes, 0, {}, all);
  return all;
}

std::vector<Case> cases_of(const Study& study, const std::string& scene_text, const std::vector<Variant>& variants) {
  const std::string scene_file = scene_path(study).string();
  Complaints complaints(study.file.string());
  std::vector<std::string> others;  // about the scene itself
  std::vector<Case> cases;
  for (const Variant& variant : variants) {
    Settings settings = study.set;
    settings.insert(settings.end(), variant.settings.begin(), variant.settings.end());
    std::vector<std::string> overrides;
    for (const Setting& setting : settings) overrides.push_back(setting.override_text());
    try {
      const std::string text = case_text(read_scene_text(scene_text, scene_file, overrides));
      cases.push_back({case_name(text), text, variant.settings, variant.series});
    } catch (const InputError& error) {
      for (const std::string& line : error.complaints()) complain(line, settings, complaints, others);
    }
  }
  if (!others.empty()) {
    try {
      complaints.throw_if_any();
    } catch (const InputError& error) {
      others.insert(others.end(), error.complaints().begin(), error.complaints().end());
    }
    throw InputError(others);
  }
  complaints.throw_if_any();
  return cases;
}

}  // namespace weaveform::study
