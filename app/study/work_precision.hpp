// Work-precision charts: what each case costs (s of its solve) against its error relative to a reference, on
// logarithmic axes, with the Pareto front named: the cases that no other beats in time and error.
#pragma once

#include <string>
#include <vector>

#include "app/study/convergence_report.hpp"
#include "app/study/table.hpp"
#include "mesher/base/chart.hpp"

namespace weaveform::study {

struct WorkPoint {
  std::size_t row = 0;     // of the table
  double time = 0.0;       // s
  double reference = 0.0;  // what the result should be,
  double error = 0.0;      // |result − reference|/|reference|
  double floor = 0.0;      // and the reference's own relative uncertainty: errors below it mean nothing
  bool on_front = false;
};

struct WorkPrecision {
  std::string measure;
  std::vector<WorkPoint> point;
};

// Of every done case but the reference case itself. Measures or groups whose limit is not known give no points, and a
// line in `complaints`. Throws InputError unless [work_precision.case] picks one done case.
[[nodiscard]] std::vector<WorkPrecision> work_precision_of(const Study& study, const std::vector<std::string>& measures,
                                                           const std::vector<ConvergenceOf>& convergence,
                                                           const Table& table, std::vector<std::string>& complaints);

[[nodiscard]] Chart work_precision_chart(const WorkPrecision& one, const Table& table);
[[nodiscard]] std::string work_precision_csv(const std::vector<WorkPrecision>& all, const Table& table);

// "work_precision_grips.top.force_N.svg": characters that a file name should not have become '_'.
[[nodiscard]] std::string chart_name(const std::string& measure);

}  // namespace weaveform::study
