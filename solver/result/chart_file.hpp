// Charts as files, beside the tables that hold their numbers.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/chart/chart.hpp"

namespace weaveform {

// Writes the chart as SVG. A chart that cannot be drawn (no gnuplot) does not end a run whose numbers are good: it is
// left out, an older file of that name removed, and the reason said on standard error, once for all charts of the
// process. Throws FileError when the file cannot be written.
void write_chart(const std::filesystem::path& file, const Chart& chart);

// The same for a page of charts (to_html).
void write_chart_page(const std::filesystem::path& file, const std::string& title, const std::vector<Chart>& charts);

}  // namespace weaveform
