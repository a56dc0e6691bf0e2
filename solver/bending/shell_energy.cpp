#include "solver/bending/shell_energy.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/vector/eigen_vector.hpp"

namespace weaveform {
namespace {

using Eigen::Vector3d;

// Curvature (1/mm) and transverse shear angle of an edge.
std::array<double, 2> strains(int a, int b, double rest_length, const std::vector<Vec3>& position,
                              const std::vector<Vec3>& director) {
  const Vector3d t = (vector_of(position[b]) - vector_of(position[a])).normalized();
  const double turn = t.dot(vector_of(director[b]) - vector_of(director[a]));
  const double u = turn * turn;
  const double curvature = turn * std::sqrt(1.0 + u / 12 + u * u / 90 + u * u * u / 560) / rest_length;
  return {curvature, 0.5 * t.dot(vector_of(director[b]) + vector_of(director[a]))};
}

}  // namespace

std::vector<ShellEdge> find_shell_edges(const Mesh& mesh, const Card& card, double transverse_shear) {
  std::vector<char> free_end(mesh.node_count(), 0);
  for (const auto& tie : mesh.tie) free_end[tie.node] = tie.share < 0.0 ? 1 : 0;
  std::map<std::array<int, 2>, double> longer;  // mm; by the tied free ends in line with an element
  for (const auto& tie : mesh.tie)
    if (tie.share < 0.0) {
      const auto [first, second] = tie.to;
      const auto &a = mesh.nodes.position[first], &b = mesh.nodes.position[second];
      longer[{std::min(first, second), std::max(first, second)}] +=
          -tie.share * std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    }
  std::vector<ShellEdge> edges;
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const auto node = mesh.yarns.node[e];
    if (free_end[node[0]] != 0 || free_end[node[1]] != 0) continue;
    const int f = mesh.yarns.family[e] == Family::warp ? 0 : 1;
    const auto found = longer.find({std::min(node[0], node[1]), std::max(node[0], node[1])});
    const double free_length = found == longer.end() ? 0.0 : found->second;
    const double yarns = mesh.yarns.yarns[e] * (1.0 + free_length / mesh.yarns.rest_length[e]);
    const double width = yarns * card.yarn[f].interval;
    edges.push_back({node, f, yarns, mesh.yarns.rest_length[e], transverse_shear * width * mesh.yarns.rest_length[e]});
  }
  return edges;
}

double shell_energy(const std::vector<ShellEdge>& edges, const std::vector<TwistCell>& cells, const Flexure& flexure,
                    const std::array<double, 2>& spacing, const std::vector<Vec3>& position,
                    const std::vector<Vec3>& director) {
  double energy = 0.0;
  for (const auto& edge : edges) {
    const auto [curvature, shear] = strains(edge.node[0], edge.node[1], edge.rest_length, position, director);
    energy += edge.yarns * edge.rest_length * flexure.shell[edge.family].energy(curvature) +
              0.5 * edge.shear_stiffness * shear * shear;
  }
  for (const auto& cell : cells) {
    const auto gradient = [&](const std::vector<Vec3>& field, int along) {
      const Vector3d f00 = vector_of(field[cell.node[0]]), f10 = vector_of(field[cell.node[1]]),
                     f11 = vector_of(field[cell.node[2]]), f01 = vector_of(field[cell.node[3]]);
      return Vector3d(0.5 * (along == 0 ? f10 - f00 + f11 - f01 : f01 - f00 + f11 - f10) / spacing[along]);
    };
    const double twist =
        gradient(position, 0).dot(gradient(director, 1)) + gradient(position, 1).dot(gradient(director, 0));
    energy += 0.5 * flexure.twist * cell.area * twist * twist;
  }
  return energy;
}

double shell_hourglass_energy(const std::vector<TwistCell>& cells, const Flexure& flexure, const Card& card,
                              const std::array<double, 2>& spacing, const std::vector<Vec3>& position,
                              const std::vector<Vec3>& director) {
  double energy = 0.0;
  for (const auto& cell : cells)
    for (int f = 0; f < 2; ++f) {
      const auto& n = cell.node;
      const auto lower = strains(n[0], f == 0 ? n[1] : n[3], spacing[f], position, director);
      const auto upper = strains(f == 0 ? n[3] : n[1], n[2], spacing[f], position, director);
      const double curvature = 0.5 * (upper[0] - lower[0]), shear = 0.5 * (upper[1] - lower[1]);
      // the two edges of the mode bend one each way
      const double bent = 0.5 * (flexure.shell[f].energy(curvature) + flexure.shell[f].energy(-curvature));
      energy += cell.area * (bent / card.yarn[f].interval + 0.5 * flexure.transverse_shear * shear * shear);
    }
  return energy;
}

}  // namespace weaveform
