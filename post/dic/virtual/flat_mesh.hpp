// The flat blank as a surface in which points are found: the cells of the mesh at their initial positions, in the
// blank's own frame (mm, centre = origin). What a point sees of the motion follows from its cell's nodes.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/vector/vector.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/result/fields.hpp"

namespace weaveform::dic {

class FlatMesh {
public:
  FlatMesh(const Mesh& mesh, const BlankSpec& blank);

  // The cell a point lies in (a border belongs to either side), or -1.
  [[nodiscard]] int cell_at(const Vec2& point) const;

  // Adds weight * N_a(point) to `row` for each node a of the cell: mean value coordinates (Floater 2003), which
  // reproduce linear fields and are linear along the yarns at a cell's sides.
  struct Entry {
    int node;
    double weight;
  };
  void add_weights(int cell, const Vec2& point, double weight, std::vector<Entry>& row) const;

  [[nodiscard]] const std::vector<Vec2>& nodes() const { return node_; }
  [[nodiscard]] const Mesh& mesh() const { return mesh_; }
  [[nodiscard]] const BlankSpec& blank() const { return blank_; }
  [[nodiscard]] std::array<double, 4> extent() const { return extent_; }  // xmin, ymin, xmax, ymax

  // World positions of the nodes as positions in the blank's frame.
  [[nodiscard]] std::vector<Vec3> in_blank_frame(const std::vector<Vec3>& world) const;

private:
  [[nodiscard]] bool inside(int cell, const Vec2& point) const;

  const Mesh& mesh_;
  const BlankSpec& blank_;
  std::vector<Vec2> node_;
  std::array<double, 4> extent_;
  double bin_ = 1.0;                  // mm; side of a bin of the search grid
  std::array<int, 2> bins_ = {1, 1};  // along x and y
  std::vector<int> bin_offset_, bin_cell_;
};

// Rows of weights over the nodes: value(i) = sum_k weight[k] * value(node[k]), k in offset[i] .. offset[i+1]-1. A row
// without entries is a point off the fabric.
struct Sampling {
  std::vector<int> offset = {0};
  std::vector<int> node;
  std::vector<double> weight;
  [[nodiscard]] std::size_t size() const { return offset.size() - 1; }
  [[nodiscard]] bool found(std::size_t i) const { return offset[i + 1] > offset[i]; }
  [[nodiscard]] Vec3 value(std::size_t i, const std::vector<Vec3>& on_nodes) const;
};

[[nodiscard]] Sampling sample_points(const FlatMesh& flat, const std::vector<Vec2>& points);

}  // namespace weaveform::dic
