#include "solver/contact/ply_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weaveform {
namespace {

constexpr double border = 1e-9;  // of a cell: this far outside still counts as inside
// Of a cell: triangles of less height are none. What lies on them lies on the cell beside them, by less than its foot may
// be outside (ply_pass.hpp), and no spring hangs on nodes that nearly coincide.
constexpr double least_height = 0.15;
const double unknown = std::numeric_limits<double>::quiet_NaN();

// (u, v) of every mesh node: a yarn end lies on its yarn's line, its rest length away from the crossing.
std::vector<Vec2> material_of_nodes(const Mesh& mesh) {
  std::vector<Vec2> place(mesh.node_count(), {unknown, unknown});
  for (int n = 0; n < mesh.node_count(); ++n)
    if (const auto [i, j] = mesh.nodes.crossing[n]; i >= 0) place[n] = {static_cast<double>(i), static_cast<double>(j)};
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const auto [a, b] = mesh.yarns.node[e];
    const std::size_t along = mesh.yarns.family[e] == Family::warp ? 0 : 1;
    const double way = mesh.yarns.rest_length[e] / mesh.spacing[along];
    for (const auto& [from, to, sign] : {std::tuple{a, b, 1.0}, std::tuple{b, a, -1.0}})
      if (mesh.nodes.crossing[from][0] >= 0 && mesh.nodes.crossing[to][0] < 0) {
        place[to] = {static_cast<double>(mesh.nodes.crossing[from][0]),
                     static_cast<double>(mesh.nodes.crossing[from][1])};
        place[to][along] += sign * way;
      }
  }
  return place;
}

double outside_of(bool triangle, double xi, double eta) {
  return std::max({-xi, -eta, triangle ? xi + eta - 1.0 : std::max(xi, eta) - 1.0});
}

}  // namespace

PlySurface::PlySurface(const Mesh& mesh, const PackedMesh& packed)
    : stride_(packed.stride), rows_(packed.rows), lattice_nodes_(packed.lattice_nodes()), is_quad_(lattice_nodes_, 0) {
  for (int n = 0; n < lattice_nodes_; ++n) is_quad_[n] = packed.cell_area[n] > 0.0 ? 1 : 0;
  add_triangles(mesh, packed);
  sort_triangles();
}

// Convex polygons, as fans from their first node.
void PlySurface::add_triangles(const Mesh& mesh, const PackedMesh& packed) {
  const auto place = material_of_nodes(mesh);
  for (int c = 0; c < mesh.cells.size(); ++c) {
    if (is_full_quad(mesh, c)) continue;
    const int begin = mesh.cells.offset[c], end = mesh.cells.offset[c + 1];
    for (int k = begin + 1; k + 1 < end; ++k) {
      const std::array<int, 3> node = {mesh.cells.node[begin], mesh.cells.node[k], mesh.cells.node[k + 1]};
      // corners of the outline that no yarn ends at have no place
      if (std::any_of(node.begin(), node.end(), [&](int n) { return std::isnan(place[n][0]); })) continue;
      const Vec2 origin = place[node[0]], first = minus(place[node[1]], origin), second = minus(place[node[2]], origin);
      const double longest = std::max({length(first), length(second), length(minus(second, first))});
      if (!(cross(first, second) > least_height * longest)) continue;
      triangle_.push_back(
          {{packed.packed_of_mesh[node[0]], packed.packed_of_mesh[node[1]], packed.packed_of_mesh[node[2]]},
           origin,
           first,
           second});
    }
  }
}

void PlySurface::sort_triangles() {
  wide_ = stride_ + 2;
  high_ = rows_ + 2;
  std::vector<std::array<int, 2>> entries;  // square, triangle
  for (int t = 0; t < static_cast<int>(triangle_.size()); ++t) {
    const Triangle& tri = triangle_[t];
    const Vec2 b = plus(tri.origin, tri.first), c = plus(tri.origin, tri.second);
    std::array<std::array<int, 2>, 2> range{};
    for (std::size_t k = 0; k < 2; ++k) {
      range[k][0] = static_cast<int>(std::floor(std::min({tri.origin[k], b[k], c[k]}) + border));
      range[k][1] = static_cast<int>(std::floor(std::max({tri.origin[k], b[k], c[k]}) - border));
    }
    for (int j = range[1][0]; j <= range[1][1]; ++j)
      for (int i = range[0][0]; i <= range[0][1]; ++i)
        if (const int at = square(i, j); at >= 0) entries.push_back({at, t});
  }
  std::sort(entries.begin(), entries.end());
  first_.assign(static_cast<std::size_t>(wide_) * high_ + 1, 0);
  for (const auto& entry : entries) ++first_[entry[0] + 1];
  for (std::size_t s = 1; s < first_.size(); ++s) first_[s] += first_[s - 1];
  for (const auto& entry : entries) in_square_.push_back(entry[1]);
}

int PlySurface::square(int i, int j) const {
  return i < -1 || j < -1 || i >= wide_ - 1 || j >= high_ - 1 ? -1 : (j + 1) * wide_ + i + 1;
}

std::array<int, 4> PlySurface::corners(int facet) const {
  if (!is_triangle(facet)) return {facet, facet + 1, facet + stride_, facet + stride_ + 1};
  const auto& node = triangle_[facet - lattice_nodes_].node;
  return {node[0], node[1], node[2], node[0]};
}

Vec2 PlySurface::material(const SurfacePlace& place) const {
  const int row = place.facet / stride_, column = place.facet % stride_;
  if (!is_triangle(place.facet)) return {column + place.xi, row + place.eta};
  const Triangle& tri = triangle_[place.facet - lattice_nodes_];
  return plus(tri.origin, plus(scaled(tri.first, place.xi), scaled(tri.second, place.eta)));
}

SurfacePlace PlySurface::on_facet(int facet, const Vec2& material) const {
  const int row = facet / stride_, column = facet % stride_;
  if (!is_triangle(facet)) return {facet, material[0] - column, material[1] - row};
  const Triangle& tri = triangle_[facet - lattice_nodes_];
  const Vec2 from = minus(material, tri.origin);
  const double twice = cross(tri.first, tri.second);
  return {facet, cross(from, tri.second) / twice, cross(tri.first, from) / twice};
}

Vec2 PlySurface::carried_over(const Vec2& vector, int from, int to) const {
  if (!is_triangle(from) && !is_triangle(to)) return vector;
  const Vec2 zero = material({from, 0.0, 0.0}), tip = material({from, vector[0], vector[1]});
  const SurfacePlace a = on_facet(to, zero), b = on_facet(to, tip);
  return {b.xi - a.xi, b.eta - a.eta};
}

double PlySurface::outside(const SurfacePlace& place) const {
  return outside_of(is_triangle(place.facet), place.xi, place.eta);
}

SurfacePlace PlySurface::held_inside(const SurfacePlace& place) const {
  SurfacePlace held = place;
  held.xi = std::clamp(held.xi, 0.0, 1.0);
  held.eta = std::clamp(held.eta, 0.0, is_triangle(place.facet) ? 1.0 - held.xi : 1.0);
  return held;
}

double PlySurface::away(const SurfacePlace& place) const {
  return plain_length(minus(material(held_inside(place)), material(place)));
}

SurfacePlace PlySurface::find(const Vec2& material) const {
  if (!(std::abs(material[0]) < 1e8 && std::abs(material[1]) < 1e8)) return {};
  // on a line between cells either will do
  for (const double dv : {border, -border})
    for (const double du : {border, -border}) {
      const int i = static_cast<int>(std::floor(material[0] + du)), j = static_cast<int>(std::floor(material[1] + dv));
      const int at = square(i, j);
      if (at < 0) continue;
      if (has_quad(i, j)) return on_facet(j * stride_ + i, material);
      for (int k = first_[at]; k < first_[at + 1]; ++k)
        if (const auto place = on_facet(lattice_nodes_ + in_square_[k], material); outside(place) <= border)
          return place;
    }
  return {};
}

SurfacePlace PlySurface::near(const Vec2& material) const {
  if (const auto place = find(material); place.facet >= 0) return place;
  if (!(std::abs(material[0]) < 1e8 && std::abs(material[1]) < 1e8)) return {};
  const int i0 = static_cast<int>(std::floor(material[0])), j0 = static_cast<int>(std::floor(material[1]));
  // from the place to a square, and so to what of a facet is in it
  const auto way_to = [&](int i, int j) {
    return std::hypot(std::max({0.0, i - material[0], material[0] - i - 1.0}),
                      std::max({0.0, j - material[1], material[1] - j - 1.0}));
  };
  constexpr int reach = 2;
  double way[2 * reach + 1][2 * reach + 1], enough = std::numeric_limits<double>::infinity();
  for (int j = 0; j <= 2 * reach; ++j)
    for (int i = 0; i <= 2 * reach; ++i) {
      way[j][i] = way_to(i0 - reach + i, j0 - reach + j);
      if (has_quad(i0 - reach + i, j0 - reach + j)) enough = std::min(enough, way[j][i]);
    }
  SurfacePlace nearest;
  double least = std::numeric_limits<double>::infinity();
  const auto try_facet = [&](int facet) {
    const auto place = on_facet(facet, material);
    if (const double its = away(place); its < least) {
      least = its;
      nearest = place;
    }
  };
  for (int j = j0 - reach; j <= j0 + reach; ++j)
    for (int i = i0 - reach; i <= i0 + reach; ++i) {
      const int at = square(i, j);
      if (at < 0 || way[j - j0 + reach][i - i0 + reach] > enough + border) continue;
      if (has_quad(i, j)) try_facet(j * stride_ + i);
      for (int k = first_[at]; k < first_[at + 1]; ++k) try_facet(lattice_nodes_ + in_square_[k]);
    }
  return nearest;
}

SurfaceFrame PlySurface::frame(const SurfacePlace& place, const Components& position) const {
  const auto node = corners(place.facet);
  const double twist = is_triangle(place.facet) ? 0.0 : 1.0;
  SurfaceFrame frame;
  for (std::size_t c = 0; c < 3; ++c) {
    const double x0 = position[c][node[0]], e1 = position[c][node[1]] - x0, e2 = position[c][node[2]] - x0;
    const double e3 = twist * (position[c][node[3]] - position[c][node[1]] - e2);
    frame.s1[c] = e1 + place.eta * e3;
    frame.s2[c] = e2 + place.xi * e3;
    frame.point[c] = x0 + place.xi * e1 + place.eta * frame.s2[c];
  }
  return frame;
}

bool PlySurface::follow(SurfacePlace& place, const Vec3& x, const Vec3& normal, const Components& position) const {
  constexpr int most_moves = 200;
  constexpr double there = 1e-12;  // of a cell
  constexpr double longest = 1.5;  // cells in one move: a bilinear cell bends when it is left far behind
  for (int move = 0; move < most_moves; ++move) {
    const auto [point, s1, s2] = frame(place, position);
    const Vec3 r = minus(x, point);
    const Vec3 a = cross(s2, normal), b = cross(normal, s1);
    const double determinant = dot(s1, a);
    if (!(determinant > 0.02 * plain_length(s1) * plain_length(s2) * plain_length(normal))) return false;
    double dxi = dot(r, a) / determinant, deta = dot(r, b) / determinant;
    const double size = std::max(std::abs(dxi), std::abs(deta));
    if (size > longest) {
      dxi *= longest / size;
      deta *= longest / size;
    }
    place.xi += dxi;
    place.eta += deta;
    if (outside(place) <= border) {
      if (size < there) return true;
      continue;
    }
    SurfacePlace next = near(material(place));
    if (next.facet < 0 || (next.facet == place.facet && size < there)) return true;  // off the ply
    place = next;
    if (size < there) return true;
  }
  return false;  // where it has come to means nothing
}

}  // namespace weaveform
