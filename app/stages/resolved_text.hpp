// What a scene was resolved to: the choices that it leaves to the program, as they came out.
#pragma once

#include <string>

#include "mesher/resolve/resolved.hpp"

namespace weaveform {

// As TOML with a comment to each number: mesh, symmetry, loading and step (of the first step of the analysis, which is
// run for it), laws, and each tool with its triangles and mass. Throws what solve throws.
[[nodiscard]] std::string resolved_text(const Resolved& model);

}  // namespace weaveform
