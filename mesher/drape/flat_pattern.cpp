#include "mesher/drape/flat_pattern.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>

#include "core/vector/eigen_vector.hpp"
#include "core/vector/vector.hpp"
#include "mesher/drape/generator.hpp"
#include "mesher/drape/start.hpp"

namespace weaveform {
namespace {

using Eigen::Vector3d;

// How far the yarn goes on along the surface from a crossing: the greatest length up to `most`, by halving.
double length_on_surface(const DrapeSurface& surface, const Vector3d& x, const Vector3d& direction, double most) {
  int hint = 0;
  double least = 0.0;
  for (int n = 0; n < 40; ++n) {
    const double middle = 0.5 * (least + most);
    (next_along(surface, x, direction, middle, hint) ? least : most) = middle;
  }
  return least;
}

class Tracer {
public:
  Tracer(const Scene& scene, const Mesh& mesh, const std::vector<Tool>& tools, const Drape& drape)
      : scene_(scene), mesh_(mesh), drape_(drape), start_(drape_start(scene, mesh, tools)) {
    const std::size_t count = static_cast<std::size_t>(mesh.lattice_size[0]) * mesh.lattice_size[1];
    node_.assign(count, -1);
    for (auto& side : end_) side.assign(count, -1);
    for (int n = 0; n < mesh.node_count(); ++n)
      if (mesh.nodes.crossing[n][0] >= 0) node_[index(mesh.nodes.crossing[n])] = n;
    for (int e = 0; e < mesh.yarn_count(); ++e) {
      const auto [a, b] = mesh.yarns.node[e];
      const std::size_t f = mesh.yarns.family[e] == Family::warp ? 0 : 1;
      if (mesh.nodes.crossing[b][0] < 0) end_[2 * f][index(mesh.nodes.crossing[a])] = e;
      if (mesh.nodes.crossing[a][0] < 0) end_[2 * f + 1][index(mesh.nodes.crossing[b])] = e;
    }
  }

  [[nodiscard]] FlatPattern trace() {
    for (int j = -1; j < mesh_.lattice_size[1]; ++j)
      for (int i = -1; i < mesh_.lattice_size[0]; ++i) walk_cell(i, j);
    return loops();
  }

private:
  // A lattice edge by its lower crossing and family.
  using Edge = std::array<int, 3>;

  [[nodiscard]] std::size_t index(const std::array<int, 2>& c) const {
    return static_cast<std::size_t>(c[1]) * mesh_.lattice_size[0] + c[0];
  }
  [[nodiscard]] int node_at(const std::array<int, 2>& c) const {
    if (c[0] < 0 || c[1] < 0 || c[0] >= mesh_.lattice_size[0] || c[1] >= mesh_.lattice_size[1]) return -1;
    return node_[index(c)];
  }
  [[nodiscard]] bool inside(const std::array<int, 2>& c) const {
    const int n = node_at(c);
    return n >= 0 && drape_.placed[n] != 0;
  }

  // Round a cell counter-clockwise: from each edge where the walk leaves the fabric to the next where it enters, the
  // outline runs with the fabric on its left.
  void walk_cell(int i, int j) {
    const std::array<std::array<int, 2>, 4> corner = {{{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}};
    const std::array<Edge, 4> edge = {{{i, j, 0}, {i + 1, j, 1}, {i, j + 1, 0}, {i, j, 1}}};
    for (std::size_t k = 0; k < 4; ++k) {
      if (!inside(corner[k]) || inside(corner[(k + 1) % 4])) continue;
      std::size_t m = (k + 1) % 4;
      while (!inside(corner[(m + 1) % 4])) m = (m + 1) % 4;
      next_[edge[k]] = edge[m];
    }
  }

  // Where the outline cuts a lattice edge: at the yarn's end, or where the yarn leaves the surface.
  [[nodiscard]] Vec2 cut(const Edge& edge) const {
    const std::size_t f = static_cast<std::size_t>(edge[2]);
    const std::array<int, 2> low = {edge[0], edge[1]};
    std::array<int, 2> high = low;
    ++high[f];
    const bool forward = inside(low);
    const std::array<int, 2> from = forward ? low : high, to = forward ? high : low;
    const int n = node_at(from);
    const Vec2 flat = blank_point(mesh_.nodes.position[n]);
    const int stub = end_[2 * f + (forward ? 0 : 1)][index(from)];
    double length = 0.0;
    if (node_at(to) < 0 && stub >= 0) {
      length = mesh_.yarns.rest_length[stub];
    } else if (node_at(to) >= 0 && !std::isnan(drape_.carried[node_at(to)][0])) {
      const Vector3d x = vector_of(drape_.position[n]);
      length = length_on_surface(*start_.surface, x, vector_of(drape_.carried[node_at(to)]) - x, mesh_.spacing[f]);
    }
    const double angle = scene_.blank.yarn_angle * std::numbers::pi / 180.0 + (f == 0 ? 0.0 : 0.5 * std::numbers::pi);
    const double way = forward ? length : -length;
    return {flat[0] + way * std::cos(angle), flat[1] + way * std::sin(angle)};
  }

  [[nodiscard]] Vec2 blank_point(const std::array<double, 3>& world) const {
    const double angle = scene_.blank.orientation * std::numbers::pi / 180.0;
    const double x = world[0] - scene_.blank.position[0], y = world[1] - scene_.blank.position[1];
    return {std::cos(angle) * x + std::sin(angle) * y, -std::sin(angle) * x + std::cos(angle) * y};
  }

  [[nodiscard]] FlatPattern loops() {
    FlatPattern pattern;
    while (!next_.empty()) {
      auto& loop = pattern.emplace_back();
      for (auto at = next_.begin(); at != next_.end();) {
        loop.push_back(cut(at->first));
        const Edge following = at->second;
        next_.erase(at);
        at = next_.find(following);
      }
    }
    return pattern;
  }

  const Scene& scene_;
  const Mesh& mesh_;
  const Drape& drape_;
  DrapeStart start_;
  std::vector<int> node_;  // per lattice crossing
  std::array<std::vector<int>, 4>
      end_;  // yarn element that ends beyond it: warp ahead, warp back, weft ahead, weft back
  std::map<Edge, Edge> next_;
};

}  // namespace

FlatPattern flat_pattern(const Scene& scene, const Mesh& flat_mesh, const std::vector<Tool>& tools,
                         const Drape& drape) {
  return Tracer(scene, flat_mesh, tools, drape).trace();
}

std::string flat_pattern_csv(const FlatPattern& pattern) {
  std::string text = "loop,x_mm,y_mm\n";
  for (std::size_t k = 0; k < pattern.size(); ++k)
    for (const auto& p : pattern[k]) text += fmt::format("{},{:.9g},{:.9g}\n", k, p[0], p[1]);
  return text;
}

double pattern_area(const FlatPattern& pattern) {
  double area = 0.0;
  for (const auto& loop : pattern)
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const auto &a = loop[k], &b = loop[(k + 1) % loop.size()];
      area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
  return area;
}

}  // namespace weaveform
