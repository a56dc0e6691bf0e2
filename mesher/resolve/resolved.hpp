// A scene with everything that it leads to, worked out once: whoever needs one of these things takes it from here.
//
// A stack is the same thing once more for each of its plies: what concerns one ply is asked of `ply[k]`, a scene of one
// ply in every respect; what concerns all of them is the stack's own.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/outline/blank_outline.hpp"
#include "mesher/resolve/stack_laws.hpp"
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
  // Of a stack, bottom to top, each with its own scene (mesher/scene/ply_scene.hpp) and the tools at its own distance;
  // `mesh` is then all of theirs (mesher/mesh/stack.hpp), card and outline those of the lowest. Empty: one ply, this.
  std::vector<Resolved> ply = {};
  std::vector<ResolvedPair> pair = {};  // of plies i < k: pair_number(i, k)
  [[nodiscard]] std::size_t plies() const { return ply.empty() ? 1 : ply.size(); }
  [[nodiscard]] const Resolved& of_ply(std::size_t number) const { return ply.empty() ? *this : ply[number]; }
  [[nodiscard]] std::array<double, 2> extent() const {  // mm; of a stack, of its lowest ply
    return ply.empty() ? blank_extent(scene.blank, outline) : ply.front().extent();
  }
};

// Of plies i < k, in the order (0,1), (0,2), (1,2), (0,3), ...
[[nodiscard]] constexpr std::size_t pair_number(std::size_t i, std::size_t k) {
  return k * (k - 1) / 2 + i;
}

// "" of a single ply, else "ply 'NAME': ".
[[nodiscard]] std::string name_before(const Resolved& model, std::size_t ply);

// What a resolved scene shows against itself before it is run: parts that do nothing (mesher/scene/idle.hpp), what the
// readers of outline and tools took for granted or passed over, fabric laid face down that is the same either way, wanted
// accuracy that no mesh or element serves, tools that never come to the blank (mesher/tools/out_of_reach.hpp). One line
// each, in the words of a warning.
[[nodiscard]] std::vector<std::string> early_warnings(const Resolved& model);

// One line: how many cells, yarn elements and nodes, and at what spacing; with the coarsening that comes to where the
// lattice was fitted to the grips.
[[nodiscard]] std::string describe(const Resolved& model);

}  // namespace weaveform
