// Time against error: what each case costs (s of its solve) and how far it is from what it should be, with the Pareto
// front: the cases that no other beats in time and error.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/study/references.hpp"

namespace weaveform::study {

struct WorkPoint {
  std::size_t row = 0;     // of the table
  double time = 0.0;       // s
  double reference = 0.0;  // what the result should be,
  double error = 0.0;      // |result − reference|, over |reference| unless the measure is an `absolute` one,
  double floor = 0.0;      // and the reference's own uncertainty, likewise: errors below it mean nothing
  bool on_front = false;   // errors below the floor counting as the floor
  [[nodiscard]] bool within_uncertainty() const { return error < floor; }
  // The error as far as it is known.
  [[nodiscard]] double known_error() const { return within_uncertainty() ? floor : error; }
};

struct WorkPrecision {
  std::string measure;
  std::vector<WorkPoint> point;
  std::string unit = "%";  // of errors told to people; "%": errors are relative, or those of a pure number
  [[nodiscard]] bool in_percent() const { return unit == "%"; }
};

// Of every done case that has a reference (references.hpp), which tells in `complaints` what has none. Throws
// InputError as `references` does.
[[nodiscard]] std::vector<WorkPrecision> work_precision_of(const Study& study, const std::vector<std::string>& measures,
                                                           const std::vector<ConvergenceOf>& convergence,
                                                           const Table& table, std::vector<std::string>& complaints);

// The cheapest case, of the given series ("": of all), whose error and the reference's uncertainty together are within
// the tolerance, for every one of the measures (each with its tolerance). A point of the first; nullptr: none.
[[nodiscard]] const WorkPoint* cheapest_within(std::span<const WorkPrecision> measures, const Table& table,
                                               const std::string& series, const std::vector<double>& tolerance);

// "deg" of "measures.center.shear_angle_deg" or "max(top.shear_angle_deg)"; "%" when the name tells no unit: a pure
// number.
[[nodiscard]] std::string unit_of(const std::string& measure);

}  // namespace weaveform::study
