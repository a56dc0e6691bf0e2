#include "core/keys/advice.hpp"

#include <cmath>

namespace weaveform {
namespace {

constexpr double rounding = 1e-12;  // relative; what is a round number but for the last bits is one

// 1e5 of 123456 with one digit: what the last digit counts.
double last_digit(double value, int digits) {
  return std::pow(10.0, std::floor(std::log10(std::abs(value))) - (digits - 1));
}

}  // namespace

double rounded_up(double value, int digits) {
  if (value == 0.0 || !std::isfinite(value)) return value;
  const double unit = last_digit(value, digits);
  return std::ceil(value / unit - rounding * std::abs(value / unit)) * unit;
}

double rounded_down(double value, int digits) {
  return -rounded_up(-value, digits);
}

}  // namespace weaveform
