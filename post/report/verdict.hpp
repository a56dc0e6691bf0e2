// The run judged in words and numbers: what came out, where, what it says against itself, and what it can be trusted for.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "post/post.hpp"

namespace weaveform {

[[nodiscard]] nlohmann::ordered_json verdict_json(ResultFolder& folder, const Evaluation& evaluation);

}  // namespace weaveform
