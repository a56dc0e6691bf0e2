// A flat lattice of yarns and full quad cells made by hand, its trellis motion, and a small card, for tests of what is
// computed from a mesh. Units mm, N, MPa.
#pragma once

#include <cmath>
#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "solver/result/fields.hpp"

namespace weaveform::test {

inline int node_at(int i, int j, int columns) {
  return j * columns + i;
}

// columns x rows crossings; warp along x, weft along y.
inline Mesh lattice(int columns, int rows, double spacing) {
  Mesh mesh;
  mesh.spacing = {spacing, spacing};
  mesh.lattice_size = {columns, rows};
  mesh.thickness = 0.5;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      mesh.nodes.position.push_back({i * spacing, j * spacing, 0.0});
      mesh.nodes.mass.push_back(1e-6);
      mesh.nodes.crossing.push_back({i, j});
    }
  const auto add_yarn = [&](int a, int b, Family family) {
    mesh.yarns.node.push_back({a, b});
    mesh.yarns.family.push_back(family);
    mesh.yarns.rest_length.push_back(spacing);
    mesh.yarns.section.push_back(1.25);
    mesh.yarns.yarns.push_back(1.0);
    mesh.yarns.jaw.push_back(0.0);
    mesh.yarns.softening.push_back(1.0);
  };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      if (i + 1 < columns) add_yarn(node_at(i, j, columns), node_at(i + 1, j, columns), Family::warp);
      if (j + 1 < rows) add_yarn(node_at(i, j, columns), node_at(i, j + 1, columns), Family::weft);
    }
  const double c = 0.5 / spacing;
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      for (const int node : {node_at(i, j, columns), node_at(i + 1, j, columns), node_at(i + 1, j + 1, columns),
                             node_at(i, j + 1, columns)})
        mesh.cells.node.push_back(node);
      for (const std::array<double, 2>& g : {std::array{-c, -c}, {c, -c}, {c, c}, {-c, c}})
        mesh.cells.coefficient.push_back(g);
      mesh.cells.offset.push_back(static_cast<int>(mesh.cells.node.size()));
      mesh.cells.area.push_back(spacing * spacing);
      mesh.cells.lattice.push_back({i, j});
    }
  return mesh;
}

// Both families turn by half the angle towards each other and keep their length: sin gamma = g1.g2 with gamma = `angle`
// (rad).
inline std::vector<Vec3> trellis(const Mesh& mesh, double angle) {
  const double c = std::cos(0.5 * angle), s = std::sin(0.5 * angle);
  std::vector<Vec3> position;
  for (const Vec3& x : mesh.nodes.position) position.push_back({c * x[0] + s * x[1], s * x[0] + c * x[1], x[2]});
  return position;
}

// Tension 100 MPa/1 tangent rising linearly to 1100 at a strain of 0.1, 2000 beyond; shear tangent 0.2 + 0.6 e^2.
inline Card small_card() {
  Card card;
  card.name = "test";
  card.thickness = 0.5;
  for (YarnCard& yarn : card.yarn) {
    yarn.interval = 5.0;
    yarn.section = 1.25;
    yarn.tension = TangentLaw({{0.0, 0.1, {100.0, 10000.0}}, {0.1, 1.0, {2000.0}}});
    yarn.linear_modulus = 2000.0;
    yarn.compression_modulus = 20.0;
  }
  card.shear.tangent = TangentLaw({{0.0, 3.0, {0.2, 0.0, 0.6}}});
  return card;
}

}  // namespace weaveform::test
