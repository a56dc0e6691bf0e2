// What a tool's instruments show.
#pragma once

namespace weaveform {

struct ToolReading {
  double displacement = 0.0;  // mm; along its direction
  double force = 0.0;         // N; of the tool on the fabric, along its direction
  double area = 0.0;          // mm^2; of fabric that touches it
};

}  // namespace weaveform
