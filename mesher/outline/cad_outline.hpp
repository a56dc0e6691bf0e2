// A blank's outline from CAD through the Gmsh SDK.
#pragma once

#include <string>
#include <vector>

#include "mesher/outline/loops.hpp"

namespace weaveform {

// Closed loops of the curves that bound the file's faces (or of all its curves when it has no face), in the plane z =
// constant; curved ones as chords within `chord_tolerance` (mm). Formats as for tools (mesher/tools/cad.hpp). Adds a
// line to `complaints` for curves that do not close, branch, or leave the plane. Throws FileError, InputError.
[[nodiscard]] std::vector<OutlineLoop> read_cad_outline(const std::string& file, double chord_tolerance,
                                                        std::vector<std::string>& complaints);

}  // namespace weaveform
