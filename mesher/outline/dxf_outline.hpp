// A blank's outline from a DXF drawing (cutters and nesting programs write nothing else).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/keys/length_unit.hpp"
#include "mesher/outline/loops.hpp"

namespace weaveform {

struct DxfAsked {
  std::optional<LengthUnit> unit;   // none: the drawing's own, mm when it names none
  std::vector<std::string> layers;  // in any case of letters; none: all that are on
  double chord_tolerance = 0.01;    // mm
};

struct DxfOutline {
  std::vector<OutlineLoop> loops;  // mm
  // What was taken for granted, one line each: the unit, the layers, what was passed over.
  std::vector<std::string> notes;
};

// By its ending, in any case of letters: .dxf, and .dwg, which is then refused by its name.
[[nodiscard]] bool is_dxf_file(const std::string& file);

// Lines, polylines with arcs, arcs, circles, ellipses and splines of the layers, those within blocks too, joined end to
// end (within 0.01 mm) to closed loops. Adds a line to `complaints` for what is no curve and no annotation, for curves
// that do not close or branch, for layers that are not there. Throws FileError, InputError.
[[nodiscard]] DxfOutline read_dxf_outline(const std::string& file, const DxfAsked& asked,
                                          std::vector<std::string>& complaints);

}  // namespace weaveform
