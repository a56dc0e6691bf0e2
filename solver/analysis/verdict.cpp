#include "solver/analysis/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "solver/constraint/grips.hpp"
#include "solver/contact/tool_motion.hpp"

namespace weaveform {
namespace {

constexpr double start_fraction = 0.1;     // of the duration; the energy balance is judged after it
constexpr double rounding_energy = 1e-15;  // mJ; a fabric on which nothing acts has less, and no balance to judge
constexpr double start_travel = 0.1;  // of the travel; kinetic/internal is judged after it (before, both are near zero)

}  // namespace

// Part of the travel made, the least of all grips and tools.
double Verdict::travelled(double time) const {
  const double part = time / duration_;
  double least = smooth_step(part);
  for (const auto& tool : scene_.tools)
    if (!tool.speed.empty()) least = std::min(least, travel_part(tool.speed, part));
  return least;
}

std::string Verdict::judge(const EnergyBalance& balance, double time) {
  if (!(time > start_fraction * duration_)) return "";
  const double error = balance.error();
  // not a number is judged too
  const bool judged = !(std::max({balance.internal, balance.kinetic, balance.damping}) <= rounding_energy);
  if (judged) worst_error_ = std::max(worst_error_, error);
  const bool under_way = travelled(time) > start_travel;
  if (under_way && balance.internal > 0.0) worst_ratio_ = std::max(worst_ratio_, balance.kinetic / balance.internal);
  const double limit = scene_.analysis.energy_limit;
  if (!judged || error <= limit) return "";
  return fmt::format(
      "the energy balance is off by {:.3g} % of the greatest energy (limit {:.3g} %): internal {:.4g}, kinetic {:.4g}, "
      "damping {:.4g}, external {:.4g} mJ",
      100.0 * error, 100.0 * limit, balance.internal, balance.kinetic, balance.damping, balance.external);
}

void Verdict::count_folded(const Fields& fields) {
  int folded = 0;  // std::count() takes six times as long at -Og, which this file is compiled with
  for (const bool one : fields.folded) folded += one ? 1 : 0;
  folded_ = std::max(folded_, folded);
}

void Verdict::archive(Archive& archive) {
  archive.number("an energy error", worst_error_, not_negative);
  archive.number("an energy ratio", worst_ratio_, not_negative);
  std::int64_t folded = folded_;
  archive.count("a number of folded cells", folded, 0, std::numeric_limits<int>::max());
  folded_ = static_cast<int>(folded);
}

}  // namespace weaveform
