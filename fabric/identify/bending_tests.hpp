// Specimens of bending tests, each with the moment-curvature curve that it shows: tables of moment against curvature
// here, shapes of hanging strips in hanging_strip.hpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fabric/identify/bending_curve.hpp"
#include "fabric/identify/fit_spec.hpp"

namespace weaveform::identify {

struct BendingSpecimen {
  std::string name = {};
  BentSense sense = BentSense::both;  // the side that was bent outwards
  // 1/mm, N per width; the specimen's own curve from 0, linear between; without friction where the record holds a loop
  std::vector<double> curve_curvature = {}, curve_moment = {};
  double first_stiffness = 0.0;                     // N mm
  double reach = 0.0;                               // 1/mm; the greatest curvature that the specimen shows
  double misfit = 0.0;                              // N for tables, mm for shapes; root mean square of what is left
  std::optional<BendingFriction> friction = {};     // N per width, 1/mm; of records that go to and fro
  std::vector<double> curvature = {}, moment = {};  // 1/mm, N; as measured (tables), for charts
  std::vector<double> error_curvature = {},
                      error = {};  // 1/mm, N; standard error of the curve from this specimen alone
  double freedom = 0.0;            // degrees of freedom of that error
  std::vector<std::string> notes = {};
  // Of a record of both senses that says which is which: its curve with the face outwards and that with the back outwards.
  // The curve above is the odd part then.
  std::vector<BendingSpecimen> half = {};
};

// Curves of a [[moment_curvature]]. Records may go one way or both, once or to and fro; a loop tells friction from the
// rest. Of a record that goes both ways `sense` is the side that is bent outwards at positive curvatures; where it is given,
// specimens have their two halves. A toe (clamps that let the strip turn before they hold it) is taken out, said in a note.
// Throws InputError for all files at once: units that cannot be right, moments against the curvature, too few points.
// `alone`: the errors of each curve are wanted.
[[nodiscard]] std::vector<BendingSpecimen> moment_curvature_specimens(const TestSpec& test, const FitSpec& spec,
                                                                      bool alone);

// The standard error of a specimen's curve by the delta method on the fit's residuals, at evenly spaced curvatures; of the
// fit's back curve when `of_back`.
void add_errors(const BendingCurveFit& fit, BendingSpecimen& specimen, bool of_back = false);

// N; what the specimen's own curve says at a curvature, and its own standard error there.
[[nodiscard]] double moment_at(const BendingSpecimen& specimen, double curvature);
[[nodiscard]] double error_at(const BendingSpecimen& specimen, double curvature);

// Throws InputError when the bending length (B/w)^(1/3) of a first stiffness B (N mm) is none that a fabric of that
// weight (N/mm^2) has; `units` says what to ask about.
void ask_about_stiffness(const std::string& specimen, double stiffness, double weight, const std::string& question);
[[nodiscard]] bool plausible_stiffness(double stiffness, double weight);

}  // namespace weaveform::identify
