#include "post/transfer/fibre_field.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/vector/eigen_vector.hpp"
#include "mesher/exchange/gathered.hpp"
#include "mesher/mesh/stack.hpp"
#include "solver/result/result_folder.hpp"

namespace weaveform {

namespace {

using Eigen::Vector3d;

// g_f = sum_a coefficient[f][a] x_a (mesh.hpp).
std::array<Vector3d, 2> yarn_vectors(const MeshCells& cells, int cell, const std::vector<Vec3>& position) {
  std::array<Vector3d, 2> g = {Vector3d::Zero(), Vector3d::Zero()};
  for (int k = cells.offset[cell]; k < cells.offset[cell + 1]; ++k)
    for (std::size_t f = 0; f < 2; ++f) g[f] += cells.coefficient[k][f] * vector_of(position[cells.node[k]]);
  return g;
}

FibreState state_of(const Mesh& mesh, const ModelSpec& model, int cell, const std::vector<Vec3>& position) {
  const auto g = yarn_vectors(mesh.cells, cell, position);
  const Vector3d normal = g[0].cross(g[1]);
  const double ratio = normal.norm();  // J
  if (!(ratio > 0.0))
    throw InputError(fmt::format("cell {} has collapsed to a line: no directions can be given", cell));
  FibreState state;
  const Vector3d warp = g[0].normalized(), weft = g[1].normalized();
  state.warp = array_of(warp);
  state.weft = array_of(weft);
  state.shear_angle = std::atan2(warp.dot(weft), warp.cross(weft).norm());
  state.thickness = model.thickness == Thickness::constant_volume ? mesh.thickness / ratio : mesh.thickness;
  state.fibre_mass_ratio = 1.0 / ratio;
  state.fibre_volume_ratio = mesh.thickness / (ratio * state.thickness);
  return state;
}

}  // namespace

Vec3 centre_of(const std::vector<int>& node, const std::vector<Vec3>& position) {
  Vector3d sum = Vector3d::Zero();
  for (const int n : node) sum += vector_of(position[n]);
  return array_of(sum / static_cast<double>(node.size()));
}

FibreField fibre_field(const Mesh& mesh, const Scene& scene, const std::vector<Vec3>& position) {
  FibreField field;
  field.position = position;
  field.flat_thickness = mesh.thickness;
  const double angle = (scene.blank.yarn_angle + scene.blank.orientation) * std::numbers::pi / 180.0;
  field.flat_direction = {Vec3{std::cos(angle), std::sin(angle), 0.0}, Vec3{-std::sin(angle), std::cos(angle), 0.0}};
  const auto shells = foreign::shells_of(mesh.cells);
  for (std::size_t k = 0; k < shells.size(); ++k) {
    StateElement element;
    element.number = mesh.yarn_count() + 1 + static_cast<long>(k);
    element.node.assign(shells[k].node.begin(), shells[k].node.begin() + shells[k].size());
    element.centre = centre_of(element.node, position);
    element.state = state_of(mesh, scene.model, shells[k].cell, position);
    field.element.push_back(std::move(element));
  }
  return field;
}

FibreField read_fibre_field(ResultFolder& folder) {
  const FrameFile& last = folder.frames().back();
  FibreField field = fibre_field(folder.mesh(), folder.scene(), folder.positions(last));
  field.source = fmt::format("{} at {:.6g} s", folder.directory().string(), last.time);
  return field;
}

FibreField read_fibre_field(ResultFolder& folder, std::size_t ply) {
  const FrameFile& last = folder.frames().back();
  const std::vector<Vec3> all = folder.positions(last);
  const Resolved& model = folder.model();
  const Range nodes = nodes_of_ply(model.mesh, ply);
  FibreField field = fibre_field(model.of_ply(ply).mesh, model.of_ply(ply).scene,
                                 {all.begin() + nodes.first, all.begin() + nodes.last});
  field.source = fmt::format("{}{} at {:.6g} s", name_before(model, ply), folder.directory().string(), last.time);
  return field;
}

}  // namespace weaveform
