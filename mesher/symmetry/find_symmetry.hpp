// How little of a scene has to be solved: the planes x = 0 and y = 0 of the blank's own frame that mirror mesh and
// loads onto themselves, as far as model.symmetry wants them used.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesher/symmetry/load_symmetry.hpp"

namespace weaveform {

struct Symmetry {
  std::vector<SymmetryPlane> plane;            // to be used: none, one (a half) or two (a quarter)
  std::vector<MirrorMap> map;                  // of each
  std::array<std::string, 2> why;              // per axis x, y: why its plane is not one of the scene; "" when it is
  SymmetryUse asked = SymmetryUse::automatic;  // model.symmetry
  [[nodiscard]] std::string word() const;      // "none", "half", "quarter"
};

// `mesh` is the whole, `tools` are the scene's. Throws InputError, with the first thing in the way, when the scene asks
// for a half or a quarter that it has not got.
[[nodiscard]] Symmetry find_symmetry(const Scene& scene, const Card& card, const Mesh& mesh,
                                     const std::vector<Tool>& tools);

// What find_symmetry looks at of one ply.
struct PlyToMirror {
  std::string name;  // for messages
  const Scene& scene;
  const Card& card;
  const Mesh& mesh;
};
// The same of a stack, for each of its plies: planes are those that all of them have.
[[nodiscard]] std::vector<Symmetry> find_symmetry(const std::vector<PlyToMirror>& plies,
                                                  const std::vector<Tool>& tools);

// One line for the log: what is solved, and why not less.
[[nodiscard]] std::string describe(const Symmetry& symmetry);

}  // namespace weaveform
