// How wide the step of a profile is.
#pragma once

#include <array>
#include <vector>

namespace weaveform::dic {

// Width of the step of a profile between its ends: distance between the places where it has gone 10 and 90 % of the way
// from the mean over its first to that over its last fifth. Not a number when the ends do not differ by half a degree.
[[nodiscard]] double step_width(const std::vector<double>& distance, const std::vector<double>& angle);
// The same with the angles on both sides given.
[[nodiscard]] double step_width(const std::vector<double>& distance, const std::vector<double>& angle, double from,
                                double to);
// Means over a profile's first and last fifth.
[[nodiscard]] std::array<double, 2> end_angles(const std::vector<double>& angle);

}  // namespace weaveform::dic
