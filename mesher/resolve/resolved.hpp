// A scene with everything that it leads to, worked out once: whoever needs one of these things takes it from here.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/outline/blank_outline.hpp"
#include "mesher/scene/scene.hpp"
#include "mesher/symmetry/find_symmetry.hpp"
#include "mesher/tools/tool.hpp"

namespace weaveform {

struct Resolved {
  Scene scene;
  Card card;
  BlankOutline outline;
  std::vector<Tool> tools;  // in the scene's order; copies share triangles and search trees
  Mesh mesh;                // the whole; draped where the scene says so
  Symmetry symmetry;
  [[nodiscard]] std::array<double, 2> extent() const { return blank_extent(scene.blank, outline); }  // mm
};

// What a resolved scene shows against itself before it is run: parts that do nothing (mesher/scene/idle.hpp), what the
// readers of outline and tools took for granted or passed over, tools that never come to the blank
// (mesher/tools/out_of_reach.hpp). One line each, in the words of a warning.
[[nodiscard]] std::vector<std::string> early_warnings(const Resolved& model);

// One line: how many cells, yarn elements and nodes, and at what spacing; with the coarsening that comes to where the
// lattice was fitted to the grips.
[[nodiscard]] std::string describe(const Resolved& model);

}  // namespace weaveform
