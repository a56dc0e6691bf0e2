#include "solver/result/fields.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/vector/append.hpp"
#include "core/vector/eigen_vector.hpp"
#include "mesher/mesh/stack.hpp"
#include "solver/coupling/coupled_lattice.hpp"
#include "solver/state/packed.hpp"

namespace weaveform {

namespace {

using Eigen::Vector3d;

struct YarnDirections {
  Vec3 warp = {0.0, 0.0, 0.0}, weft = {0.0, 0.0, 0.0};  // 1; not normalised: |g| is the stretch at the centre
};

// g_f = sum_a coefficient[f][a] x_a (mesh.hpp).
YarnDirections directions_at_centre(const MeshCells& cells, int cell, const std::vector<Vec3>& position) {
  Vec3 warp = {0.0, 0.0, 0.0}, weft = {0.0, 0.0, 0.0};  // in registers, as what is returned cannot be
  for (int entry = cells.offset[cell]; entry < cells.offset[cell + 1]; ++entry) {
    const Vec3& x = position[cells.node[entry]];
    const auto [of_warp, of_weft] = cells.coefficient[entry];
    for (std::size_t c = 0; c < 3; ++c) {
      warp[c] += of_warp * x[c];
      weft[c] += of_weft * x[c];
    }
  }
  return {warp, weft};
}

struct UnitDirections {
  Vector3d warp, weft;
};

// A collapsed cell has no direction, and a frame must hold no NaN.
UnitDirections unit_directions(const MeshCells& cells, int cell, const std::vector<Vec3>& position) {
  const YarnDirections g = directions_at_centre(cells, cell, position);
  return {unit_or_zero(vector_of(g.warp)), unit_or_zero(vector_of(g.weft))};
}

// sin gamma = g1.g2 (unit vectors), taken as atan2(g1.g2, |g1 x g2|): the arc sine alone loses half the digits near 90
// deg.
double shear_angle(const Vector3d& warp, const Vector3d& weft) {
  return std::atan2(warp.dot(weft), warp.cross(weft).norm());
}

double distance(const Vec3& a, const Vec3& b) {
  return (vector_of(b) - vector_of(a)).norm();
}

struct YarnState {
  double strain = 0.0;  // 1
  double force = 0.0;   // N
};

// e = ln((L + jaw)/(L0 + jaw)),  N = s(e) A softening (L0 + jaw)/(L + jaw)   (mesh.hpp; without the last factor when
// the section is constant). Shear that shortens the yarn adds s(e + shortening) - s(e) of pull
// (solver/coupling/tension_shear.hpp).
YarnState yarn_state(const MeshYarns& yarns, std::size_t yarn, double length, const TangentLaw& law,
                     bool incompressible, double shortening) {
  const double rest = yarns.rest_length[yarn] + yarns.jaw[yarn];
  const double current = length + yarns.jaw[yarn];
  const double strain = std::log(current / rest);
  const double section = yarns.section[yarn] * yarns.softening[yarn] * (incompressible ? rest / current : 1.0);
  double stress = law.stress(strain);
  if (shortening > 0.0) stress += std::max(0.0, law.stress(strain + shortening)) - std::max(0.0, stress);
  return {strain, stress * section};
}

// mm^2; A0 g1 x g2 of every cell. Every row of history asks for it.
std::vector<Vec3> oriented_areas(const Mesh& mesh, const std::vector<Vec3>& position) {
  std::vector<Vec3> area(mesh.cells.size());
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const YarnDirections g = directions_at_centre(mesh.cells, cell, position);
    area[cell] = scaled(cross(g.warp, g.weft), mesh.cells.area[cell]);
  }
  return area;
}

Vec3 sum_of(const std::vector<Vec3>& vectors) {
  Vec3 sum = {0.0, 0.0, 0.0};
  for (const Vec3& v : vectors) sum = plus(sum, v);
  return sum;
}

// True when every node lies in the plane through `origin` with unit normal `normal`, to 1e-9 of the blank's extent.
bool lies_in_plane(const std::vector<Vec3>& position, const Vector3d& origin, const Vector3d& normal) {
  double extent = 0.0, height = 0.0;
  for (const Vec3& x : position) {
    const Vector3d from_origin = vector_of(x) - origin;
    extent = std::max(extent, from_origin.cwiseAbs().maxCoeff());
    height = std::max(height, std::abs(from_origin.dot(normal)));
  }
  return height <= 1e-9 * extent;
}

// mm^2; sum at every node of the oriented areas of its cells.
std::vector<Vec3> areas_at_nodes(const MeshCells& cells, const std::vector<Vec3>& area, int node_count) {
  std::vector<Vec3> at_node(node_count, {0.0, 0.0, 0.0});
  for (int cell = 0; cell < cells.size(); ++cell)
    for (int entry = cells.offset[cell]; entry < cells.offset[cell + 1]; ++entry) {
      Vec3& sum = at_node[cells.node[entry]];
      sum = plus(sum, area[cell]);
    }
  return at_node;
}

void fill_cells(const MeshCells& cells, Fields& fields) {
  fields.shear_angle.resize(cells.size());
  fields.warp.resize(cells.size());
  fields.weft.resize(cells.size());
  for (int cell = 0; cell < cells.size(); ++cell) {
    const UnitDirections g = unit_directions(cells, cell, fields.position);
    fields.shear_angle[cell] = shear_angle(g.warp, g.weft);
    fields.warp[cell] = array_of(g.warp);
    fields.weft[cell] = array_of(g.weft);
  }
}

// Stretch of the yarns of a cell. |g| at the centre is shorter than they are where the cell is bent or twisted, which
// is no stretch: a full cell takes the mean of its sides.
std::array<double, 2> cell_stretch(const Mesh& mesh, int cell, const std::vector<Vec3>& position) {
  if (!is_full_quad(mesh, cell)) {
    const YarnDirections g = directions_at_centre(mesh.cells, cell, position);
    return {vector_of(g.warp).norm(), vector_of(g.weft).norm()};
  }
  const int* n = mesh.cells.node.data() + mesh.cells.offset[cell];  // x00, x10, x11, x01
  return {
      0.5 * (distance(position[n[0]], position[n[1]]) + distance(position[n[3]], position[n[2]])) / mesh.spacing[0],
      0.5 * (distance(position[n[0]], position[n[3]]) + distance(position[n[1]], position[n[2]])) / mesh.spacing[1]};
}

void fill_thickness(const Mesh& mesh, const ModelSpec& model, Fields& fields) {
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const auto [warp, weft] = cell_stretch(mesh, cell, fields.position);
    const double cosine = vector_of(fields.warp[cell]).cross(vector_of(fields.weft[cell])).norm();
    const double area_ratio = warp * weft * cosine;
    const double gain = area_ratio > 0.0 ? 1.0 / area_ratio : 0.0;
    fields.areal_weight.push_back(gain);
    fields.thickness.push_back(mesh.thickness * (model.thickness == Thickness::constant ? 1.0 : gain));
  }
}

// 1; of every yarn element, where the card couples tension and shear.
std::vector<double> shortenings_of(const Mesh& mesh, const Card& card, const Fields& fields) {
  if (!(card.shear.tension_coupling > 0.0)) return std::vector<double>(mesh.yarns.node.size(), 0.0);
  std::vector<double> energy;
  for (const double angle : fields.shear_angle)
    energy.push_back(shear_energy(card.shear, log_shear_strain(std::abs(angle))));
  return shortenings(couple_lattice(mesh, card), energy, mesh.yarns.node.size());
}

void fill_yarns(const Mesh& mesh, const Card& card, const ModelSpec& model, Fields& fields) {
  const MeshYarns& yarns = mesh.yarns;
  const std::array<TangentLaw, 2> law = yarn_laws(card, model);
  const std::vector<double> shortening = shortenings_of(mesh, card, fields);
  const bool incompressible = model.section != Section::constant;
  const std::size_t count = yarns.node.size();
  fields.yarn_strain.resize(count);
  fields.yarn_force.resize(count);
  for (std::size_t yarn = 0; yarn < count; ++yarn) {
    const auto family = static_cast<std::size_t>(yarns.family[yarn]);
    const auto [a, b] = yarns.node[yarn];
    const double length = distance(fields.position[a], fields.position[b]);
    const YarnState state = yarn_state(yarns, yarn, length, law[family], incompressible, shortening[yarn]);
    fields.yarn_strain[yarn] = state.strain;
    fields.yarn_force[yarn] = state.force;
  }
}

}  // namespace

void append(Fields& all, const Fields& more) {
  append(all.position, more.position);
  append(all.displacement, more.displacement);
  append(all.shear_angle, more.shear_angle);
  append(all.warp, more.warp);
  append(all.weft, more.weft);
  append(all.thickness, more.thickness);
  append(all.areal_weight, more.areal_weight);
  append(all.folded, more.folded);
  append(all.yarn_strain, more.yarn_strain);
  append(all.yarn_force, more.yarn_force);
  if (more.contact) append(all.contact ? *all.contact : all.contact.emplace(), *more.contact);
  if (more.between) append(all.between ? *all.between : all.between.emplace(), *more.between);
}

Fields fields_of_ply(const Fields& all, const Mesh& stack, std::size_t ply) {
  if (stack.ply.empty()) return all;
  const Range nodes = nodes_of_ply(stack, ply), yarns = yarns_of_ply(stack, ply), cells = cells_of_ply(stack, ply);
  const auto take = [](const auto& from, const Range& range, auto& to) {
    if (!from.empty()) to.assign(from.begin() + range.first, from.begin() + range.last);
  };
  Fields own;
  own.time = all.time;
  take(all.position, nodes, own.position);
  take(all.displacement, nodes, own.displacement);
  take(all.shear_angle, cells, own.shear_angle);
  take(all.warp, cells, own.warp);
  take(all.weft, cells, own.weft);
  take(all.thickness, cells, own.thickness);
  take(all.areal_weight, cells, own.areal_weight);
  take(all.folded, cells, own.folded);
  take(all.yarn_strain, yarns, own.yarn_strain);
  take(all.yarn_force, yarns, own.yarn_force);
  return own;
}

BlankPlane blank_plane(const Mesh& mesh) {
  if (mesh.nodes.position.empty()) return {};
  const Vector3d normal = unit_or_zero(vector_of(sum_of(oriented_areas(mesh, mesh.nodes.position))));
  const Vec3& origin = mesh.nodes.position.front();
  if (!lies_in_plane(mesh.nodes.position, vector_of(origin), normal)) return {};
  return {origin, array_of(normal)};
}

std::vector<bool> folded_cells(const Mesh& mesh, const BlankPlane& plane, const std::vector<Vec3>& position) {
  const MeshCells& cells = mesh.cells;
  const std::vector<Vec3> area = oriented_areas(mesh, position);
  std::vector<bool> folded(area.size(), false);
  if (area.empty()) return folded;

  // A blank that is and stays planar has one normal, its initial one, by which even a patch turned over whole is known.
  const Vector3d normal = vector_of(plane.normal);
  if (normal.norm() > 0.0 && lies_in_plane(position, vector_of(plane.origin), normal)) {
    for (std::size_t cell = 0; cell < area.size(); ++cell) folded[cell] = dot(area[cell], plane.normal) < 0.0;
    return folded;
  }
  const std::vector<Vec3> at_node = areas_at_nodes(cells, area, mesh.node_count());
  for (int cell = 0; cell < cells.size(); ++cell) {
    Vec3 patch = {0.0, 0.0, 0.0};  // of all other cells at the cell's nodes
    for (int entry = cells.offset[cell]; entry < cells.offset[cell + 1]; ++entry)
      patch = plus(patch, minus(at_node[cells.node[entry]], area[cell]));
    folded[cell] = dot(area[cell], patch) < 0.0;
  }
  return folded;
}

Fields compute_row_fields(const Mesh& mesh, const BlankPlane& plane, double time, const std::vector<Vec3>& position,
                          const std::vector<int>& looked_at) {
  Fields fields;
  fields.time = time;
  fields.position = position;
  fields.shear_angle.assign(mesh.cells.size(), std::numeric_limits<double>::quiet_NaN());
  for (const int cell : looked_at) {
    const UnitDirections g = unit_directions(mesh.cells, cell, position);
    fields.shear_angle[cell] = shear_angle(g.warp, g.weft);
  }
  fields.folded = folded_cells(mesh, plane, position);
  return fields;
}

Fields compute_fields(const Mesh& mesh, const Card& card, const ModelSpec& model, double time,
                      const std::vector<Vec3>& position) {
  Fields fields;
  fields.time = time;
  fields.position = position;
  fields.displacement.resize(position.size());
  for (std::size_t node = 0; node < position.size(); ++node)
    for (int k = 0; k < 3; ++k) fields.displacement[node][k] = position[node][k] - mesh.nodes.position[node][k];

  fill_cells(mesh.cells, fields);
  fill_thickness(mesh, model, fields);
  fields.folded = folded_cells(mesh, blank_plane(mesh), position);
  fill_yarns(mesh, card, model, fields);
  return fields;
}

int most_sheared_cell(const Fields& fields) {
  constexpr double rounding = 1e-9;  // rad
  std::size_t most = 0;
  for (std::size_t c = 1; c < fields.shear_angle.size(); ++c)
    if (std::abs(fields.shear_angle[c]) > std::abs(fields.shear_angle[most]) + rounding) most = c;
  return static_cast<int>(most);
}

}  // namespace weaveform
