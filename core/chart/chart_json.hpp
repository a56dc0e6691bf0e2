// A chart as data for the scripts that draw it (core/chart/echarts): {id, title, x, y: {title, log, from, to}, series: [{name,
// x, y, style, colour, shape, y_low, y_high}], bands: [{name, x, low, high, colour}], notes: [{x, y, text}], marks: [{x,
// label}], square}. What is none in the chart is missing there; values that are not finite are null.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/chart/chart.hpp"

namespace weaveform {

inline constexpr std::size_t most_points_of_a_line =
    2000;  // on a page; a line of more is thinned evenly, its ends kept

// `id` is letters, digits, `_` and `-`. `square`: one scale for both axes. `most_points`: of lines and bands.
[[nodiscard]] nlohmann::ordered_json chart_json(const std::string& id, const Chart& chart, bool square = false,
                                                std::size_t most_points = most_points_of_a_line);

// A line across the chart at a value of x: "the card's range ends".
void add_mark(nlohmann::ordered_json& chart, double x, const std::string& label);

}  // namespace weaveform
