#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "core/error.hpp"
#include "core/files/text_words.hpp"
#include "core/vector/vector.hpp"
#include "mesher/exchange/choose_fabric.hpp"
#include "mesher/exchange/foreign_sets.hpp"
#include "mesher/exchange/gathered.hpp"
#include "mesher/exchange/import.hpp"
#include "mesher/lattice/cut_cells.hpp"
#include "mesher/lattice/free_ends.hpp"
#include "mesher/lattice/lumping.hpp"

namespace weaveform {

namespace {

// Text has fewer digits than the program: places within this part of a spacing are the same.
constexpr double loose = 1e-5;
// Of a coordinate: what single precision (24 bits), as some preprocessors keep it, rounds away, twice.
constexpr double single_precision = 2.4e-7;

struct Recovery {
  const ForeignMesh& file;
  const Scene& scene;
  const Card& card;
  Mesh mesh{};
  std::vector<std::string> notes{};
  std::vector<int> ours{};     // node of the mesh by place in the file; -1: not of the fabric
  std::vector<long> theirs{};  // number in the file by node of the mesh
  std::vector<const ForeignElement*> yarn{}, cell{};
  std::vector<bool> in_warp{};  // per yarn
  bool warp_named = false;
  std::vector<Vec2> place{};  // mm; along warp and weft, per node of the mesh
  Vec2 warp = {1.0, 0.0};     // unit; in the x-y plane. The weft is 90 deg counter-clockwise from it

  [[noreturn]] void fail(const std::string& what) const { throw InputError(fmt::format("{}: {}", file.file, what)); }
  [[noreturn]] void fail(const ForeignElement& element, const std::string& what) const {
    throw InputError(fmt::format("{}: {}", file.where(element), what));
  }

  void take_elements(const std::string& part, const std::vector<std::string>& others) {
    std::vector<std::string> tools;
    for (const auto& tool : scene.tools)
      if (tool.shape == ToolShape::triangles) tools.push_back(tool.name);
    FabricElements chosen = choose_fabric(file, tools, part, others);
    yarn = std::move(chosen.yarn);
    cell = std::move(chosen.cell);
    in_warp = std::move(chosen.in_warp);
    warp_named = chosen.warp_named;
    notes.insert(notes.end(), chosen.notes.begin(), chosen.notes.end());
    ours.assign(file.position.size(), -1);
    for (const auto* list : {&yarn, &cell})
      for (const auto* element : *list)
        for (const int n : element->node) ours[n] = 0;
    int count = 0;
    for (std::size_t k = 0; k < ours.size(); ++k) {
      if (ours[k] < 0) continue;
      ours[k] = count++;
      theirs.push_back(file.number[k]);
      mesh.nodes.add(file.position[k], 0.0);
    }
  }

  Vec2 along(const ForeignElement& line) const {
    const auto& a = file.position[line.node[0]];
    const auto& b = file.position[line.node[1]];
    return {b[0] - a[0], b[1] - a[1]};
  }

  // Out of flatness that is the file's rounding is taken out; more is refused.
  void flatten() {
    double low = std::numeric_limits<double>::max(), high = -low, farthest = 0.0, length = 0.0;
    for (const auto& x : mesh.nodes.position) {
      low = std::min(low, x[2]);
      high = std::max(high, x[2]);
      for (const double c : x) farthest = std::max(farthest, std::abs(c));
    }
    for (const auto* line : yarn) {
      const auto &a = file.position[line->node[0]], &b = file.position[line->node[1]];
      length += std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) / static_cast<double>(yarn.size());
    }
    const double allowed = loose * length + single_precision * farthest;
    if (high - low > allowed)
      fail(
          fmt::format("the blank is not flat: z from {:.9g} to {:.9g} mm, {:.3g} mm apart where its yarn elements are "
                      "{:.4g} mm long and {:.2g} mm is taken for rounding; give a flat blank in a plane of constant z",
                      low, high, high - low, length, allowed));
    if (!(high > low)) return;
    const double middle = 0.5 * (low + high);
    for (auto& x : mesh.nodes.position) x[2] = std::abs(middle) <= allowed ? 0.0 : middle;
  }

  // Lines lie along two directions at right angles, so exp(4 i angle) is the same for all of them.
  void find_directions() {
    std::complex<double> quarter = 0.0, marked = 0.0;
    for (std::size_t e = 0; e < yarn.size(); ++e) {
      const ForeignElement* line = yarn[e];
      const Vec2 d = along(*line);
      const double length = std::hypot(d[0], d[1]);
      if (!(length > 0.0)) fail(*line, fmt::format("element {} has no length", line->number));
      const std::complex<double> unit = std::complex<double>(d[0], d[1]) / length;
      quarter += std::pow(unit, 4) * length;
      if (in_warp[e]) marked += std::pow(unit, 2) * length;
    }
    const double asked = (scene.blank.yarn_angle + scene.blank.orientation) * std::numbers::pi / 180.0;
    const double wanted = !warp_named ? asked : 0.5 * std::arg(marked);
    double angle = 0.25 * std::arg(quarter);
    angle += std::round((wanted - angle) / (0.5 * std::numbers::pi)) * 0.5 * std::numbers::pi;
    // which way along the warp counts as forwards is free: as the scene has it
    if (std::cos(angle - asked) < 0.0) angle += std::numbers::pi;
    warp = {std::cos(angle), std::sin(angle)};
    const double off = std::remainder(angle - asked, 2.0 * std::numbers::pi) * 180.0 / std::numbers::pi;
    if (std::abs(off) > 0.01)
      notes.push_back(fmt::format("the warp lies {:.4g} deg from the scene's yarn_angle; the mesh counts", off));
  }

  void find_places() {
    // From the first node, so that a blank far from the origin loses no digits.
    const auto o = mesh.nodes.position.front();
    for (const auto& x : mesh.nodes.position) {
      const Vec2 d = {x[0] - o[0], x[1] - o[1]};
      place.push_back({warp[0] * d[0] + warp[1] * d[1], warp[0] * d[1] - warp[1] * d[0]});
    }
  }

  void lay_yarns() {
    std::set<std::array<int, 2>> there;
    for (const auto* line : yarn) {
      int a = ours[line->node[0]], b = ours[line->node[1]];
      const Vec2 d = {place[b][0] - place[a][0], place[b][1] - place[a][1]};
      const std::size_t f = std::abs(d[0]) >= std::abs(d[1]) ? 0 : 1;
      if (std::abs(d[1 - f]) > 1e-3 * std::abs(d[f]))
        fail(*line, fmt::format("element {} lies {:.3g} deg off both yarn directions; straight yarns at right "
                                "angles are needed",
                                line->number, std::atan(std::abs(d[1 - f] / d[f])) * 180.0 / std::numbers::pi));
      if (d[f] < 0.0) std::swap(a, b);
      if (!there.insert({std::min(a, b), std::max(a, b)}).second)
        fail(*line, fmt::format("element {} lies on another line", line->number));
      // how many yarns it stands for is counted when the cells are known
      mesh.yarns.add({.node = {a, b},
                      .family = f == 0 ? Family::warp : Family::weft,
                      .rest_length = std::abs(d[f]),
                      .yarns = 0.0});
    }
  }

  // Lattice rows: crossings have elements of both families; their spacing is that between neighbours.
  void find_lattice() {
    std::vector<unsigned> met(place.size(), 0);
    for (std::size_t e = 0; e < mesh.yarns.node.size(); ++e)
      for (const int n : mesh.yarns.node[e]) met[n] |= mesh.yarns.family[e] == Family::warp ? 1U : 2U;
    std::array<std::vector<double>, 2> length;
    for (std::size_t e = 0; e < mesh.yarns.node.size(); ++e)
      if (met[mesh.yarns.node[e][0]] == 3 && met[mesh.yarns.node[e][1]] == 3)
        length[static_cast<std::size_t>(mesh.yarns.family[e])].push_back(mesh.yarns.rest_length[e]);
    for (std::size_t f = 0; f < 2; ++f) {
      if (length[f].empty()) fail("no element joins two crossings of yarns; is this a fabric?");
      auto middle = length[f].begin() + static_cast<std::ptrdiff_t>(length[f].size() / 2);
      std::nth_element(length[f].begin(), middle, length[f].end());
      mesh.spacing[f] = *middle;
    }
    int first = -1;
    Vec2 low = {0.0, 0.0};
    for (std::size_t n = 0; n < place.size(); ++n) {
      if (met[n] != 3) continue;
      for (std::size_t f = 0; f < 2; ++f) low[f] = first < 0 ? place[n][f] : std::min(low[f], place[n][f]);
      first = static_cast<int>(n);
    }
    sharpen_spacing(met, low);
    for (std::size_t n = 0; n < place.size(); ++n) {
      if (met[n] != 3) continue;
      for (std::size_t f = 0; f < 2; ++f) {
        const double at = (place[n][f] - low[f]) / mesh.spacing[f];
        const double off = std::abs(at - std::round(at));
        if (off > 100.0 * loose)
          fail(
              fmt::format("the crossing at ({:.6g}, {:.6g}) mm is {:.3g} spacings of {:.6g} mm off the even lattice; "
                          "evenly spaced yarns are needed",
                          mesh.nodes.position[n][0], mesh.nodes.position[n][1], off, mesh.spacing[f]));
        mesh.nodes.crossing[n][f] = static_cast<int>(std::lround(at));
        mesh.lattice_size[f] = std::max(mesh.lattice_size[f], mesh.nodes.crossing[n][f] + 1);
      }
    }
    refuse_unmerged(met);
    for (std::size_t e = 0; e < mesh.yarns.node.size(); ++e) {
      const auto f = static_cast<std::size_t>(mesh.yarns.family[e]);
      double& rest = mesh.yarns.rest_length[e];
      const bool whole = met[mesh.yarns.node[e][0]] == 3 && met[mesh.yarns.node[e][1]] == 3;
      if (whole && std::abs(rest - mesh.spacing[f]) < 1e-3 * mesh.spacing[f]) rest = mesh.spacing[f];
    }
    for (std::size_t n = 0; n < place.size(); ++n) place[n] = {place[n][0] - low[0], place[n][1] - low[1]};
  }

  void refuse_unmerged(const std::vector<unsigned>& met) const {
    std::map<std::array<int, 2>, std::size_t> at;
    for (std::size_t n = 0; n < place.size(); ++n) {
      if (met[n] != 3) continue;
      const auto [other, fresh] = at.emplace(mesh.nodes.crossing[n], n);
      if (!fresh)
        fail(fmt::format("nodes {} and {} lie at one crossing, ({:.6g}, {:.6g}) mm; merge coincident nodes",
                         theirs[other->second], theirs[n], mesh.nodes.position[n][0], mesh.nodes.position[n][1]));
    }
  }

  // Over the whole lattice instead of one element: rounding of the text is then shared by all.
  void sharpen_spacing(const std::vector<unsigned>& met, const Vec2& low) {
    for (std::size_t f = 0; f < 2; ++f) {
      double high = low[f];
      for (std::size_t n = 0; n < place.size(); ++n)
        if (met[n] == 3) high = std::max(high, place[n][f]);
      const double steps = std::round((high - low[f]) / mesh.spacing[f]);
      if (steps > 0.0) mesh.spacing[f] = (high - low[f]) / steps;
    }
  }

  double area_of(const std::vector<int>& node) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < node.size(); ++k) {
      const Vec2 &a = place[node[k]], &b = place[node[(k + 1) % node.size()]];
      sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    return sum;
  }

  // The four corners of a whole quad, lowest first; false when it is none.
  bool is_whole(std::vector<int>& node) const {
    if (node.size() != 4) return false;
    for (int turn = 0; turn < 4; ++turn) {
      const auto& c = mesh.nodes.crossing;
      const auto& [i, j] = c[node[0]];
      if (i >= 0 && c[node[1]] == std::array{i + 1, j} && c[node[2]] == std::array{i + 1, j + 1} &&
          c[node[3]] == std::array{i, j + 1})
        return true;
      std::rotate(node.begin(), node.begin() + 1, node.end());
    }
    return false;
  }

  // Least-squares gradient of the nodes (cut_cells.cpp); false when they scatter too little for it.
  bool fit_gradient(const std::vector<int>& node, std::vector<Vec2>& coefficient) const {
    const Vec2& h = mesh.spacing;
    Vec2 mean = {0.0, 0.0};
    coefficient.clear();
    for (const int n : node)
      coefficient.push_back({(place[n][0] - place[node[0]][0]) / h[0], (place[n][1] - place[node[0]][1]) / h[1]});
    for (const auto& d : coefficient)
      for (std::size_t f = 0; f < 2; ++f) mean[f] += d[f] / static_cast<double>(node.size());
    double s00 = 0.0, s01 = 0.0, s11 = 0.0;
    for (auto& d : coefficient) {
      d = {d[0] - mean[0], d[1] - mean[1]};
      s00 += d[0] * d[0];
      s01 += d[0] * d[1];
      s11 += d[1] * d[1];
    }
    if (0.5 * (s00 + s11) - std::hypot(0.5 * (s00 - s11), s01) < lattice::least_scatter) return false;
    const double determinant = s00 * s11 - s01 * s01;
    for (auto& d : coefficient)
      d = {(s11 * d[0] - s01 * d[1]) / (determinant * h[0]), (s00 * d[1] - s01 * d[0]) / (determinant * h[1])};
    return true;
  }

  void lay_cells() {
    MeshCells& cells = mesh.cells;
    const Vec2 half = {0.5 / mesh.spacing[0], 0.5 / mesh.spacing[1]};
    const std::vector<Vec2> whole = {
        {-half[0], -half[1]}, {half[0], -half[1]}, {half[0], half[1]}, {-half[0], half[1]}};
    std::vector<std::pair<Vec2, double>> slivers;
    for (const auto* shell : cell) {
      std::vector<int> node;
      for (const int n : shell->node) node.push_back(ours[n]);
      if (area_of(node) < 0.0) std::reverse(node.begin(), node.end());
      const double area = area_of(node);
      Vec2 centre = {0.0, 0.0};
      for (const int n : node)
        for (std::size_t f = 0; f < 2; ++f) centre[f] += place[n][f] / static_cast<double>(node.size());
      std::vector<Vec2> coefficient;
      std::array<int, 2> corner{};
      if (is_whole(node)) {
        coefficient = whole;
        corner = mesh.nodes.crossing[node[0]];
      } else {
        if (!fit_gradient(node, coefficient)) {
          slivers.push_back({centre, area});
          continue;
        }
        for (std::size_t f = 0; f < 2; ++f) {
          corner[f] = static_cast<int>(std::floor(centre[f] / mesh.spacing[f]));
          if (corner[f] < -1 || corner[f] >= mesh.lattice_size[f])
            fail(*shell, fmt::format("shell {} lies more than a spacing from the yarns' crossings", shell->number));
        }
      }
      cells.add(node, coefficient, area, corner);
    }
    if (cells.size() == 0) fail("no shell is wide enough for a cell");
    for (const auto& [centre, area] : slivers) cells.area[nearest_cell(centre)] += area;
    if (!slivers.empty())
      notes.push_back(
          fmt::format("{} shells too thin for a cell of their own; their area went to the nearest", slivers.size()));
  }

  std::size_t nearest_cell(const Vec2& p) const {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::max();
    for (int c = 0; c < mesh.cells.size(); ++c) {
      Vec2 centre = {0.0, 0.0};
      const int begin = mesh.cells.offset[c], end = mesh.cells.offset[c + 1];
      for (int k = begin; k < end; ++k)
        for (std::size_t f = 0; f < 2; ++f) centre[f] += place[mesh.cells.node[k]][f] / (end - begin);
      const double far = std::hypot(centre[0] - p[0], centre[1] - p[1]);
      if (far < least) least = far, best = static_cast<std::size_t>(c);
    }
    return best;
  }

  // Elements of one yarn, one after another, have one number.
  std::vector<int> chains() const {
    std::vector<int> chain(mesh.yarns.node.size(), -1);
    std::array<std::vector<int>, 2> starts;
    for (auto& list : starts) list.assign(place.size(), -1);
    std::vector<std::array<int, 2>> stops(place.size(), {0, 0});
    for (std::size_t e = 0; e < chain.size(); ++e) {
      const auto f = static_cast<std::size_t>(mesh.yarns.family[e]);
      int& start = starts[f][mesh.yarns.node[e][0]];
      if (start >= 0 || ++stops[mesh.yarns.node[e][1]][f] > 1)
        fail(*yarn[e], fmt::format("a yarn branches at element {}", yarn[e]->number));
      start = static_cast<int>(e);
    }
    int count = 0;
    for (std::size_t e = 0; e < chain.size(); ++e) {
      const auto f = static_cast<std::size_t>(mesh.yarns.family[e]);
      if (stops[mesh.yarns.node[e][0]][f] > 0) continue;  // not the first of its yarn
      for (int at = static_cast<int>(e); at >= 0; at = starts[f][mesh.yarns.node[at][1]]) chain[at] = count;
      ++count;
    }
    return chain;
  }

  // A yarn stands for the area beside it: of each cell, its sides of a family share the area.
  void count_yarns() {
    const std::vector<int> chain = chains();
    std::map<std::array<int, 2>, int> element_at;
    std::vector<std::array<int, 2>> any(place.size(), {-1, -1});  // an element of either family at a node
    for (std::size_t e = 0; e < chain.size(); ++e) {
      const auto& [a, b] = mesh.yarns.node[e];
      element_at[{std::min(a, b), std::max(a, b)}] = static_cast<int>(e);
      for (const int n : {a, b}) any[n][static_cast<std::size_t>(mesh.yarns.family[e])] = static_cast<int>(e);
    }
    const int chain_count = chain.empty() ? 0 : *std::max_element(chain.begin(), chain.end()) + 1;
    std::vector<double> area(chain_count, 0.0), length(chain_count, 0.0);
    for (int c = 0; c < mesh.cells.size(); ++c) {
      std::array<std::vector<int>, 2> side;
      const int begin = mesh.cells.offset[c], size = mesh.cells.offset[c + 1] - begin;
      for (int k = 0; k < size; ++k) {
        const int a = mesh.cells.node[begin + k], b = mesh.cells.node[begin + (k + 1) % size];
        const auto found = element_at.find({std::min(a, b), std::max(a, b)});
        if (found != element_at.end())
          side[static_cast<std::size_t>(mesh.yarns.family[found->second])].push_back(found->second);
      }
      for (std::size_t f = 0; f < 2; ++f) {
        for (int k = 0; k < size && side[f].empty(); ++k)
          if (const int e = any[mesh.cells.node[begin + k]][f]; e >= 0) side[f].push_back(e);
        for (const int e : side[f]) area[chain[e]] += mesh.cells.area[c] / static_cast<double>(side[f].size());
      }
    }
    for (std::size_t e = 0; e < chain.size(); ++e) length[chain[e]] += mesh.yarns.rest_length[e];
    for (std::size_t e = 0; e < chain.size(); ++e) {
      const YarnCard& of = card.yarn[static_cast<std::size_t>(mesh.yarns.family[e])];
      mesh.yarns.yarns[e] = area[chain[e]] / (of.interval * length[chain[e]]);
      mesh.yarns.section[e] = mesh.yarns.yarns[e] * of.section;
      if (!(mesh.yarns.section[e] > 0.0))
        fail(*yarn[e], fmt::format("no cell lies beside the yarn of element {}", yarn[e]->number));
    }
  }

  void check_all_held_together() const {
    std::vector<int> elements(place.size(), 0);
    for (const auto& ends : mesh.yarns.node)
      for (const int n : ends) ++elements[n];
    for (std::size_t n = 0; n < place.size(); ++n)
      if (elements[n] == 0)
        fail(fmt::format(
            "the node at ({:.6g}, {:.6g}) mm lies on no yarn; shells may only join yarns' nodes (merge coincident "
            "nodes, and give a tool's shells a set with its name)",
            mesh.nodes.position[n][0], mesh.nodes.position[n][1]));
  }

  std::vector<lattice::Hold> holds() const {
    std::vector<lattice::Hold> hold(place.size(), lattice::Hold::free);
    for (std::size_t g = 0; g < scene.grip.size(); ++g)
      for (const int n : mesh.sets[g].node)
        hold[n] = scene.grip[g].free.empty() ? lattice::Hold::rigid : lattice::Hold::guided;
    return hold;
  }
};

}  // namespace

ImportedMesh import_foreign(const ForeignMesh& file, const Scene& scene, const Card& card, const std::string& part,
                            const std::vector<std::string>& others) {
  if (scene.frame)
    throw InputError(
        fmt::format("{}: a shear frame ([frame]) is built around the blank by 'weaveform mesh' only", scene.file));
  if (scene.drape)
    throw InputError(
        fmt::format("{}: a draped start ([drape]) is made by 'weaveform mesh' only; import a flat blank", scene.file));
  Recovery work{file, scene, card};
  work.notes = file.notes;
  work.take_elements(part, others);
  work.flatten();
  work.find_directions();
  work.find_places();
  work.lay_yarns();
  work.find_lattice();
  work.lay_cells();
  work.check_all_held_together();
  work.count_yarns();
  keep_node_sets(file, scene, work.ours, work.mesh, work.notes);
  Mesh& mesh = work.mesh;
  mesh.thickness = card.thickness;
  const std::array<double, 2> coarsening = {mesh.spacing[1] / card.yarn[0].interval,
                                            mesh.spacing[0] / card.yarn[1].interval};
  lattice::lump(mesh, card, coarsening, work.holds());
  lattice::tie_free_ends(mesh, work.holds());
  if (const std::string wrong = mesh.check(); !wrong.empty()) work.fail("the recovered mesh is not sound: " + wrong);
  work.notes.push_back(fmt::format(
      "recovered: {} cells, {} yarn elements, spacing {:.6g} and {:.6g} mm, coarsening "
      "{:.4g} (warp) and {:.4g} (weft); masses, jaws and soft ends are ours",
      mesh.cells.size(), mesh.yarn_count(), mesh.spacing[0], mesh.spacing[1], coarsening[0], coarsening[1]));
  return {std::move(mesh), "", std::move(work.notes)};
}

}  // namespace weaveform
