#include "post/dic/virtual/flat_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "solver/result/probe.hpp"

namespace weaveform::dic {
namespace {

constexpr std::size_t greatest_polygon = 16;  // nodes of a cell; the mesh has 3 to 6

}  // namespace

FlatMesh::FlatMesh(const Mesh& mesh, const BlankSpec& blank) : mesh_(mesh), blank_(blank) {
  for (const auto& world : mesh.nodes.position) node_.push_back(blank_coordinates(blank, world));
  extent_ = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (const int node : mesh.cells.node)
    for (std::size_t k = 0; k < 2; ++k) {
      extent_[k] = std::min(extent_[k], node_[node][k]);
      extent_[k + 2] = std::max(extent_[k + 2], node_[node][k]);
    }
  // Bins as large as a cell, so that each holds a few.
  bin_ = std::max({mesh.spacing[0], mesh.spacing[1], 1e-6 * (extent_[2] - extent_[0] + extent_[3] - extent_[1])});
  for (std::size_t k = 0; k < 2; ++k)
    bins_[k] = std::max(1, static_cast<int>(std::ceil((extent_[k + 2] - extent_[k]) / bin_)));
  const auto bin_of = [&](double x, std::size_t k) {
    return std::clamp(static_cast<int>(std::floor((x - extent_[k]) / bin_)), 0, bins_[k] - 1);
  };
  std::vector<std::vector<int>> cells(static_cast<std::size_t>(bins_[0]) * bins_[1]);
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    std::array<double, 4> box = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int a = mesh.cells.offset[cell]; a < mesh.cells.offset[cell + 1]; ++a)
      for (std::size_t k = 0; k < 2; ++k) {
        box[k] = std::min(box[k], node_[mesh.cells.node[a]][k]);
        box[k + 2] = std::max(box[k + 2], node_[mesh.cells.node[a]][k]);
      }
    for (int j = bin_of(box[1], 1); j <= bin_of(box[3], 1); ++j)
      for (int i = bin_of(box[0], 0); i <= bin_of(box[2], 0); ++i)
        cells[static_cast<std::size_t>(j) * bins_[0] + i].push_back(cell);
  }
  bin_offset_ = {0};
  for (const auto& bin : cells) {
    bin_cell_.insert(bin_cell_.end(), bin.begin(), bin.end());
    bin_offset_.push_back(static_cast<int>(bin_cell_.size()));
  }
}

bool FlatMesh::inside(int cell, const Vec2& point) const {
  const int begin = mesh_.cells.offset[cell], end = mesh_.cells.offset[cell + 1];
  const double tolerance = 1e-9 * bin_ * bin_;
  for (int a = begin; a < end; ++a) {
    const Vec2& from = node_[mesh_.cells.node[a]];
    const Vec2& to = node_[mesh_.cells.node[a + 1 == end ? begin : a + 1]];
    if (cross(minus(to, from), minus(point, from)) < -tolerance) return false;
  }
  return true;
}

int FlatMesh::cell_at(const Vec2& point) const {
  std::array<int, 2> at{};
  for (std::size_t k = 0; k < 2; ++k) {
    const double along = (point[k] - extent_[k]) / bin_;
    if (!(along > -1e-6) || !(along < bins_[k] + 1e-6)) return -1;
    at[k] = std::clamp(static_cast<int>(along), 0, bins_[k] - 1);
  }
  const std::size_t bin = static_cast<std::size_t>(at[1]) * bins_[0] + at[0];
  for (int k = bin_offset_[bin]; k < bin_offset_[bin + 1]; ++k)
    if (inside(bin_cell_[k], point)) return bin_cell_[k];
  return -1;
}

void FlatMesh::add_weights(int cell, const Vec2& point, double weight, std::vector<Entry>& row) const {
  const int begin = mesh_.cells.offset[cell];
  const auto count = static_cast<std::size_t>(mesh_.cells.offset[cell + 1] - begin);
  std::array<Vec2, greatest_polygon> to{};
  std::array<double, greatest_polygon> distance{}, half_tangent{};
  const double touching = 1e-9 * bin_;
  for (std::size_t a = 0; a < count; ++a) {
    to[a] = minus(node_[mesh_.cells.node[begin + static_cast<int>(a)]], point);
    distance[a] = std::hypot(to[a][0], to[a][1]);
    if (distance[a] < touching) {
      row.push_back({mesh_.cells.node[begin + static_cast<int>(a)], weight});
      return;
    }
  }
  double sum = 0.0;
  std::array<double, greatest_polygon> value{};
  for (std::size_t a = 0; a < count; ++a) {
    const std::size_t b = (a + 1) % count;
    const double area = cross(to[a], to[b]), along = dot(to[a], to[b]);
    if (std::abs(area) < touching * bin_ && along < 0.0) {  // on the side between a and b
      const double share = distance[a] / (distance[a] + distance[b]);
      row.push_back({mesh_.cells.node[begin + static_cast<int>(a)], weight * (1.0 - share)});
      row.push_back({mesh_.cells.node[begin + static_cast<int>(b)], weight * share});
      return;
    }
    // tan(alpha/2) = sin / (1 + cos)
    half_tangent[a] = area / (distance[a] * distance[b] + along);
  }
  for (std::size_t a = 0; a < count; ++a) {
    value[a] = (half_tangent[(a + count - 1) % count] + half_tangent[a]) / distance[a];
    sum += value[a];
  }
  for (std::size_t a = 0; a < count; ++a)
    row.push_back({mesh_.cells.node[begin + static_cast<int>(a)], weight * value[a] / sum});
}

std::vector<Vec3> FlatMesh::in_blank_frame(const std::vector<Vec3>& world) const {
  std::vector<Vec3> result(world.size());
  for (std::size_t i = 0; i < world.size(); ++i) {
    const auto [x, y] = blank_coordinates(blank_, world[i]);
    result[i] = {x, y, world[i][2] - blank_.position[2]};
  }
  return result;
}

Vec3 Sampling::value(std::size_t i, const std::vector<Vec3>& on_nodes) const {
  Vec3 sum = {0.0, 0.0, 0.0};
  for (int k = offset[i]; k < offset[i + 1]; ++k)
    for (std::size_t c = 0; c < 3; ++c) sum[c] += weight[k] * on_nodes[node[k]][c];
  return sum;
}

Sampling sample_points(const FlatMesh& flat, const std::vector<Vec2>& points) {
  Sampling sampling;
  std::vector<FlatMesh::Entry> row;
  for (const Vec2& point : points) {
    row.clear();
    const int cell = flat.cell_at(point);
    if (cell >= 0) flat.add_weights(cell, point, 1.0, row);
    for (const auto& [node, weight] : row) {
      sampling.node.push_back(node);
      sampling.weight.push_back(weight);
    }
    sampling.offset.push_back(static_cast<int>(sampling.node.size()));
  }
  return sampling;
}

}  // namespace weaveform::dic
