// Angles: radians inside, degrees where people write and read them.
#pragma once

#include <numbers>

namespace weaveform {

inline constexpr double degree = std::numbers::pi / 180.0;              // rad
inline constexpr double degrees_per_radian = 180.0 / std::numbers::pi;  // not 1/degree, which is rounded elsewhere

}  // namespace weaveform
