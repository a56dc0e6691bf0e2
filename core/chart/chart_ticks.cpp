#include "core/chart/chart_ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace weaveform {
namespace {

std::string superscript(int exponent) {
  constexpr std::array digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(exponent))) text += digits[static_cast<std::size_t>(c - '0')];
  return text;
}

// As a power of ten where `powers` asks for one, or the digits would be too many.
std::string tick_label(double value, bool powers) {
  if (value == 1.0 || (!powers && value >= 1e-4 && value < 1e5)) return fmt::format("{:.6g}", value);
  const int exponent = static_cast<int>(std::floor(std::log10(value) + 1e-9));
  const std::string mantissa = fmt::format("{:.6g}", value / std::pow(10.0, exponent));
  return (mantissa == "1" ? "10" : mantissa + "×10") + superscript(exponent);
}

// Steps of 1, 2 or 5 times a power of ten, some five of them.
std::vector<double> round_steps(double from, double to) {
  const double raw = (to - from) / 5.0, power = std::pow(10.0, std::floor(std::log10(raw)));
  double step = power;
  for (const double factor : {2.0, 5.0, 10.0})
    if (step < raw * (1.0 - 1e-9)) step = factor * power;
  std::vector<double> values;
  for (double n = std::ceil(from / step - 1e-9); n * step <= to * (1.0 + 1e-12); ++n) values.push_back(n * step);
  return values;
}

}  // namespace

std::vector<ChartTick> log_ticks(double from, double to) {
  const double decades = std::log10(to / from);
  std::vector<ChartTick> ticks;
  if (decades < 0.6) {
    for (const double value : round_steps(from, to)) ticks.push_back({value, tick_label(value, false)});
    return ticks;
  }
  const bool powers = decades >= 2.5 && (from < 1e-4 || to >= 1e5);           // of one kind along the axis
  const int every = std::max(1, static_cast<int>(std::ceil(decades / 9.0)));  // decades between labels
  const std::vector<int> labelled = decades >= 2.5   ? std::vector{1}
                                    : decades >= 1.3 ? std::vector{1, 2, 5}
                                                     : std::vector{1, 2, 3, 4, 5, 6, 8};
  const int first = static_cast<int>(std::floor(std::log10(from))), last = static_cast<int>(std::ceil(std::log10(to)));
  for (int power = first; power <= last; ++power) {
    for (int factor = 1; factor <= (every == 1 ? 9 : 1); ++factor) {
      const double value = factor * std::pow(10.0, power);
      if (value < from * (1.0 - 1e-9) || value > to * (1.0 + 1e-9)) continue;
      const bool named = power % every == 0 && std::count(labelled.begin(), labelled.end(), factor) > 0;
      ticks.push_back({value, named ? tick_label(value, powers) : ""});
    }
  }
  return ticks;
}

}  // namespace weaveform
