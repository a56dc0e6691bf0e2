// Linear modulus of straight yarns from their tensile tests.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fabric/identify/curve.hpp"

namespace weaveform::identify {

// One specimen: s = E (e - toe) by least squares over its elastic part.
struct YarnSpecimen {
  std::string name;
  std::vector<double> strain;                  // 1; true, ln(1 + l/l0)
  std::vector<double> stress;                  // MPa; over the section the law means
  std::array<double, 2> elastic = {0.0, 0.0};  // 1; strains between which the line was fitted
  std::size_t points = 0;                      // in the elastic part
  double modulus = 0.0;                        // MPa
  double modulus_error = 0.0;                  // MPa; standard error from the residuals, correlated as they are
  double freedom = 0.0;                        // degrees of freedom of that error
  double toe = 0.0;                            // 1; where the line meets zero stress: the slack taken out
  double scatter = 0.0;                        // MPa; root mean square of the residuals
  std::vector<std::string> notes;
};

struct YarnFit {
  std::string test;
  double section = 0.0;  // mm^2; that turned force into stress
  bool true_stress = true;
  bool range_given = false;
  std::vector<YarnSpecimen> specimens;
  double modulus = 0.0;                     // MPa; mean of the specimens
  double deviation = 0.0;                   // MPa; standard deviation between them, 0 for one
  std::array<double, 2> band = {0.0, 0.0};  // MPa; confidence interval of the mean modulus
  std::vector<std::string> warnings;
  [[nodiscard]] double greatest_stress() const;  // MPa; that any specimen bore
};

// Specimens are the independent units: the interval is Student's t over their moduli. One specimen alone has only its
// residuals, whose correlation shortens what they are worth. `confidence` in (0, 1).
[[nodiscard]] YarnFit fit_yarn(const TestSpec& test, const std::filesystem::path& fit_file, double section,
                               double confidence);

// The elastic part of a stress-strain curve, as strains: of all stretches that begin and end on multiples of 5 % of the
// greatest stress, between 5 and 90 %, the widest in stress whose best parabola leaves its chord by less than 1 % of
// the stretch's rise. Throws InputError when there is none.
[[nodiscard]] std::array<double, 2> elastic_part(const std::vector<double>& strain, const std::vector<double>& stress,
                                                 const std::string& specimen);

}  // namespace weaveform::identify
