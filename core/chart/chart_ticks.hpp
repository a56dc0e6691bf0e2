// Where a logarithmic axis has ticks, and what they say.
#pragma once

#include <string>
#include <vector>

namespace weaveform {

// A tick of a logarithmic axis; those without a label are short.
struct ChartTick {
  double value = 0.0;
  std::string label = {};
};
// Powers of ten over many decades, more between over few, round steps within a part of one. At least two have labels.
[[nodiscard]] std::vector<ChartTick> log_ticks(double from, double to);

}  // namespace weaveform
