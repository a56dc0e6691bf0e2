#include "mesher/lattice/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/keys/advice.hpp"
#include "mesher/drape/drape.hpp"
#include "mesher/lattice/cross.hpp"
#include "mesher/lattice/cut_cells.hpp"
#include "mesher/lattice/fit.hpp"
#include "mesher/lattice/frame.hpp"
#include "mesher/lattice/free_ends.hpp"
#include "mesher/lattice/grips.hpp"
#include "mesher/lattice/lumping.hpp"
#include "mesher/lattice/net.hpp"
#include "mesher/lattice/outline.hpp"
#include "mesher/lattice/strips.hpp"
#include "mesher/outline/blank_outline.hpp"

namespace weaveform::lattice {

namespace {

// Fewer cells than this across the blank are no fabric: there would be more edge than inside.
constexpr double fewest_cells = 3.0;

// "scene.toml: " before every complaint about a scene that came from a file.
[[noreturn]] void complain(const Scene& scene, std::vector<std::string> lines) {
  if (!scene.file.empty())
    for (auto& line : lines) line = scene.file + ": " + line;
  throw InputError(std::move(lines));
}

// The spacing of the model's crossings along the warp is that of its weft yarns, and the other way round.
Vec2 model_spacing(const BlankSpec& blank, const Card& card) {
  return {blank.coarsening[1] * card.yarn[1].interval, blank.coarsening[0] * card.yarn[0].interval};
}

// Yarns per model yarn at the spacing the lines really have.
std::array<double, 2> real_coarsening(const Vec2& spacing, const Card& card) {
  return {spacing[1] / card.yarn[0].interval, spacing[0] / card.yarn[1].interval};
}

// Along the blank's own axes.
Vec2 extent_of(const Outline& outline, const Turn& yarns) {
  Outline turned = outline;
  for (auto& edge : turned.edge) edge = {yarns.forward(edge.from), yarns.forward(edge.to), {}};
  const Box box = bounding_box(turned);
  return {box.high[0] - box.low[0], box.high[1] - box.low[1]};
}

// A blank smaller than a model yarn's interval in both directions is no blank; a thousand times as large it is one.
std::string metres_question(const Vec2& extent, const Vec2& spacing) {
  constexpr double a_thousand = 1000.0;  // mm in a metre
  const double least = std::min(spacing[0], spacing[1]);
  if (std::max(extent[0], extent[1]) >= least || a_thousand * std::max(extent[0], extent[1]) < least) return "";
  return fmt::format(
      "blank: it is {:.4g} x {:.4g} mm, {:.2g} of the {:.4g} mm between model yarns: is it in metres? Lengths are in "
      "mm, "
      "{:.4g} x {:.4g}",
      extent[0], extent[1], std::max(extent[0], extent[1]) / least, least, a_thousand * extent[0],
      a_thousand * extent[1]);
}

// Cells met along the blank's own axes, and lines of either family across the whole blank.
void check_size(const BlankSpec& blank, const Outline& outline, const Turn& yarns, const Vec2& spacing,
                std::vector<std::string>& complaints) {
  constexpr double rounding = 1e-9;
  const double c = std::abs(yarns.cosine);
  const double s = std::abs(yarns.sine);
  const std::array<double, 2> per_mm = {std::max(c / spacing[0], s / spacing[1]),
                                        std::max(s / spacing[0], c / spacing[1])};
  const Vec2 extent = extent_of(outline, yarns);
  if (const std::string question = metres_question(extent, spacing); !question.empty())
    return complaints.push_back(question);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double cells = extent[axis] * per_mm[axis];
    if (cells >= fewest_cells - rounding) continue;
    complaints.push_back(fmt::format(
        "blank.size: {:.6g} mm along the blank's {} axis are only {:.3g} cells of {:.6g} x {:.6g} mm; make it at least "
        "{:.6g} mm, or blank.coarsening smaller by {:.3g}",
        extent[axis], axis == 0 ? "x" : "y", cells, spacing[0], spacing[1], rounded_up(fewest_cells / per_mm[axis], 6),
        rounded_up(fewest_cells / cells, 3)));
  }
  const Box box = bounding_box(outline);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double cells = (box.high[axis] - box.low[axis]) / spacing[axis];
    if (cells >= fewest_cells - rounding) continue;
    complaints.push_back(fmt::format(
        "blank.coarsening: {} yarns every {:.6g} mm leave only {:.3g} cells across the blank; make coarsening[{}] at "
        "most {:.3g}",
        axis == 0 ? "weft" : "warp", spacing[axis], cells, 1 - axis,
        rounded_down(blank.coarsening[1 - axis] * cells / fewest_cells, 3)));
  }
}

// Lines that go through the whole roll, seen from a blank whose centre lies at on_roll (mm along warp and weft).
LineLayout lines_of_roll(const BlankSpec& blank, const Vec2& asked) {
  LineLayout lines{asked, {}};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double spacings = -(*blank.on_roll)[axis] / asked[axis];
    lines.phase[1 - axis] = spacings - std::round(spacings);  // phase[0] moves the warp lines, which lie across
  }
  return lines;
}

// Fitted to the grips, unless the user places the lines: by fit = "none", or by a phase of his own. A blank so small
// that the fit would leave too few cells keeps the asked spacing.
LineLayout choose_lines(const BlankSpec& blank, const Outline& outline, const GripRegions& grips, const Vec2& asked) {
  if (blank.on_roll) return lines_of_roll(blank, asked);
  const LineLayout as_asked{asked, blank.phase};
  if (blank.fit == LineFit::none || blank.phase != Vec2{0.0, 0.0}) return as_asked;
  const LineLayout fitted = fit_lines(outline, grips, asked);
  std::vector<std::string> too_few;
  check_size(blank, outline, grips.yarns, fitted.spacing, too_few);
  return too_few.empty() ? fitted : as_asked;
}

std::vector<int> cells_per_node(const YarnNet& net, const MeshCells& cells) {
  std::vector<int> count(net.place.size(), 0);
  for (const int n : cells.node) ++count[n];
  return count;
}

std::vector<int> elements_per_node(const YarnNet& net) {
  std::vector<int> count(net.place.size(), 0);
  for (int family = 0; family < 2; ++family)
    for (int c = 0; c < static_cast<int>(net.line[family].size()); ++c)
      for (const auto& chord : net.line[family][c]) {
        if (!chord.meshed()) continue;
        for (int k = chord.crossing[low]; k <= chord.crossing[high]; ++k) {
          const int n = net.node[net.index(family, c, k)];
          if (n >= 0) ++count[n];
        }
      }
  return count;
}

// Takes out what hangs loose: crossings that no cell or no yarn element would hold, and free yarn ends that no cell
// would. True when there was any.
bool prune(YarnNet& net, const MeshCells& cells) {
  bool pruned = false;
  const std::vector<int> cell_count = cells_per_node(net, cells);
  const std::vector<int> element_count = elements_per_node(net);
  for (std::size_t k = 0; k < net.node.size(); ++k) {
    const int n = net.node[k];
    if (n < 0 || (cell_count[n] > 0 && element_count[n] > 0)) continue;
    net.crossing[k] = Crossing::taken_out;
    pruned = true;
  }
  for (auto& family : net.line)
    for (auto& on_line : family)
      for (auto& chord : on_line)
        for (const Side side : {low, high}) {
          const int n = chord.end_node[side];
          if (n < 0 || chord.grip[side] >= 0 || cell_count[n] > 0) continue;
          chord.barred[side] = true;
          pruned = true;
        }
  return pruned;
}

// The node before, between and after the crossings of a chord, in order along the yarn.
std::vector<int> nodes_along(const YarnNet& net, int family, int which_line, const Chord& chord) {
  std::vector<int> along;
  if (chord.ended[low]) along.push_back(chord.end_node[low]);
  for (int k = chord.crossing[low]; k <= chord.crossing[high]; ++k) {
    const int n = net.node[net.index(family, which_line, k)];
    if (n >= 0) along.push_back(n);
  }
  if (chord.ended[high]) along.push_back(chord.end_node[high]);
  return along;
}

void lay_yarns(const YarnNet& net, const Card& card, MeshYarns& yarns) {
  for (int family = 0; family < 2; ++family) {
    for (int c = 0; c < static_cast<int>(net.line[family].size()); ++c) {
      for (const auto& chord : net.line[family][c]) {
        if (!chord.meshed()) continue;
        const std::vector<int> along = nodes_along(net, family, c, chord);
        for (std::size_t k = 0; k + 1 < along.size(); ++k) {
          yarns.add({.node = {along[k], along[k + 1]},
                     .family = static_cast<Family>(family),
                     .rest_length = net.place[along[k + 1]][family] - net.place[along[k]][family],
                     .section = chord.yarns * card.yarn[family].section,
                     .yarns = chord.yarns});
        }
      }
    }
  }
}

// Lattice indices from zero on, over the crossings that are in the mesh.
void index_crossings(const YarnNet& net, Mesh& mesh) {
  std::array<int, 2> least = net.grid.size;
  std::array<int, 2> most = {-1, -1};
  for (int j = 0; j < net.grid.size[1]; ++j) {
    for (int i = 0; i < net.grid.size[0]; ++i) {
      const int n = net.node_at(i, j);
      if (n < 0) continue;
      mesh.nodes.crossing[n] = {i, j};
      least = {std::min(least[0], i), std::min(least[1], j)};
      most = {std::max(most[0], i), std::max(most[1], j)};
    }
  }
  const auto shift = [&](std::array<int, 2>& index) { index = {index[0] - least[0], index[1] - least[1]}; };
  for (auto& crossing : mesh.nodes.crossing)
    if (crossing[0] >= 0) shift(crossing);
  for (auto& lattice : mesh.cells.lattice) shift(lattice);
  mesh.lattice_size = {most[0] - least[0] + 1, most[1] - least[1] + 1};
}

// The mesh's boundary: yarn ends, and crossings where a yarn stops or passes along the outline.
NodeSet outline_set(const Mesh& mesh) {
  std::vector<int> elements(mesh.node_count(), 0);
  for (const auto& ends : mesh.yarns.node)
    for (const int n : ends) ++elements[n];
  NodeSet set{"outline", {}};
  for (int n = 0; n < mesh.node_count(); ++n)
    if (elements[n] < 4) set.node.push_back(n);
  return set;
}

void collect_sets(const YarnNet& net, const GripRegions& grips, Mesh& mesh) {
  for (std::size_t g = 0; g < grips.region.size(); ++g) {
    NodeSet set{grips.region[g].name, {}};
    for (int n = 0; n < mesh.node_count(); ++n)
      if (net.grip_of_node[n] == static_cast<int>(g)) set.node.push_back(n);
    mesh.sets.push_back(std::move(set));
  }
  mesh.sets.push_back(outline_set(mesh));
}

void check_grips_hold(const Scene& scene, const Mesh& mesh, std::vector<std::string>& complaints) {
  for (const auto& grip : scene.grip)
    for (const auto& set : mesh.sets)
      if (set.name == grip.name && set.node.empty())
        complaints.push_back(
            fmt::format("grip '{}' holds no node: nothing of the blank lies there, or an earlier grip has it all; "
                        "enlarge its box, or name an edge of the blank",
                        set.name));
}

bool is_cross(const BlankSpec& blank) {
  return blank.shape == BlankShape::cross;
}

// The edges of a cross are the ends of its arms, not the sides of its middle.
void leave_edges_to_arms(GripRegions& grips) {
  for (auto& region : grips.region) {
    region.edge.clear();
    region.end.clear();
  }
}

std::vector<Hold> holds(const YarnNet& net, const GripRegions& grips) {
  std::vector<Hold> hold;
  hold.reserve(net.grip_of_node.size());
  for (const int g : net.grip_of_node)
    hold.push_back(g < 0 ? Hold::free : (grips.region[g].rigid ? Hold::rigid : Hold::guided));
  return hold;
}

void place_in_world(const YarnNet& net, const BlankSpec& blank, Mesh& mesh) {
  const Turn yarns = turn_by_degrees(blank.yarn_angle);
  const Turn whole = turn_by_degrees(blank.orientation);
  for (const auto& place : net.place) {
    const Vec2 p = whole.forward(yarns.forward(place));
    mesh.nodes.add({blank.position[0] + p[0], blank.position[1] + p[1], blank.position[2]}, 0.0);
  }
}

Mesh build(const Scene& scene, const Card& card, const BlankOutline& read) {
  const BlankSpec& blank = scene.blank;
  const Turn yarns = turn_by_degrees(blank.yarn_angle);
  const Vec2 asked = model_spacing(blank, card);

  std::vector<std::string> complaints;
  if (scene.frame) check_frame(scene, complaints);
  if (is_cross(blank)) check_cross(scene, complaints);
  const Outline outline = yarn_outline(blank, read, yarns);
  if (!complaints.empty()) complain(scene, complaints);
  check_size(blank, outline, yarns, asked, complaints);
  // Ends on the outline are found to the net's tolerance; twice over, at the corners.
  const double tolerance = 4e-7 * std::min(asked[0], asked[1]);
  GripRegions grips = grip_regions(scene, outline, yarns, tolerance, complaints);
  if (is_cross(blank)) leave_edges_to_arms(grips);
  if (!complaints.empty()) complain(scene, complaints);

  Mesh mesh;
  const LineLayout lines = scene.frame       ? lines_on_sides(blank.size, asked)
                           : is_cross(blank) ? lines_on_sides({*blank.arm_width, *blank.arm_width}, asked)
                                             : choose_lines(blank, outline, grips, asked);
  YarnNet net = lay_lines(outline, lines.spacing, lines.phase);
  do {
    place_ends(net, grips);
    mesh.cells = cut_cells(net, outline);
  } while (prune(net, mesh.cells));
  if (mesh.cells.size() == 0) complain(scene, {"blank.coarsening: no whole cell fits into the blank; make it smaller"});

  share_strips(net, outline, {card.yarn[0].interval, card.yarn[1].interval});
  lay_yarns(net, card, mesh.yarns);
  place_in_world(net, blank, mesh);
  mesh.spacing = lines.spacing;
  mesh.thickness = card.thickness;
  index_crossings(net, mesh);
  collect_sets(net, grips, mesh);
  lump(mesh, card, real_coarsening(lines.spacing, card), holds(net, grips));
  tie_free_ends(mesh, holds(net, grips));
  if (scene.frame) attach_frame(scene, card, mesh);
  if (is_cross(blank)) attach_cross(scene, card, mesh);
  check_grips_hold(scene, mesh, complaints);
  if (!complaints.empty()) complain(scene, complaints);
  return mesh;
}

}  // namespace
}  // namespace weaveform::lattice

namespace weaveform {

Mesh build_flat_mesh(const Scene& scene, const Card& card, const BlankOutline& outline) {
  Mesh mesh = lattice::build(scene, card, outline);
  if (const std::string wrong = mesh.check(); !wrong.empty()) throw std::logic_error("the mesh as built: " + wrong);
  return mesh;
}

Mesh build_flat_mesh(const Scene& scene, const Card& card) {
  return build_flat_mesh(scene, card, read_blank_outline(scene));
}

Mesh build_mesh(const Scene& scene, const Card& card) {
  Mesh mesh = build_flat_mesh(scene, card);
  if (scene.drape) lay_drape(scene, drape_blank(scene, mesh, make_tools(scene, mesh)), mesh);
  return mesh;
}

}  // namespace weaveform
