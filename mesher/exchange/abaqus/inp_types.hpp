// Element types of Abaqus and CalculiX by what they are for a mesh of lines and shells.
#pragma once

#include <string>

namespace weaveform {

enum class InpShape { line, triangle, quadrilateral, other, unknown };

struct InpType {
  InpShape shape = InpShape::unknown;
  int nodes = 0;  // of the element in the file; corners come first. 0 for `other`
};

// `name` in capitals. Trusses, beams and pipes of two nodes are lines; membranes, shells, rigid and plane elements are
// triangles and quadrilaterals, of second order too. Masses, springs, connectors and solids are `other`: no part of
// such a mesh. Beams and trusses of three nodes are unknown, for their middle node may be a crossing.
[[nodiscard]] InpType inp_type(const std::string& name);

}  // namespace weaveform
