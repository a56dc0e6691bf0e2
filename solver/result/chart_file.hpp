// Charts as files, beside the tables that hold their numbers.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/chart/chart.hpp"

namespace weaveform {

// Writes the chart as SVG. A chart that cannot be drawn (no gnuplot) does not end a run whose numbers are good: it is
// left out, an older file of that name removed, and the reason told to who hears of it. Throws FileError when the file
// cannot be written.
void write_chart(const std::filesystem::path& file, const Chart& chart);

// Who is told, once for all charts of the process, why charts are left out; a setting of the whole process, made by the
// program before any is written. Nobody at first.
void hear_of_missing_charts(std::function<void(const std::string& reason)> hears);

}  // namespace weaveform
