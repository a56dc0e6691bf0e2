#include "mesher/lattice/cut_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/vector/vector.hpp"

namespace weaveform::lattice {

namespace {

// Lattice cells (i, j) with -1 <= i < size[0], -1 <= j < size[1], as a flat array.
struct CellGrid {
  std::array<int, 2> size;
  explicit CellGrid(const Grid& grid) : size{grid.size[0] + 1, grid.size[1] + 1} {}
  [[nodiscard]] bool holds(int i, int j) const { return i >= -1 && j >= -1 && i < size[0] - 1 && j < size[1] - 1; }
  [[nodiscard]] std::size_t index(int i, int j) const { return static_cast<std::size_t>(j + 1) * size[0] + (i + 1); }
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(size[0]) * size[1]; }
};

Box cell_box(const Grid& grid, int i, int j) {
  return {{grid.at(0, i), grid.at(1, j)}, {grid.at(0, i + 1), grid.at(1, j + 1)}};
}

// The cells an edge passes through, row by row: only they need clipping.
void mark_edge(const OutlineEdge& edge, const Grid& grid, const CellGrid& cells, std::vector<std::uint8_t>& marked) {
  const auto cell_of = [&](int axis, double x) {
    return std::clamp(static_cast<int>(std::floor((x - grid.origin[axis]) / grid.spacing[axis])), -1,
                      grid.size[axis] - 1);
  };
  const double margin = 2.0 * grid.tolerance;
  const Vec2& bottom = edge.from[1] <= edge.to[1] ? edge.from : edge.to;
  const Vec2& top = edge.from[1] <= edge.to[1] ? edge.to : edge.from;
  const double rise = top[1] - bottom[1];
  for (int j = cell_of(1, bottom[1] - margin); j <= cell_of(1, top[1] + margin); ++j) {
    const auto u_at = [&](double v) {
      const double t = rise > 0.0 ? std::clamp((v - bottom[1]) / rise, 0.0, 1.0) : (v > bottom[1] ? 1.0 : 0.0);
      return bottom[0] + t * (top[0] - bottom[0]);
    };
    const double a = u_at(grid.at(1, j) - margin);
    const double b = u_at(grid.at(1, j + 1) + margin);
    for (int i = cell_of(0, std::min(a, b) - margin); i <= cell_of(0, std::max(a, b) + margin); ++i)
      marked[cells.index(i, j)] = 1;
  }
}

bool misses_crossing(const YarnNet& net, int i, int j) {
  for (int b = std::max(0, j); b <= std::min(j + 1, net.grid.size[1] - 1); ++b)
    for (int a = std::max(0, i); a <= std::min(i + 1, net.grid.size[0] - 1); ++a)
      if (net.crossing[net.index(0, b, a)] == Crossing::taken_out) return true;
  return false;
}

// Crossings and yarn ends on the cell's border, counter-clockwise from the lowest corner.
void gather_nodes(const YarnNet& net, int i, int j, std::vector<int>& node) {
  node.clear();
  const auto add = [&](int n) {
    if (n >= 0) node.push_back(n);
  };
  const auto ends = [&](int family, int which_line, int k, bool forward) {
    const int after = net.end_beside(family, which_line, k, high);
    const int before = net.end_beside(family, which_line, k + 1, low);
    add(forward ? after : before);
    add(forward ? before : after);
  };
  add(net.node_at(i, j));
  ends(0, j, i, true);
  add(net.node_at(i + 1, j));
  ends(1, i + 1, j, true);
  add(net.node_at(i + 1, j + 1));
  ends(0, j + 1, i, false);
  add(net.node_at(i, j + 1));
  ends(1, i, j, false);
}

double corner_area(const Vec2& before, const Vec2& at, const Vec2& after) {
  return 0.5 * std::abs(cross(minus(at, before), minus(after, before)));
}

// A cell whose corners are cut off three times or more has seven nodes or eight, and a mesh's cells six at most: the
// yarn ends that stand out least from between their neighbours are left to the cells beside it. The fit below stays
// exact for every homogeneous deformation.
void leave_out_flattest(const YarnNet& net, std::vector<int>& node) {
  constexpr std::size_t most_nodes = 6;
  while (node.size() > most_nodes) {
    const std::size_t count = node.size();
    std::size_t flattest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < count; ++k) {
      const double area =
          corner_area(net.place[node[(k + count - 1) % count]], net.place[node[k]], net.place[node[(k + 1) % count]]);
      if (area >= least) continue;
      least = area;
      flattest = k;
    }
    node.erase(node.begin() + static_cast<std::ptrdiff_t>(flattest));
  }
}

// Least-squares fit of a linear map x(xi) to the nodes: with the scatter S = sum_a (xi_a - mean)(xi_a - mean)^T,
//   dx/dxi_f = sum_a c[f][a] x_a ,   c[f][a] = e_f . S^-1 (xi_a - mean) .
// Exact for every homogeneous deformation; on a whole quad it is the bilinear gradient at the centre, c = +-1/(2h).
// False when the nodes scatter too little for it.
bool fit_gradient(const YarnNet& net, const std::vector<int>& node, std::vector<Vec2>& coefficient) {
  if (node.size() < 3) return false;
  const Vec2& h = net.grid.spacing;
  // From the first node, then from the mean: taken from the blank's origin, the rounding of the mean would leave the
  // coefficients a sum that is not quite zero, to be multiplied with positions far away.
  const Vec2 origin = net.place[node.front()];
  Vec2 mean = {0.0, 0.0};  // 1; in units of the spacing, like all below
  coefficient.clear();
  for (const int n : node) {
    coefficient.push_back({(net.place[n][0] - origin[0]) / h[0], (net.place[n][1] - origin[1]) / h[1]});
    for (std::size_t f = 0; f < 2; ++f) mean[f] += coefficient.back()[f] / static_cast<double>(node.size());
  }
  double s00 = 0.0, s01 = 0.0, s11 = 0.0;
  for (auto& d : coefficient) {
    d = {d[0] - mean[0], d[1] - mean[1]};
    s00 += d[0] * d[0];
    s01 += d[0] * d[1];
    s11 += d[1] * d[1];
  }
  const double least = 0.5 * (s00 + s11) - std::hypot(0.5 * (s00 - s11), s01);
  if (least < least_scatter) return false;
  const double determinant = s00 * s11 - s01 * s01;
  for (auto& d : coefficient)
    d = {(s11 * d[0] - s01 * d[1]) / (determinant * h[0]), (s00 * d[1] - s01 * d[0]) / (determinant * h[1])};
  return true;
}

// Area of a cut cell that could not stand alone.
struct Sliver {
  int i, j;
  double area;    // mm^2
  Vec2 centroid;  // mm
};

Vec2 mean_place(const YarnNet& net, const MeshCells& cells, int c) {
  Vec2 mean = {0.0, 0.0};
  const double count = cells.offset[c + 1] - cells.offset[c];
  for (int k = cells.offset[c]; k < cells.offset[c + 1]; ++k)
    for (std::size_t f = 0; f < 2; ++f) mean[f] += net.place[cells.node[k]][f] / count;
  return mean;
}

// The cell nearest to a sliver, searched ring by ring around it; one ring more than the first hit, for the corners of a
// ring are further away than the sides of the next.
int nearest_cell(const YarnNet& net, const MeshCells& cells, const CellGrid& grid, const std::vector<int>& cell_at,
                 const Sliver& sliver) {
  int best = -1;
  double best_distance = std::numeric_limits<double>::infinity();
  int last_ring = std::max(grid.size[0], grid.size[1]);
  for (int ring = 1; ring <= last_ring; ++ring) {
    for (int j = sliver.j - ring; j <= sliver.j + ring; ++j) {
      for (int i = sliver.i - ring; i <= sliver.i + ring; ++i) {
        const bool on_ring = std::max(std::abs(i - sliver.i), std::abs(j - sliver.j)) == ring;
        if (!on_ring || !grid.holds(i, j) || cell_at[grid.index(i, j)] < 0) continue;
        const int c = cell_at[grid.index(i, j)];
        const Vec2 mean = mean_place(net, cells, c);
        const double distance = std::hypot(mean[0] - sliver.centroid[0], mean[1] - sliver.centroid[1]);
        if (distance < best_distance) {
          if (best < 0) last_ring = std::min(last_ring, ring + 1);
          best_distance = distance;
          best = c;
        }
      }
    }
  }
  return best;
}

}  // namespace

MeshCells cut_cells(const YarnNet& net, const Outline& outline) {
  const Grid& grid = net.grid;
  const CellGrid cell_grid(grid);
  std::vector<std::uint8_t> marked(cell_grid.count(), 0);
  for (const auto& edge : outline.edge) mark_edge(edge, grid, cell_grid, marked);

  MeshCells cells;
  std::vector<int> cell_at(cell_grid.count(), -1);
  std::vector<Sliver> slivers;
  std::vector<int> node;
  std::vector<Vec2> coefficient;
  const double whole_area = grid.spacing[0] * grid.spacing[1];
  const Vec2 half = {0.5 / grid.spacing[0], 0.5 / grid.spacing[1]};
  const std::vector<Vec2> whole = {{-half[0], -half[1]}, {half[0], -half[1]}, {half[0], half[1]}, {-half[0], half[1]}};
  for (int j = -1; j < grid.size[1]; ++j) {
    for (int i = -1; i < grid.size[0]; ++i) {
      const std::size_t k = cell_grid.index(i, j);
      const std::array<int, 4> corner = {net.node_at(i, j), net.node_at(i + 1, j), net.node_at(i + 1, j + 1),
                                         net.node_at(i, j + 1)};
      const bool quad = *std::min_element(corner.begin(), corner.end()) >= 0;
      if (quad) node.assign(corner.begin(), corner.end());
      if (quad && marked[k] == 0) {
        cell_at[k] = cells.size();
        cells.add(node, whole, whole_area, {i, j});
        continue;
      }
      // Away from the outline only a crossing that was taken out leaves a cell incomplete inside the blank.
      if (marked[k] == 0 && !misses_crossing(net, i, j)) continue;
      const Moments inside = moments_in_box(outline, cell_box(grid, i, j));
      if (inside.area <= 1e-12 * whole_area) continue;
      if (!quad) {
        gather_nodes(net, i, j, node);
        leave_out_flattest(net, node);
      }
      if (quad || fit_gradient(net, node, coefficient)) {
        cell_at[k] = cells.size();
        cells.add(node, quad ? whole : coefficient, inside.area, {i, j});
      } else {
        slivers.push_back({i, j, inside.area, {inside.first[0] / inside.area, inside.first[1] / inside.area}});
      }
    }
  }
  for (const auto& sliver : slivers) {
    const int c = nearest_cell(net, cells, cell_grid, cell_at, sliver);
    if (c >= 0) cells.area[c] += sliver.area;
  }
  return cells;
}

}  // namespace weaveform::lattice
