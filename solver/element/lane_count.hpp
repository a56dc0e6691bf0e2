// Of the packs that inner loops take, for those who hold what loops return and need not know packs (lanes.hpp).
#pragma once

namespace weaveform {

inline constexpr int lane_count = 8;  // numbers, the least that loops take at once

}  // namespace weaveform
