// Units of measured columns and their factors to mm, N, MPa, rad.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace weaveform::identify {

enum class Quantity { length, force, angle, strain, stress, force_per_length, curvature, moment, moment_per_length };

// Value in the project's unit (mm, N, rad, 1, MPa, N/mm, 1/mm, N mm, N) = factor * value as written.
struct Unit {
  std::string name;
  double factor = 1.0;
};

[[nodiscard]] const std::vector<Unit>& units_of(Quantity quantity);
[[nodiscard]] std::vector<std::string> unit_names(Quantity quantity);
// The name must be one of them.
[[nodiscard]] double unit_factor(Quantity quantity, const std::string& name);

// The unit of that quantity a heading names, as in "Load (kN)", "force [N]", "force_N" or "shear_force_N_per_mm".
// Units that differ in their spelling alone have the same factor.
[[nodiscard]] std::optional<std::string> unit_in(const std::string& heading, Quantity quantity);

// For a question back to the user: units that would make the values plausible, e.g. " (kN or kgf would fit)"; "" when
// none does. `plausible(ratio)` judges the values times `ratio`.
[[nodiscard]] std::string fitting_units(Quantity quantity, const std::string& declared,
                                        const std::function<bool(double ratio)>& plausible);

}  // namespace weaveform::identify
