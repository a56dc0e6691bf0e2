#include "mesher/mesh/mesh.hpp"

namespace weaveform {

int MeshNodes::add(const Vec3& at, double its_mass, const std::array<int, 2>& its_crossing) {
  position.push_back(at);
  mass.push_back(its_mass);
  crossing.push_back(its_crossing);
  return static_cast<int>(position.size()) - 1;
}

void MeshYarns::add(const MeshYarn& yarn) {
  node.push_back(yarn.node);
  family.push_back(yarn.family);
  rest_length.push_back(yarn.rest_length);
  section.push_back(yarn.section);
  yarns.push_back(yarn.yarns);
  jaw.push_back(yarn.jaw);
  softening.push_back(yarn.softening);
}

MeshYarn MeshYarns::at(int element) const {
  const auto e = static_cast<std::size_t>(element);
  return {node[e], family[e], rest_length[e], section[e], yarns[e], jaw[e], softening[e]};
}

void MeshCells::add(const std::vector<int>& its_node, const std::vector<Vec2>& its_coefficient, double its_area,
                    const std::array<int, 2>& its_lattice) {
  node.insert(node.end(), its_node.begin(), its_node.end());
  coefficient.insert(coefficient.end(), its_coefficient.begin(), its_coefficient.end());
  offset.push_back(static_cast<int>(node.size()));
  area.push_back(its_area);
  lattice.push_back(its_lattice);
}

Vec3 cell_centre(const MeshCells& cells, int cell, const std::vector<Vec3>& position) {
  Vec3 centre = {0.0, 0.0, 0.0};
  const int from = cells.offset[cell], to = cells.offset[cell + 1];
  for (int k = from; k < to; ++k)
    for (std::size_t c = 0; c < 3; ++c) centre[c] += position[cells.node[k]][c] / (to - from);
  return centre;
}

}  // namespace weaveform
