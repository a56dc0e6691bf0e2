// The tools as the page shows them: the part of their surfaces that comes near the fabric, and their way over the frames.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "solver/result/result_folder.hpp"

namespace weaveform {

// A list, empty without tools. `low` and `high`: the fabric's box over the frames, mm.
[[nodiscard]] nlohmann::ordered_json tools_json(ResultFolder& folder, const std::vector<FrameFile>& frames,
                                                const Vec3& low, const Vec3& high);

}  // namespace weaveform
