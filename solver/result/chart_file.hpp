// Charts as files, beside the tables that hold their numbers.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/chart/chart.hpp"

namespace weaveform {

// Writes the chart as SVG. A chart that cannot be drawn (no node) does not end a run whose numbers are good: it is
// left out, an older file of that name removed, and the reason told to who hears of it. Throws FileError when the file
// cannot be written.
void write_chart(const std::filesystem::path& file, const Chart& chart);

// The same of several, drawn by one process, which starts no faster for one.
void write_charts(const std::vector<std::pair<std::filesystem::path, Chart>>& charts);

// Who is told, once for all charts of the process, why charts are left out; a setting of the whole process, made by the
// program before any is written. Nobody at first.
void hear_of_missing_charts(std::function<void(const std::string& reason)> hears);

}  // namespace weaveform
