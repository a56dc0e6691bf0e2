// What `mesh`, `check`, `import` and `export` say of a mesh, and the whole answer of `check`, as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/stages/room.hpp"
#include "mesher/resolve/resolved.hpp"

namespace weaveform {

// The numbers of describe(model): "cells", "yarn_elements", "nodes", "spacing_mm" and "coarsening" of warp and weft, the
// latter as the lattice came to. Of a stack the latter two are those of each ply, in "plies".
[[nodiscard]] nlohmann::ordered_json mesh_json(const Resolved& model);

// "mesh" as above, "expected" (what the run is expected to take), "scene" (every value, under the names of the
// scene file) and, where they are not empty, "not_chosen": a line on what is left to trials that were not made, and
// "resolved": the tables of resolved_text.
[[nodiscard]] nlohmann::ordered_json check_json(const Resolved& model, const ExpectedRun& expected,
                                                const std::string& not_chosen, const std::string& resolved);

}  // namespace weaveform
