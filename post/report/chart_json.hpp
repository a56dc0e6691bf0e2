// A chart (core/chart) as the page draws it (post/report/viewer/README.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/chart/chart.hpp"

namespace weaveform {

inline constexpr std::size_t most_points_of_a_line = 2000;  // a line of more is thinned evenly, its ends kept

// A band is two dashed lines, its ends. Error bars are left out: no chart that a report has is drawn with them.
[[nodiscard]] nlohmann::ordered_json chart_json(const std::string& id, const Chart& chart, bool square = false);

// A line across the chart at a value of x: "the card's range ends".
void add_mark(nlohmann::ordered_json& chart, double x, const std::string& label);

}  // namespace weaveform
