// How round the tools are where they bend the fabric: what a mesh has to resolve.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "mesher/tools/tool.hpp"

namespace weaveform {

struct ToolBend {
  double radius = std::numeric_limits<double>::infinity();  // mm; of the fabric's middle plane
  std::string tool;                                         // its name; "" when there is none
  double along_yarns = 0.0;  // 1; of triangles, the part of the turning that is about yarns
};

struct ToolBends {
  // Over which fabric is drawn or pressed: fillets, cylinders, rounded edges; the tightest of any tool.
  ToolBend edge;
  // Of the part itself, which is doubly curved: a sphere's, a dome's, of a cup the radius of its rim, half the
  // width over which a surface's convex corners stand; the least of any tool.
  ToolBend form;
  // Into which a net is laid that starts draped over this tool: its hollows too.
  ToolBend drape;
};

// Of triangles: each edge between two turns the surface by an angle over the distance of their centres, and the radius
// counted is that beyond which nine tenths of all turning lie, so that a fillet has a part in it by its angle and
// length, however narrow it is, and noise of a facet has none. An edge that turns by more than sharp_turn has no radius
// and does not count: no mesh resolves it, most of them (a plate's rim) no fabric meets, and a chord that lies on one is
// told at the end of the run. The width is sqrt(2) times the narrower standard deviation of the convex vertices weighted
// by their angle deficits, which is a ring's radius, 0.82 of a ball's, and more of a box than half its side. What lies
// off the blank's extent in the plane (mm, `reach` from the blank's centre) does not count. An edge runs along yarns when
// it lies within nearly_along of one of the flat blank's families.
inline constexpr double nearly_along_deg = 5.0;
inline constexpr double sharp_turn_deg = 35.0;
[[nodiscard]] ToolBends tool_bends(const Scene& scene, const std::vector<Tool>& tools, double reach);

}  // namespace weaveform
