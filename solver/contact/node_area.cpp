#include "solver/contact/node_area.hpp"

#include <algorithm>

namespace weaveform {

Doubles node_areas(const Mesh& mesh, const PackedMesh& packed) {
  Doubles area(packed.nodes, 0.0);
  for (int c = 0; c < mesh.cells.size(); ++c) {
    const int begin = mesh.cells.offset[c], end = mesh.cells.offset[c + 1];
    for (int a = begin; a < end; ++a)
      area[packed.packed_of_mesh[mesh.cells.node[a]]] += mesh.cells.area[c] / (end - begin);
  }
  const auto take_images = [&] {  // beyond a mirror plane
    for (const auto& image : mesh.symmetry.image) {
      double& there = area[packed.packed_of_mesh[image.node]];
      area[packed.packed_of_mesh[image.of]] += there;
      there = 0.0;
    }
  };
  take_images();
  for (const auto& tie : mesh.tie) {
    double& there = area[packed.packed_of_mesh[tie.node]];
    const double share = std::max(tie.share, 0.0);
    area[packed.packed_of_mesh[tie.to[0]]] += (1.0 - share) * there;
    area[packed.packed_of_mesh[tie.to[1]]] += share * there;
    there = 0.0;
  }
  take_images();
  return area;
}

}  // namespace weaveform
