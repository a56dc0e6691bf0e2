#include "mesher/drape/drape.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "core/vector/eigen_vector.hpp"
#include "mesher/drape/generator.hpp"
#include "mesher/drape/outline_cells.hpp"
#include "mesher/drape/regions.hpp"
#include "mesher/drape/start.hpp"
#include "mesher/drape/tight_bends.hpp"

namespace weaveform {
namespace {

using Eigen::Vector3d;

// The mesh's lattice as seen from the seed.
struct Lattice {
  NetBox box;                      // one crossing more than the mesh's on every side
  std::array<int, 2> seed;         // the mesh's crossing that lies on the seed
  std::vector<char> wanted;        // crossings of the blank
  std::vector<std::size_t> index;  // per mesh node; of a crossing
};

Lattice lattice_of(const Mesh& mesh, const std::array<int, 2>& seed) {
  Lattice lattice;
  lattice.seed = seed;
  lattice.box = {{-seed[0] - 1, -seed[1] - 1}, {mesh.lattice_size[0] + 2, mesh.lattice_size[1] + 2}};
  lattice.wanted.assign(static_cast<std::size_t>(lattice.box.size[0]) * lattice.box.size[1], 0);
  lattice.index.assign(mesh.node_count(), 0);
  for (int n = 0; n < mesh.node_count(); ++n) {
    const auto& [i, j] = mesh.nodes.crossing[n];
    if (i < 0) continue;
    lattice.index[n] = lattice.box.index(i - seed[0], j - seed[1]);
    lattice.wanted[lattice.index[n]] = 1;
  }
  return lattice;
}

// Tied ends keep in line with their yarn, as the solver will have them.
void place_tied_ends(const Mesh& mesh, Drape& drape) {
  for (const auto& tie : mesh.tie) {
    if (drape.placed[tie.to[0]] == 0 || drape.placed[tie.to[1]] == 0) continue;
    for (int c = 0; c < 3; ++c)
      drape.position[tie.node][c] =
          (1.0 - tie.share) * drape.position[tie.to[0]][c] + tie.share * drape.position[tie.to[1]][c];
    drape.placed[tie.node] = 1;
  }
}

// Other ends (held ones, and those of yarns with one crossing) go on along the surface from their crossing.
void place_other_ends(const Mesh& mesh, const DrapeSurface& surface, const NetStart& start, Drape& drape) {
  std::vector<std::array<int, 2>> beside(mesh.node_count(),
                                         {-1, -1});  // per crossing and family: a crossing next to it
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const auto [a, b] = mesh.yarns.node[e];
    if (mesh.nodes.crossing[a][0] < 0 || mesh.nodes.crossing[b][0] < 0) continue;
    const std::size_t f = mesh.yarns.family[e] == Family::warp ? 0 : 1;
    beside[a][f] = b;
    beside[b][f] = a;
  }
  int hint = 0;
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const auto [a, b] = mesh.yarns.node[e];
    const int end = mesh.nodes.crossing[b][0] < 0 ? b : a, crossing = end == b ? a : b;
    if (mesh.nodes.crossing[end][0] >= 0 || drape.placed[end] != 0 || drape.placed[crossing] == 0) continue;
    const std::size_t f = mesh.yarns.family[e] == Family::warp ? 0 : 1;
    const Vector3d x = vector_of(drape.position[crossing]);
    Vector3d direction;
    const int before = beside[crossing][f], across = beside[crossing][1 - f];
    if (before >= 0 && drape.placed[before] != 0) {
      // towards the end: the neighbour may lie on either side of the crossing
      const bool opposite = (mesh.nodes.crossing[before][f] < mesh.nodes.crossing[crossing][f]) == (end == b);
      direction = (opposite ? 1.0 : -1.0) * (x - vector_of(drape.position[before]));
    } else if (across >= 0 && drape.placed[across] != 0) {
      // the only yarn through this crossing with a direction is the other one: at right angles to it
      Vector3d other = vector_of(drape.position[across]) - x;
      if (mesh.nodes.crossing[across][1 - f] < mesh.nodes.crossing[crossing][1 - f]) other = -other;
      Vector3d normal = surface.normal(x, hint);
      if (normal.dot(start.normal) < 0.0) normal = -normal;
      direction = (f == 0 ? 1.0 : -1.0) * (end == b ? 1.0 : -1.0) * other.cross(normal);
    } else {
      continue;
    }
    const auto found = next_along(surface, x, direction, mesh.yarns.rest_length[e], hint);
    if (!found) continue;
    drape.position[end] = array_of(*found);
    drape.placed[end] = 1;
  }
}

// Free ends on the tool: from their crossing towards the next one of the net beyond the outline, where there is one.
void lay_free_ends(const Mesh& mesh, const DrapeSurface& surface, const DrapedNet& net, const std::array<int, 2>& seed,
                   Drape& drape) {
  drape.laid = drape.position;
  int hint = 0;
  for (const auto& tie : mesh.tie) {
    if (drape.placed[tie.node] == 0 || tie.share >= 0.0 || mesh.nodes.crossing[tie.to[0]][0] < 0) continue;
    const auto &a = mesh.nodes.crossing[tie.to[0]], &b = mesh.nodes.crossing[tie.to[1]];
    const Vector3d x = vector_of(drape.position[tie.to[0]]);
    Vector3d direction = vector_of(drape.position[tie.node]) - x;
    const double length = direction.norm();
    const int i = 2 * a[0] - b[0] - seed[0], j = 2 * a[1] - b[1] - seed[1];  // the crossing after a, away from b
    if (net.box.holds(i, j) && net.placed[net.box.index(i, j)] == Placed::yes)
      direction = net.position[net.box.index(i, j)] - x;
    if (!(length > 0.0)) continue;
    if (const auto found = next_along(surface, x, direction, length, hint)) drape.laid[tie.node] = array_of(*found);
  }
}

// As the solver has them: sin gamma = g1.g2 of the unit yarn directions at the cell's centre; with the orientation
// against the surface's normal, whose sense the flat blank's upper side has at the seed.
void judge_cells(const Mesh& mesh, const DrapeSurface& surface, double sense, Drape& drape) {
  drape.shear_angle.assign(mesh.cells.size(), std::nan(""));
  drape.folded.assign(mesh.cells.size(), 0);
  int hint = 0;
  for (int c = 0; c < mesh.cells.size(); ++c) {
    Vector3d g1 = Vector3d::Zero(), g2 = Vector3d::Zero(), centre = Vector3d::Zero();
    bool whole = true;
    const int begin = mesh.cells.offset[c], end = mesh.cells.offset[c + 1];
    for (int a = begin; a < end; ++a) {
      const int n = mesh.cells.node[a];
      whole = whole && drape.placed[n] != 0;
      const Vector3d x = vector_of(drape.position[n]);
      g1 += mesh.cells.coefficient[a][0] * x;
      g2 += mesh.cells.coefficient[a][1] * x;
      centre += x / (end - begin);
    }
    if (!whole) continue;
    const Vector3d area = g1.cross(g2);
    drape.shear_angle[c] = std::atan2(g1.dot(g2), area.norm());
    drape.folded[c] = sense * area.dot(surface.at(centre, hint).gradient) < 0.0 ? 1 : 0;
  }
}

void take_outline_angles(const OutlineAngles& outline, Drape& drape) {
  drape.extrapolated = outline.extrapolated;
  for (std::size_t c = 0; c < outline.angle.size(); ++c)
    if (!std::isnan(outline.angle[c]) && !std::isnan(drape.shear_angle[c])) drape.shear_angle[c] = outline.angle[c];
}

std::vector<DrapePlace> unreachable_places(const DrapedNet& net, const Lattice& lattice) {
  const NetBox& box = net.box;
  std::vector<char> marked(net.placed.size(), 0);
  // what is laid for the outline cells alone may end where it will
  const std::vector<char> needed = needed_crossings(box, lattice.wanted);
  for (std::size_t k = 0; k < marked.size(); ++k)
    marked[k] =
        net.placed[k] != Placed::yes && (lattice.wanted[k] != 0 || (needed[k] != 0 && net.placed[k] == Placed::nothing))
            ? 1
            : 0;
  std::vector<DrapePlace> places;
  for (const Region& region : connected_regions(marked, box.size, {lattice.seed[0] + 1, lattice.seed[1] + 1})) {
    const int i = region.first[0] + box.low[0], j = region.first[1] + box.low[1];
    // the entry nearest to the seed failed by itself; its neighbour towards the seed has the place to name
    Vector3d at = net.position[box.index(0, 0)];
    for (const auto& [di, dj] : {std::pair(1, 0), {0, 1}, {1, 1}}) {
      const int a = i > 0 ? i - di : (i < 0 ? i + di : i), b = j > 0 ? j - dj : (j < 0 ? j + dj : j);
      if ((a == i && b == j) || net.placed[box.index(a, b)] != Placed::yes) continue;
      at = net.position[box.index(a, b)];
      break;
    }
    const bool past = net.placed[box.index(i, j)] == Placed::past_rim;
    places.push_back({past ? "the net meets the surface's border or a hole; the crossings there have no place"
                           : "the net finds no point of the surface within its yarns' length; crossings from here on "
                             "have no place",
                      array_of(at), region.count});
  }
  return places;
}

std::vector<DrapePlace> fold_places(const Mesh& mesh, const Drape& drape, const std::array<int, 2>& seed) {
  const std::array<int, 2> size = {mesh.lattice_size[0] + 1, mesh.lattice_size[1] + 1};  // cut cells may start at -1
  std::vector<char> marked(static_cast<std::size_t>(size[0]) * size[1], 0);
  std::vector<int> cell(marked.size(), -1);
  for (int c = 0; c < mesh.cells.size(); ++c) {
    const auto k = static_cast<std::size_t>(mesh.cells.lattice[c][1] + 1) * size[0] + (mesh.cells.lattice[c][0] + 1);
    cell[k] = c;
    marked[k] = drape.folded[c];
  }
  std::vector<DrapePlace> places;
  for (const Region& region : connected_regions(marked, size, {seed[0] + 1, seed[1] + 1})) {
    const int c = cell[static_cast<std::size_t>(region.first[1]) * size[0] + region.first[0]];
    const auto& at = drape.position[mesh.cells.node[mesh.cells.offset[c]]];
    places.push_back({"the net folds: cells are turned over; yarns of this length lock before", at, region.count});
  }
  return places;
}

double greatest_length_error(const Mesh& mesh, const Drape& drape) {
  double worst = 0.0;
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const auto [a, b] = mesh.yarns.node[e];
    if (drape.placed[a] == 0 || drape.placed[b] == 0) continue;
    const double length = (vector_of(drape.position[b]) - vector_of(drape.position[a])).norm();
    worst = std::max(worst, std::abs(length / mesh.yarns.rest_length[e] - 1.0));
  }
  return worst;
}

}  // namespace

Drape drape_blank(const Scene& scene, const Mesh& mesh, const std::vector<Tool>& tools) {
  const DrapeStart start = drape_start(scene, mesh, tools);
  const Lattice lattice = lattice_of(mesh, start.crossing);
  const auto began = std::chrono::steady_clock::now();
  std::vector<char> wanted = lattice.wanted;
  want_outline_corners(mesh, start.crossing, lattice.box, wanted);
  const DrapedNet net = drape_net(*start.surface, start.net, lattice.box, wanted);
  Drape drape;
  drape.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  drape.net_cells =
      static_cast<int>(std::count_if(net.placed.begin(), net.placed.end(), [](Placed p) { return p == Placed::yes; }));
  drape.tool = scene.drape->tool;
  drape.seed = array_of(start.net.seed);
  drape.position.assign(mesh.node_count(), array_of(Vector3d::Constant(std::nan(""))));
  drape.carried = drape.position;
  drape.placed.assign(mesh.node_count(), 0);
  for (int n = 0; n < mesh.node_count(); ++n) {
    if (mesh.nodes.crossing[n][0] < 0) continue;
    if (net.placed[lattice.index[n]] == Placed::past_rim) drape.carried[n] = array_of(net.position[lattice.index[n]]);
    if (net.placed[lattice.index[n]] != Placed::yes) continue;
    drape.position[n] = array_of(net.position[lattice.index[n]]);
    drape.placed[n] = 1;
  }
  place_tied_ends(mesh, drape);
  place_other_ends(mesh, *start.surface, start.net, drape);
  lay_free_ends(mesh, *start.surface, net, start.crossing, drape);
  int hint = 0;
  const double sense = start.surface->at(start.net.seed, hint).gradient.dot(start.net.normal) < 0.0 ? -1.0 : 1.0;
  judge_cells(mesh, *start.surface, sense, drape);
  take_outline_angles(outline_angles(mesh, start.crossing, net), drape);
  drape.length_error = greatest_length_error(mesh, drape);
  drape.unreachable = unreachable_places(net, lattice);
  drape.folds = fold_places(mesh, drape, start.crossing);
  drape.tight = tight_bends(*start.surface, start.offset, net, start.net.spacing, lattice.wanted);
  return drape;
}

std::string place_line(const DrapePlace& place) {
  const auto tidy = [](double a) { return std::abs(a) < 5e-7 ? 0.0 : a; };
  return fmt::format("at ({:.6g}, {:.6g}, {:.6g}) mm: {} ({} {})", tidy(place.at[0]), tidy(place.at[1]),
                     tidy(place.at[2]), place.what, place.count, place.count == 1 ? "place" : "places");
}

void lay_drape(const Scene& scene, const Drape& drape, Mesh& mesh) {
  if (!drape.whole()) {
    std::string text = fmt::format(
        "{}[drape] on tool '{}' is no start for a solve; smaller blank, other seed or warp "
        "direction ('weaveform drape' shows where):",
        scene.file.empty() ? "" : scene.file + ": ", drape.tool);
    for (const auto* places : {&drape.unreachable, &drape.folds})
      for (const auto& place : *places) text += "\n  " + place_line(place);
    throw PhysicsError(text);
  }
  mesh.nodes.flat_position = std::move(mesh.nodes.position);
  mesh.nodes.position = drape.position;
}

}  // namespace weaveform
