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
      mesh.nodes.add({i * spacing, j * spacing, 0.0}, 1e-6, {i, j});
    }
  const auto add_yarn = [&](int a, int b, Family family) {
    mesh.yarns.add({.node = {a, b}, .family = family, .rest_length = spacing, .section = 1.25});
  };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      if (i + 1 < columns) add_yarn(node_at(i, j, columns), node_at(i + 1, j, columns), Family::warp);
      if (j + 1 < rows) add_yarn(node_at(i, j, columns), node_at(i, j + 1, columns), Family::weft);
    }
  const double c = 0.5 / spacing;
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      mesh.cells.add({node_at(i, j, columns), node_at(i + 1, j, columns), node_at(i + 1, j + 1, columns),
                      node_at(i, j + 1, columns)},
                     {{-c, -c}, {c, -c}, {c, c}, {-c, c}}, spacing * spacing, {i, j});
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
