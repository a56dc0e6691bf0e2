#include "solver/ply/critical_step.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <utility>

#include "core/vector/eigen_vector.hpp"
#include "solver/constraint/ties.hpp"
#include "solver/state/shear_levers.hpp"

namespace weaveform {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// MPa; greatest dN/dL L0/A0 of a yarn at least <= e <= 0. Shortening makes it stiffer than its tangent C:
//   incompressible section  exp(-2e) (C - s),  constant section  exp(-e) C        (s <= 0)
// while stretching makes it softer. Bounded in short intervals by the greatest of each factor.
double stiffest_compressed(const TangentLaw& law, double least, bool constant_section) {
  constexpr int intervals = 50;  // at a strain of -0.5 the bound is then within 2 % of the greatest value
  double greatest = 0.0;
  for (int n = 0; n < intervals; ++n) {
    // at zero strain itself the law's tangent is that of tension
    const double from = least * (n + 1) / intervals;
    const double to = std::min(least * n / intervals, -std::numeric_limits<double>::min());
    const double tangent = law.stiffest(from, to);
    const double stiffness =
        constant_section ? std::exp(-from) * tangent : std::exp(-2.0 * from) * (tangent - law.stress(from));
    greatest = std::max(greatest, stiffness);
  }
  return greatest;
}

double greatest_eigenvalue(const Matrix3d& matrix) {
  Eigen::SelfAdjointEigenSolver<Matrix3d> solver;
  solver.computeDirect(matrix, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(2);
}

Matrix3d mirror_matrix(const MeshSymmetry& symmetry, unsigned planes) {
  const auto rows = reflection(symmetry.plane, planes);
  Matrix3d matrix;
  for (int r = 0; r < 3; ++r) matrix.row(r) = vector_of(rows[r]).transpose();
  return matrix;
}

}  // namespace

CriticalStep::CriticalStep(const Mesh& mesh, const Card& card, const std::array<TangentLaw, 2>& yarn_laws,
                           const ModelSpec& model, std::vector<char> held)
    : mesh_(mesh),
      shear_(card.shear),
      yarn_laws_(yarn_laws),
      constant_section_(model.section == Section::constant),
      yarn_shape_(mesh.yarn_count()),
      held_(std::move(held)),
      tied_(mesh.node_count(), 0) {
  for (unsigned planes = 0; planes < 1U << mesh.symmetry.plane.size(); ++planes)
    mirror_.push_back(mirror_matrix(mesh.symmetry, planes));
  for (const auto& tie : mesh.tie) tied_[tie.node] = 1;
  for (const auto& image : mesh.symmetry.image) tied_[image.node] = 1;
  for (int e = 0; e < mesh.yarn_count(); ++e)
    yarn_shape_[e] = mesh.yarns.section[e] * mesh.yarns.softening[e] / (mesh.yarns.rest_length[e] + mesh.yarns.jaw[e]);
}

// Stretching makes a yarn softer than its tangent, dN/dL <= C A0/L0.
std::array<double, 2> CriticalStep::stiffest(const FamilyStrains& allowed) const {
  std::array<double, 2> modulus{};
  for (std::size_t f = 0; f < modulus.size(); ++f)
    modulus[f] = std::max(yarn_laws_[f].stiffest(0.0, allowed[f].greatest),
                          stiffest_compressed(yarn_laws_[f], allowed[f].least, constant_section_));
  return modulus;
}

// An image's rows are those of its node, mirrored.
void CriticalStep::move_images(std::vector<Matrix3d>& bound, std::vector<double>& cell_rows) const {
  for (const auto& image : mesh_.symmetry.image) {
    const Matrix3d& mirror = mirror_[image.planes];
    bound[image.of] += mirror * bound[image.node] * mirror;
    cell_rows[image.of] += cell_rows[image.node];
    bound[image.node].setZero();
    cell_rows[image.node] = 0.0;
  }
}

// A node in a plane has half its mass and half of what is stiff there; the other half is the mirror image. With both
// the bound is that of the whole mesh, to rounding.
void CriticalStep::add_other_sides(std::vector<Matrix3d>& bound) const {
  for (std::size_t k = 0; k < mesh_.symmetry.plane.size(); ++k) {
    const Matrix3d& mirror = mirror_[1U << k];
    for (const int n : mesh_.symmetry.on_plane[k]) bound[n] = 0.5 * (bound[n] + mirror * bound[n] * mirror);
  }
}

NodeStiffness CriticalStep::at_nodes(const std::vector<Vec3>& position,
                                     const std::array<double, 2>& yarn_modulus) const {
  std::vector<Matrix3d> bound(mesh_.node_count(), Matrix3d::Zero());
  for (int e = 0; e < mesh_.yarn_count(); ++e) {
    const auto [a, b] = mesh_.yarns.node[e];
    const Vector3d along = (vector_of(position[b]) - vector_of(position[a])).normalized();
    const double modulus = yarn_modulus[mesh_.yarns.family[e] == Family::warp ? 0 : 1];
    const Matrix3d stiffness = modulus * yarn_shape_[e] * along * along.transpose();
    bound[a] += (held_[b] ? 1.0 : 2.0) * stiffness;
    bound[b] += (held_[a] ? 1.0 : 2.0) * stiffness;
  }
  std::vector<double> cell_rows(mesh_.node_count(), 0.0);
  for (int c = 0; c < mesh_.cells.size(); ++c) {
    const int begin = mesh_.cells.offset[c], end = mesh_.cells.offset[c + 1];
    const ShearLevers lever = shear_levers(mesh_.cells, c, position);
    const double log_strain = std::atanh(lever.sine);
    // w(s): dw/ds = sigma, d2w/ds2 = C_sh / (1 - s^2); derivatives of s in shear_levers.hpp
    const double factor =
        mesh_.cells.area[c] * mesh_.thickness *
        (std::abs(shear_tangent(shear_, log_strain)) + 3.0 * std::abs(shear_stress(shear_, log_strain)));
    for (int a = begin; a < end; ++a) cell_rows[mesh_.cells.node[a]] += factor * lever.sum * lever.of_node[a - begin];
  }
  move_images(bound, cell_rows);
  for (const auto& tie : mesh_.tie) {
    const TieWeights weight = tie_weights(tie.share);
    bound[tie.to[0]] += weight.first * bound[tie.node];
    bound[tie.to[1]] += weight.second * bound[tie.node];
    cell_rows[tie.to[0]] += weight.first * cell_rows[tie.node];
    cell_rows[tie.to[1]] += weight.second * cell_rows[tie.node];
  }
  move_images(bound, cell_rows);
  add_other_sides(bound);
  NodeStiffness stiffness = {.yarns = std::vector<double>(mesh_.node_count(), 0.0), .cells = std::move(cell_rows)};
  for (int n = 0; n < mesh_.node_count(); ++n)
    if (held_[n] != 0 || tied_[n] != 0)
      stiffness.cells[n] = 0.0;
    else
      stiffness.yarns[n] = greatest_eigenvalue(bound[n]);
  return stiffness;
}

StableStep CriticalStep::step(const NodeStiffness& stiffness, std::vector<double> further) const {
  if (!further.empty())
    for (const auto& image : mesh_.symmetry.image) further[image.of] += further[image.node];
  const auto further_at = [&](int n) { return further.empty() ? 0.0 : further[n]; };
  double greatest = 0.0;
  int at = -1;
  for (int n = 0; n < mesh_.node_count(); ++n) {
    if (held_[n] != 0 || tied_[n] != 0) continue;
    const double lambda = (stiffness.yarns[n] + stiffness.cells[n] + further_at(n)) / mesh_.nodes.mass[n];
    if (lambda > greatest) {
      greatest = lambda;
      at = n;
    }
  }
  const double step = greatest > 0.0 ? 2.0 / std::sqrt(greatest) : std::numeric_limits<double>::infinity();
  if (at < 0) return {step, "nothing"};
  const double half = 0.5 * greatest * mesh_.nodes.mass[at];
  const char* part = further_at(at) > half        ? "bending and contact"
                     : stiffness.cells[at] > half ? "shear cells"
                                                  : "yarns";
  return {step, std::string(part) + " at node " + std::to_string(mesh_.shown_node(at))};
}

}  // namespace weaveform
