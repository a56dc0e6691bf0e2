// Time against error for people and scripts: work_precision_MEASURE.svg, work_precision.md, work_precision.csv.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/study/work_precision.hpp"
#include "core/chart/chart.hpp"

namespace weaveform::study {

// Logarithmic axes; a colour for each series of cases, the Pareto front as a line with each of its cases named.
[[nodiscard]] Chart work_precision_chart(const WorkPrecision& one, const Table& table);

// For each measure the front in the order of time, and the cheapest case within each tolerance, of all and by series;
// at the end the same for all measures at once, for what is right in one may be so by chance.
[[nodiscard]] std::string work_precision_markdown(const WorkPrecisionSpec& spec, const std::vector<WorkPrecision>& all,
                                                  const Table& table);
[[nodiscard]] std::string work_precision_csv(const std::vector<WorkPrecision>& all, const Table& table);

// "measures": of each "points" as in work_precision.csv and what is "cheapest_within"; and the latter of "all_measures"
// at once.
[[nodiscard]] nlohmann::ordered_json work_precision_json(const WorkPrecisionSpec& spec,
                                                         const std::vector<WorkPrecision>& all, const Table& table);

// "work_precision_grips.top.force_N.svg": characters that a file name should not have become '_'.
[[nodiscard]] std::string chart_name(const std::string& measure);

}  // namespace weaveform::study
