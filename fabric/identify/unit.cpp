#include "fabric/identify/unit.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <numbers>
#include <stdexcept>

namespace weaveform::identify {
namespace {

constexpr double gram_force = 9.80665e-3;        // N; standard gravity, CGPM 1901
constexpr double pound_force = 4.4482216152605;  // N

// "gf.cm/cm", "gf*cm/cm" and "gf·cm/cm" are written as "gf cm/cm" here.
std::string with_blanks(const std::string& written) {
  std::string heading;
  for (std::size_t i = 0; i < written.size(); ++i) {
    const auto letter = [&](std::size_t at) {
      return at < written.size() && std::isalpha(static_cast<unsigned char>(written[at])) != 0;
    };
    if (written.compare(i, 2, "\xc2\xb7") == 0) {
      heading += ' ';
      ++i;
    } else if (written[i] == '*' || (written[i] == '.' && i > 0 && letter(i - 1) && letter(i + 1))) {
      heading += ' ';
    } else {
      heading += written[i];
    }
  }
  return heading;
}

}  // namespace

const std::vector<Unit>& units_of(Quantity quantity) {
  static const std::map<Quantity, std::vector<Unit>> units = {
      {Quantity::length, {{"mm", 1.0}, {"cm", 10.0}, {"m", 1e3}, {"um", 1e-3}, {"in", 25.4}}},
      {Quantity::force,
       {{"N", 1.0},
        {"kN", 1e3},
        {"cN", 1e-2},
        {"mN", 1e-3},
        {"gf", gram_force},
        {"kgf", 1e3 * gram_force},
        {"lbf", pound_force}}},
      {Quantity::angle, {{"deg", std::numbers::pi / 180.0}, {"rad", 1.0}}},
      {Quantity::strain, {{"1", 1.0}, {"%", 0.01}, {"mm/mm", 1.0}, {"um/m", 1e-6}}},
      {Quantity::stress, {{"MPa", 1.0}, {"GPa", 1e3}, {"kPa", 1e-3}, {"Pa", 1e-6}}},
      {Quantity::force_per_length, {{"N/mm", 1.0}, {"N/m", 1e-3}, {"kN/m", 1.0}, {"N/cm", 0.1}}},
      {Quantity::curvature,
       {{"1/m", 1e-3},
        {"1/cm", 0.1},
        {"1/mm", 1.0},
        {"m^-1", 1e-3},
        {"cm^-1", 0.1},
        {"mm^-1", 1.0},
        {"m-1", 1e-3},
        {"cm-1", 0.1},
        {"mm-1", 1.0},
        {"rad/m", 1e-3},
        {"rad/mm", 1.0}}},
      {Quantity::moment,
       {{"N mm", 1.0},
        {"N m", 1e3},
        {"N cm", 10.0},
        {"mN m", 1.0},
        {"mN mm", 1e-3},
        {"cN cm", 0.1},
        {"gf cm", 10.0 * gram_force}}},
      {Quantity::moment_per_length,
       {{"N m/m", 1.0},
        {"N mm/mm", 1.0},
        {"N cm/cm", 1.0},
        {"N", 1.0},
        {"N mm/m", 1e-3},
        {"N mm/cm", 0.1},
        {"mN m/m", 1e-3},
        {"mN mm/mm", 1e-3},
        {"mN", 1e-3},
        {"cN cm/cm", 1e-2},
        {"cN", 1e-2},
        {"gf cm/cm", gram_force},
        {"gf", gram_force}}},
  };
  return units.at(quantity);
}

std::vector<std::string> unit_names(Quantity quantity) {
  std::vector<std::string> names;
  for (const auto& unit : units_of(quantity)) names.push_back(unit.name);
  return names;
}

double unit_factor(Quantity quantity, const std::string& name) {
  for (const auto& unit : units_of(quantity)) {
    if (unit.name == name) return unit.factor;
  }
  throw std::invalid_argument("no unit " + name);
}

std::optional<std::string> unit_in(const std::string& written, Quantity quantity) {
  const std::string heading = with_blanks(written);
  std::optional<std::string> found;
  for (const auto& unit : units_of(quantity)) {
    if (unit.name == "1") continue;  // a heading that ends in 1 counts something
    std::string spelled = unit.name;
    if (const auto slash = spelled.find('/'); slash != std::string::npos) spelled.replace(slash, 1, "_per_");
    std::replace(spelled.begin(), spelled.end(), ' ', '_');
    const bool named = heading == unit.name || heading == "(" + unit.name + ")" ||
                       heading.find("(" + unit.name + ")") != std::string::npos ||
                       heading.find("[" + unit.name + "]") != std::string::npos || heading.ends_with("_" + spelled) ||
                       heading.ends_with(" " + unit.name);
    if (named && (!found || unit.name.size() > found->size())) found = unit.name;
  }
  return found;
}

std::string fitting_units(Quantity quantity, const std::string& declared,
                          const std::function<bool(double ratio)>& plausible) {
  std::string text;
  const double now = unit_factor(quantity, declared);
  for (const auto& unit : units_of(quantity)) {
    if (unit.factor == now || !plausible(unit.factor / now)) continue;
    text += (text.empty() ? "" : " or ") + unit.name;
  }
  return text.empty() ? "" : " (" + text + " would fit)";
}

}  // namespace weaveform::identify
