// Curves of a DXF drawing as chords in the plane of the drawing.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "mesher/outline/dxf_drawing.hpp"

namespace weaveform {

struct DxfCurve {
  std::string layer;
  int line = 0;                              // of the entity in the file
  std::vector<std::array<double, 2>> point;  // in the drawing's unit; closed: the last repeats the first
};

struct DxfCurves {
  std::vector<DxfCurve> curve;
  std::map<std::string, int> passed_over;  // TEXT, DIMENSION and the like, which bound nothing: how many of each type
  std::vector<std::string> complaints;     // what cannot be read: one line per type, with its number, layer and line
};

// Of LINE, LWPOLYLINE and POLYLINE with bulges, ARC, CIRCLE, ELLIPSE, SPLINE, and INSERT of blocks of these, on visible
// layers; chords within `tolerance` (in the drawing's unit). Throws InputError for numbers that are none.
[[nodiscard]] DxfCurves curves_of(const DxfDrawing& drawing, double tolerance);

}  // namespace weaveform
