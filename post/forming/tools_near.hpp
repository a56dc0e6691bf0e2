// The tools of a scene as surfaces to be looked at: what of them is near the fabric where the run ends, so that a binder
// as wide as the press or a long punch does not hide the part.
#pragma once

#include <string>
#include <vector>

#include "mesher/exchange/tool_mesh.hpp"
#include "mesher/resolve/resolved.hpp"

namespace weaveform {

inline constexpr double room_around = 0.03;  // of the box's diagonal, on each side

struct NearTool {
  std::string name;
  foreign::ToolMesh surface;  // mm; where the tool stands at the start
};

// In the scene's order. `low` and `high` bound the fabric, mm; `moved` (mm) is how far each tool has come from its start
// when it stands about it.
[[nodiscard]] std::vector<NearTool> tools_near(const Resolved& model, const std::vector<Vec3>& moved, const Vec3& low,
                                               const Vec3& high);

// What of a surface lies in a box: faces are cut at its sides, into triangles and quadrilaterals.
[[nodiscard]] foreign::ToolMesh cut_to_box(const foreign::ToolMesh& surface, const Vec3& low, const Vec3& high);

}  // namespace weaveform
