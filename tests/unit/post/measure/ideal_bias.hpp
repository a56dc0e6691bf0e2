// A lattice at 45 deg inside a rectangle and the three-zone motion of a bias extension with inextensible yarns, as a
// sum of two bent lines (docs/bias_extension.md): x = f(p) + h(q), p and q the lengths along the two families.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "post/measure/bias_extension.hpp"
#include "tests/unit/solver/lattice/trellis.hpp"

namespace weaveform::test {

inline Scene bias_scene(double width, double length) {
  Scene scene;
  scene.blank.size = {width, length};
  scene.grip.resize(2);
  scene.grip[0].name = "lower";
  scene.grip[0].edge = BlankEdge::bottom;
  scene.grip[1].name = "upper";
  scene.grip[1].edge = BlankEdge::top;
  return scene;
}

// Only whole cells; warp along (1, 1), weft along (-1, 1); centre at the origin.
inline Mesh bias_lattice(double width, double length, double spacing) {
  const int columns = 2 * static_cast<int>(std::ceil((width + length) / spacing)) + 1;
  Mesh mesh = lattice(columns, columns, spacing);
  const double middle = 0.5 * (columns - 1) * spacing, c = std::numbers::sqrt2 / 2.0;
  for (Vec3& x : mesh.nodes.position) {
    const double p = x[0] - middle, q = x[1] - middle;
    x = {c * (p - q), c * (p + q), 0.0};
  }
  const auto inside = [&](int node) {
    const Vec3& x = mesh.nodes.position[node];
    return std::abs(x[0]) <= width / 2.0 + 1e-9 && std::abs(x[1]) <= length / 2.0 + 1e-9;
  };
  MeshCells kept;
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const auto begin = mesh.cells.node.begin() + 4 * cell;
    if (!std::all_of(begin, begin + 4, inside)) continue;
    kept.node.insert(kept.node.end(), begin, begin + 4);
    kept.coefficient.insert(kept.coefficient.end(), mesh.cells.coefficient.begin() + 4 * cell,
                            mesh.cells.coefficient.begin() + 4 * cell + 4);
    kept.offset.push_back(static_cast<int>(kept.node.size()));
    kept.area.push_back(mesh.cells.area[cell]);
    kept.lattice.push_back(mesh.cells.lattice[cell]);
  }
  mesh.cells = kept;
  return mesh;
}

// Within half the free length of the centre each family turns by gamma/2 towards the pull (along y), outside it keeps
// 45 deg.
inline std::vector<Vec3> ideal_positions(const Mesh& mesh, const BiasSpecimen& specimen, double angle) {
  const double c = std::numbers::sqrt2 / 2.0;
  // A line |x + y| = D/2 of the flat specimen is |p| = D/(2 sqrt 2).
  const double reach = 0.5 * c * specimen.free_length();
  const double turned = std::numbers::pi / 4.0 - angle / 2.0;  // of both families from the pull, inside
  const auto across = [&](double s) {
    const double inner = std::clamp(s, -reach, reach);
    return inner * std::sin(turned) + (s - inner) * c;
  };
  const auto along = [&](double s) {
    const double inner = std::clamp(s, -reach, reach);
    return inner * std::cos(turned) + (s - inner) * c;
  };
  std::vector<Vec3> position;
  for (const Vec3& x : mesh.nodes.position) {
    const double p = c * (x[0] + x[1]), q = c * (x[1] - x[0]);
    position.push_back({across(p) - across(q), along(p) + along(q), 0.0});
  }
  return position;
}

}  // namespace weaveform::test
