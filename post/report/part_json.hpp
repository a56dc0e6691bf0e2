// The part over time: cells and yarns, positions and fields of the frames, as 16-bit numbers over their range. What would
// not fit is thinned, frames first, then cells, and the page says so.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

#include "post/output/summary.hpp"
#include "solver/result/result_folder.hpp"

namespace weaveform {

// Bytes of all arrays before they are written in base64, which makes 12 MB of them; with the viewer a page stays under 15.
inline constexpr std::size_t most_part_bytes = 9'000'000;
inline constexpr std::size_t least_frames = 5;  // with fewer, a motion is not seen: cells are thinned first

struct PartPage {
  nlohmann::ordered_json json;
  std::vector<FrameFile> frames;  // those shown
  Vec3 low, high;                 // mm; the box of all of them
};

// `summary` has the wrinkles of the last frame. Throws FileError and InputError as ResultFolder does.
[[nodiscard]] PartPage part_json(ResultFolder& folder, const Summary& summary,
                                 std::size_t most_bytes = most_part_bytes);

}  // namespace weaveform
