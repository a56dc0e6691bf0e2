// The little statistics a fit needs: spread of a few specimens, Student's t, correlated residuals.
#pragma once

#include <vector>

namespace weaveform::identify {

[[nodiscard]] double mean_of(const std::vector<double>& values);
// Standard deviation of a sample (n - 1); zero for fewer than two values.
[[nodiscard]] double deviation_of(const std::vector<double>& values);
[[nodiscard]] double median_of(std::vector<double> values);
[[nodiscard]] double root_mean_square(const std::vector<double>& values);

// P(T <= t) of Student's t with `freedom` > 0 degrees of freedom, through the incomplete beta function
// (Abramowitz & Stegun 1964, 26.7.1 and 26.5.8). Freedom need not be whole.
[[nodiscard]] double student_probability(double t, double freedom);
// The t of a two-sided interval: P(|T| <= t) = confidence, 0 < confidence < 1.
[[nodiscard]] double student_t(double confidence, double freedom);

// Correlation of neighbouring residuals of a fit with `parameters` free ones, in [0, 0.99]. The fit itself pulls the
// estimate down, by about (1 + 3 rho + parameters (1 + rho)) / n (Marriott & Pope 1954 for the mean alone, extended by
// the degrees of freedom taken); that much is given back.
[[nodiscard]] double neighbour_correlation(const std::vector<double>& residuals, int parameters);
// Number of independent values that n values with that correlation are worth: n (1 - rho) / (1 + rho) (Bayley &
// Hammersley 1946).
[[nodiscard]] double effective_count(double n, double correlation);

}  // namespace weaveform::identify
