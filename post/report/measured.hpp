// The measurement that a result was compared with (post compare), for the page: its field beside the simulated one, its
// load and its verdict.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "solver/result/result_folder.hpp"

namespace weaveform {

struct MeasuredPage {
  nlohmann::ordered_json field;   // the last stage's, on the blank moved as it was measured
  nlohmann::ordered_json charts;  // a list
  nlohmann::ordered_json table;   // one row for each stage
};

// None where DIR/comparison holds no comparison. `frames` are those of the page. Throws FileError and InputError (a
// damaged comparison).
[[nodiscard]] std::optional<MeasuredPage> measured_page(ResultFolder& folder, const std::vector<FrameFile>& frames);

}  // namespace weaveform
