// What a mesh file of another code cannot hold, as lines of text that its own readers skip: in .inp files comments
// ("** weaveform ..."), in .msh files a section of its own ($Weaveform). With them a mesh comes back bit for bit.
//   weave 1                                     first line, the version of this list
//   size nodes yarns cells ties sets
//   spacing a b; lattice i j; thickness t; frame a b c d
//   node x y z mass i j                         one per node, numbers as printed by the shortest exact form
//   flat x y z                                  one per node, of a blank that starts draped
//   yarn a b family rest section yarns jaw softening
//   cell nodes area i j, then one `at node warp weft` per node (the coefficients)
//   tie node a b share; set count name, then `in` lines of up to 12 nodes
//   from # Scene: "FILE"                        what the scene was read from; not in files of earlier versions
//   scene LINE                                  the scene file, line by line
//   end
#pragma once

#include <string>
#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

[[nodiscard]] std::vector<std::string> weave_lines(const Scene& scene, const Mesh& mesh);

struct NumberedLine {
  int number = 0;  // in its file
  std::string text;
};
struct WovenMesh {
  Mesh mesh;
  std::string scene;       // TOML
  std::string scene_name;  // its file; "" where the lines do not say
};
// Throws InputError, "file:line: what is wrong", unless the lines are such a list with every number in its range.
[[nodiscard]] WovenMesh read_weave_lines(const std::vector<NumberedLine>& lines, const std::string& file);

}  // namespace weaveform
