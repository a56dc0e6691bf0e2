#include "solver/unit_cell.hpp"

#include <cmath>
#include <cstddef>

#include "solver/ply/ply.hpp"

namespace weaveform {

namespace {

// Nodes counter-clockwise from the corner at the lower left, the warp along x, the centre at the origin. (The mesher
// makes blanks of three cells and more.)
Mesh one_cell(const Card& card, const std::array<double, 2>& sides) {
  Mesh mesh;
  mesh.spacing = sides;
  mesh.lattice_size = {2, 2};
  mesh.thickness = card.thickness;
  const double area = sides[0] * sides[1];
  const std::array<std::array<int, 2>, 4> corner = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  std::vector<Vec2> coefficient;
  for (const auto& at_corner : corner) {
    const Vec2 at = {at_corner[0] - 0.5, at_corner[1] - 0.5};
    mesh.nodes.add({at[0] * sides[0], at[1] * sides[1], 0.0}, 0.25 * area * card.area_density(), at_corner);
    coefficient.push_back({at[0] / sides[0], at[1] / sides[1]});
  }
  mesh.cells.add({0, 1, 2, 3}, coefficient, area, {0, 0});
  // each edge has the half of its yarn that belongs to the cell
  const auto edge = [&](int node0, int node1, Family family) {
    const std::size_t f = family == Family::warp ? 0 : 1;
    mesh.yarns.add({.node = {node0, node1},
                    .family = family,
                    .rest_length = sides[f],
                    .section = 0.5 * card.yarn[f].section,
                    .yarns = 0.5});
  };
  edge(0, 1, Family::warp);
  edge(3, 2, Family::warp);
  edge(0, 3, Family::weft);
  edge(1, 2, Family::weft);
  return mesh;
}

struct CellYarns {
  std::array<double, 2> warp, weft;  // 1
};

// Unit yarn directions of the trellis: the warp turned by +gamma/2, the weft by -gamma/2, both by `turn`.
CellYarns trellis(double gamma, double turn) {
  return {{std::cos(turn + 0.5 * gamma), std::sin(turn + 0.5 * gamma)},
          {-std::sin(turn - 0.5 * gamma), std::cos(turn - 0.5 * gamma)}};
}

// Their derivative by gamma at fixed turn.
CellYarns trellis_rate(double gamma, double turn) {
  return {{-0.5 * std::sin(turn + 0.5 * gamma), 0.5 * std::cos(turn + 0.5 * gamma)},
          {0.5 * std::cos(turn - 0.5 * gamma), 0.5 * std::sin(turn - 0.5 * gamma)}};
}

// Of trellis shear, which bends nothing.
ModelSpec in_plane(ModelSpec model) {
  model.cell = CellElement::membrane;
  if (model.yarn == YarnElement::beam) model.yarn = YarnElement::truss;
  return model;
}

// A flat node carried along by the yarns: x = X_1 g1 + X_2 g2.
double carried(const std::array<double, 3>& flat, const CellYarns& g, int component) {
  return flat[0] * g.warp[component] + flat[1] * g.weft[component];
}

}  // namespace

std::vector<UnitCellPoint> shear_unit_cell(const Card& card, const ModelSpec& model, const std::array<double, 2>& sides,
                                           const UnitCellMotion& motion) {
  const Mesh mesh = one_cell(card, sides);
  Scene scene;
  scene.model = in_plane(model);
  Ply ply({.whole = mesh, .scene = scene, .card = card, .team = alone()});
  State& state = ply.state();
  const PackedMesh& packed = ply.packed();
  std::vector<UnitCellPoint> points;
  points.reserve(static_cast<std::size_t>(motion.increments));
  for (int n = 1; n <= motion.increments; ++n) {
    const double part = static_cast<double>(n) / motion.increments;
    const double gamma = part * motion.angle, turn = part * motion.rotation;
    const CellYarns g = trellis(gamma, turn), rate = trellis_rate(gamma, turn);
    for (int a = 0; a < 4; ++a)
      for (int c = 0; c < 2; ++c) state.position[c][packed.packed_of_mesh[a]] = carried(mesh.nodes.position[a], g, c);
    ply.compute_forces(0.0);
    double power = 0.0;  // N mm per rad
    for (int a = 0; a < 4; ++a)
      for (int c = 0; c < 2; ++c)
        power -= state.force[c][packed.packed_of_mesh[a]] * carried(mesh.nodes.position[a], rate, c);
    points.push_back({gamma, power / (mesh.cells.area[0] * std::cos(gamma))});
  }
  return points;
}

}  // namespace weaveform
