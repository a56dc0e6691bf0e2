// The shear law of a fabric from its specimens: brought to a common grid of angles, averaged, fitted by each form asked
// for, compared, and given a confidence band.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fabric/identify/choices.hpp"
#include "fabric/identify/shear_curve.hpp"
#include "fabric/trellis/bias_rectangle.hpp"
#include "fabric/trellis/shear_frame.hpp"

namespace weaveform::identify {

struct ShearSpecimen {
  std::string name;
  std::vector<double> angle;           // rad; as measured
  std::vector<double> value;           // MPa, or N for a load; as measured
  std::vector<ShearObservation> grid;  // the same on the common grid, angles equal for all specimens
  std::vector<std::string> notes;
  std::optional<BiasRectangle> rectangle = {};  // of a bias extension
  std::optional<ShearFrame> frame = {};         // of a shear frame whose size is known
};

struct FormFit {
  ShearForm form;
  ShearCurveFit pooled;                 // all specimens together
  std::vector<ShearCurve> of_specimen;  // each alone
  double misfit = 0.0;                  // root mean square of the mean curve's residuals, in the observations' unit
  double aicc = 0.0;                    // Akaike's criterion, corrected (Hurvich & Tsai 1989); lower is better
  std::optional<double> left_out;       // root mean square error on a specimen left out, from three specimens on
};

// The law at one angle of the grid.
struct LawPoint {
  double angle = 0.0, strain = 0.0;    // rad, 1
  double stress = 0.0, tangent = 0.0;  // MPa
  double half_band = 0.0;              // MPa; of the confidence interval at this angle alone
  double half_whole = 0.0;             // MPa; of a band for the whole curve at once
  // On the specimens' own grid, in the observations' unit:
  double mean = 0.0, deviation = 0.0;  // of the specimens' values
  double predicted = 0.0;              // mean of what the law gives for the specimens
};

struct ShearFit {
  std::vector<ShearSpecimen> specimens;
  FormFit polynomial;
  std::optional<FormFit> with_start;
  bool start_chosen = false;
  std::string reason;  // why that form, in a sentence
  std::vector<LawPoint> law;
  double end = 0.0;          // 1; strain to which the law is fitted and its tangent positive
  double freedom = 0.0;      // degrees of freedom of the band
  double correlation = 0.0;  // of neighbouring residuals of the mean curve
  std::vector<std::string> warnings;
  [[nodiscard]] const FormFit& chosen() const { return start_chosen ? *with_start : polynomial; }
  [[nodiscard]] double greatest_angle() const { return law.back().angle; }  // rad
};

// Angles of the common grid: multiples of `step` that all specimens have measured, within [from, to] (rad). Without a
// range, all of them. Throws InputError when fewer than ten are left; warns when one specimen ends long before the
// others.
[[nodiscard]] std::vector<double> common_grid(const std::vector<ShearSpecimen>& specimens,
                                              const std::optional<std::array<double, 2>>& range, double step,
                                              std::vector<std::string>& warnings);

// The value of a measured curve at x: the best parabola through the points within `half` of it when there are six or
// more around it (which averages noise away), else interpolated between the neighbours.
[[nodiscard]] double local_value(const std::vector<double>& x, const std::vector<double>& y, double at, double half);

// Specimens with their grids filled.
//
// The fit of the pooled specimens is the fit of their mean, because they share the grid. Specimens are the independent
// units: at an angle the interval is Student's t over the specimens' own curves, which covers whatever correlation
// there is within a curve; the band for the whole curve is the same with the confidence divided among the coefficients
// (Bonferroni). One specimen alone has only its residuals: their covariance is widened by the correlation of
// neighbours.
//
// The law is tabulated at `law_angles` (rad), or on the specimens' grid when there are none.
[[nodiscard]] ShearFit fit_shear(std::vector<ShearSpecimen> specimens, int degree, FormAsked form, double confidence,
                                 const std::vector<double>& law_angles = {});

}  // namespace weaveform::identify
