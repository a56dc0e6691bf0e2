// What a tool's instruments show.
#pragma once

#include <array>

namespace weaveform {

struct ToolReading {
  double displacement = 0.0;  // mm; along its direction
  double force = 0.0;         // N; of the tool on the fabric, along its direction (at rest: its axis)
  double area = 0.0;          // mm^2; of fabric that touches it
  std::array<double, 3> whole_force = {0.0, 0.0, 0.0};  // N; x, y, z of that force
};

}  // namespace weaveform
