#include "post/dic/virtual/facet.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

namespace weaveform::dic {
namespace {

// Merges entries of the same node.
void append(std::vector<FlatMesh::Entry>& row, Sampling& sampling) {
  std::sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.node < b.node; });
  for (std::size_t k = 0; k < row.size(); ++k) {
    if (k > 0 && row[k].node == row[k - 1].node) {
      sampling.weight.back() += row[k].weight;
    } else {
      sampling.node.push_back(row[k].node);
      sampling.weight.push_back(row[k].weight);
    }
  }
}

// Weights of the facet's points so that their sum is the value at the centre of the least-squares plane through them.
bool weigh_plane(const std::vector<FacetPoint>& facet, const std::vector<int>& cell, std::vector<double>& weight) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < facet.size(); ++k) {
    if (cell[k] < 0) continue;
    const Eigen::Vector3d row(1.0, facet[k].offset[0], facet[k].offset[1]);
    normal += facet[k].weight * row * row.transpose();
  }
  const Eigen::LDLT<Eigen::Matrix3d> solver(normal);
  if (solver.info() != Eigen::Success || !(solver.rcond() > 1e-9)) return false;
  const Eigen::Vector3d at_centre = solver.solve(Eigen::Vector3d::UnitX());
  for (std::size_t k = 0; k < facet.size(); ++k)
    weight[k] =
        cell[k] < 0
            ? 0.0
            : facet[k].weight * (at_centre[0] + at_centre[1] * facet[k].offset[0] + at_centre[2] * facet[k].offset[1]);
  return true;
}

}  // namespace

std::vector<FacetPoint> facet_points(double facet_size) {
  if (!(facet_size > 0.0)) return {{{0.0, 0.0}, 1.0}};
  constexpr int squares = 4;
  const double gauss = 0.5 / std::sqrt(3.0);  // of a square's side, from its centre
  std::vector<double> line;
  for (int i = 0; i < squares; ++i)
    for (const double sign : {-1.0, 1.0}) line.push_back(((i + 0.5 + sign * gauss) / squares - 0.5) * facet_size);
  std::vector<FacetPoint> points;
  const auto count = static_cast<double>(line.size());
  for (const double y : line)
    for (const double x : line) points.push_back({{x, y}, 1.0 / (count * count)});
  return points;
}

Sampling sample_facets(const FlatMesh& flat, const std::vector<Vec2>& centres, double facet_size, double fill,
                       double angle) {
  if (!(facet_size > 0.0)) return sample_points(flat, centres);
  auto facet = facet_points(facet_size);
  const double c = std::cos(angle), s = std::sin(angle);
  for (FacetPoint& point : facet)
    point.offset = {c * point.offset[0] - s * point.offset[1], s * point.offset[0] + c * point.offset[1]};
  Sampling sampling;
  std::vector<FlatMesh::Entry> row;
  std::vector<int> cell(facet.size());
  std::vector<double> weight(facet.size());
  for (const Vec2& centre : centres) {
    row.clear();
    double covered = 0.0;
    const bool centred = flat.cell_at(centre) >= 0;
    for (std::size_t k = 0; k < facet.size(); ++k) {
      cell[k] = centred ? flat.cell_at({centre[0] + facet[k].offset[0], centre[1] + facet[k].offset[1]}) : -1;
      weight[k] = facet[k].weight;
      if (cell[k] >= 0) covered += facet[k].weight;
    }
    const bool whole = covered > 1.0 - 1e-12;
    if (centred && covered >= fill && (whole || weigh_plane(facet, cell, weight))) {
      for (std::size_t k = 0; k < facet.size(); ++k) {
        if (cell[k] < 0) continue;
        const Vec2 point = {centre[0] + facet[k].offset[0], centre[1] + facet[k].offset[1]};
        flat.add_weights(cell[k], point, weight[k], row);
      }
      append(row, sampling);
    }
    sampling.offset.push_back(static_cast<int>(sampling.node.size()));
  }
  return sampling;
}

}  // namespace weaveform::dic
