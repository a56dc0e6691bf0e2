// The charts of a run: forces and angles over the travel with their ideal, energies, how the angles are distributed at
// the end, and what a formed part has besides.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "post/post.hpp"

namespace weaveform {

// A list of charts as the page draws them.
[[nodiscard]] nlohmann::ordered_json run_charts(ResultFolder& folder, const Evaluation& evaluation);

}  // namespace weaveform
