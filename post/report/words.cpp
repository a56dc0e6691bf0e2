#include "post/report/words.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

namespace weaveform {
namespace {

struct Words {
  std::string what, unit;
  [[nodiscard]] std::string text() const { return unit.empty() ? what : what + " (" + unit + ")"; }
};

// The longest that fits comes first.
constexpr std::array<std::pair<std::string_view, std::string_view>, 13> unit_endings = {{{"_N_per_mm", "N/mm"},
                                                                                         {"_per_mm", "1/mm"},
                                                                                         {"_per_s", "1/s"},
                                                                                         {"_deg", "°"},
                                                                                         {"_mm2", "mm²"},
                                                                                         {"_MPa", "MPa"},
                                                                                         {"_mJ", "mJ"},
                                                                                         {"_mm", "mm"},
                                                                                         {"_ms", "ms"},
                                                                                         {"_kN", "kN"},
                                                                                         {"_N", "N"},
                                                                                         {"_s", "s"},
                                                                                         {"_t", "t"}}};

struct Quantity {
  std::string_view name, words;
};
// What grips, tools, frame and measures have.
constexpr std::array<Quantity, 14> quantities = {{{"displacement_mm", "travel of"},
                                                  {"largest_force_N", "largest force of"},
                                                  {"force_N", "force of"},
                                                  {"force_x_N", "force along x of"},
                                                  {"force_y_N", "force along y of"},
                                                  {"force_z_N", "force along z of"},
                                                  {"contact_area_mm2", "contact area of"},
                                                  {"shear_angle_deg", "shear angle of"},
                                                  {"shear_angle_sd_deg", "standard deviation of the shear angle of"},
                                                  {"shear_angle_min_deg", "least shear angle of"},
                                                  {"shear_angle_max_deg", "greatest shear angle of"},
                                                  {"sd", "standard deviation of the shear angle of"},
                                                  {"min", "least shear angle of"},
                                                  {"max", "greatest shear angle of"}}};
// Numbers of the whole run.
constexpr std::array<Quantity, 12> whole_run = {{{"max_shear_angle_deg", "greatest shear angle"},
                                                 {"max_yarn_strain", "greatest yarn strain"},
                                                 {"wall_s", "time of the solve"},
                                                 {"time_s", "time in the analysis"},
                                                 {"energy_error", "error of the energy balance"},
                                                 {"kinetic_to_internal", "kinetic over internal energy"},
                                                 {"external_work_mJ", "work of grips and tools"},
                                                 {"damping_work_mJ", "work of damping and friction"},
                                                 {"bending_friction_work_mJ", "work of friction in bending"},
                                                 {"cells_beyond_card", "cells sheared beyond the card's range"},
                                                 {"step_s", "smallest step"},
                                                 {"contact_penetration", "greatest penetration over thickness"}}};

template <std::size_t N>
std::string_view found(const std::array<Quantity, N>& list, std::string_view name) {
  const auto at = std::find_if(list.begin(), list.end(), [&](const Quantity& q) { return q.name == name; });
  return at == list.end() ? std::string_view{} : at->words;
}

std::string cut_unit(std::string& name) {
  for (const auto& [ending, unit] : unit_endings)
    if (name.size() > ending.size() && name.ends_with(ending)) {
      name.resize(name.size() - ending.size());
      return std::string(unit);
    }
  return "";
}

std::string spaced(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '_' || c == '.'; }, ' ');
  return name;
}

Words own_words(std::string name) {
  Words words;
  words.unit = cut_unit(name);
  words.what = spaced(name);
  return words;
}

std::string unit_of(std::string name) {
  if (name == "sd" || name == "min" || name == "max") return "°";
  return cut_unit(name);
}

// "punch.force_N"; a name may have dots of its own, a quantity has none.
Words column_words(const std::string& column) {
  if (const auto words = found(whole_run, column); !words.empty()) return {std::string(words), unit_of(column)};
  const std::size_t dot = column.rfind('.');
  if (dot == std::string::npos) return own_words(column);
  const std::string quantity = column.substr(dot + 1), whose = column.substr(0, dot);
  const auto words = found(quantities, quantity);
  if (words.empty()) return own_words(column);
  return {std::string(words) + " " + whose, unit_of(quantity)};
}

Words measure_words(const std::string& measure) {
  for (const auto& [call, prefix, suffix] :
       {std::array<std::string, 3>{"last(", "", " at the end"}, {"max(", "greatest ", ""}, {"min(", "least ", ""}}) {
    if (!measure.starts_with(call) || !measure.ends_with(')')) continue;
    Words words = column_words(measure.substr(call.size(), measure.size() - call.size() - 1));
    words.what = prefix + words.what + suffix;
    return words;
  }
  for (const std::string part : {"grips.", "tools.", "measures."}) {
    if (!measure.starts_with(part)) continue;
    Words words = column_words(measure.substr(part.size()));
    if (!measure.ends_with("largest_force_N")) words.what += " at the end";
    return words;
  }
  return column_words(measure);
}

}  // namespace

std::string column_in_words(const std::string& column) {
  return column_words(column).text();
}

std::string measure_in_words(const std::string& measure) {
  return measure_words(measure).text();
}

}  // namespace weaveform
