// What the results of a study should be, by [work_precision]: limits, a case, or given values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/study/convergence_report.hpp"
#include "app/study/table.hpp"

namespace weaveform::study {

struct Reference {
  double value = 0.0;
  double uncertainty = 0.0;  // of the value, in its unit
};

// For each row of the table what its measure should be; none for cases that are not done, for the reference case
// itself, and where no limit is known (fewer than three levels), which `complaints` tells. Levels that do not agree on
// a limit leave what stands for it (convergence.hpp) with its broad uncertainty, which `complaints` tells too. Throws
// InputError, at the table's place, unless [work_precision.case] picks one done case and [work_precision.limit_of] one
// convergence group of three levels or more.
[[nodiscard]] std::vector<std::optional<Reference>> references(const Study& study, const std::string& measure,
                                                               const std::vector<ConvergenceOf>& convergence,
                                                               const Table& table,
                                                               std::vector<std::string>& complaints);

// Throws InputError, at their places, for values, uncertainties and `absolute` of measures that are not charted, and
// for charted ones without a value.
void check_reference_measures(const Study& study, const std::vector<std::string>& charted);

}  // namespace weaveform::study
