#include "solver/contact/ply_pass.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weaveform {
namespace {

constexpr double cell_border = 1e-3;  // of a cell: a foot goes on to the next one when it is so far out
constexpr double ply_border = 0.05;   // of a cell: a foot is off the ply when it is so far out
constexpr double safe_part = 0.5;     // of a measured clearance: distances along normals are not quite the least ones
constexpr double nothing = -std::numeric_limits<double>::infinity();

int nodes_of_block(int block) {
  return block * ply_nodes_at_a_time;
}

}  // namespace

PlyPassState::PlyPassState(const PlyFace& own, PlyFace& other, const PlyPassLaw& law, double frequency)
    : own_(own),
      other_(other),
      law_(law),
      frequency_(frequency),
      touch_(law.adhesion),
      far_(own.blocks(), nothing),
      clear_(own.blocks(), 0),
      measured_(own.blocks(), 0),
      off_(own.blocks(), 0),
      sums_(own.blocks()) {}

void PlyPassState::wake() {
  const auto count = static_cast<std::size_t>(own_.nodes());
  facet_.assign(count, -1);
  origin_facet_.assign(count, -1);
  for (auto& corner : corner_) corner.assign(count, own_.nodes() > 0 ? 0 : -1);
  for (auto* numbers : {&stiffness_, &place_[0], &place_[1], &anchor_[0], &anchor_[1], &depth_, &drag_[0], &drag_[1],
                        &drag_[2], &path_, &normal_, &tangential_, &origin_[0], &origin_[1]})
    numbers->assign(count, 0.0);
}

void PlyPassState::forget() {
  facet_ = origin_facet_ = {};
  corner_ = {};
  for (auto* numbers : {&stiffness_, &place_[0], &place_[1], &anchor_[0], &anchor_[1], &depth_, &drag_[0], &drag_[1],
                        &drag_[2], &path_, &normal_, &tangential_, &origin_[0], &origin_[1]})
    *numbers = {};
}

// The depth at a foot, |r| counted as in ply_kernel.hpp.
double PlyPassState::depth_at(int node, const SurfacePlace& place, const Vec3& normal) const {
  const Vec3 r = minus(own_.position(node), other_.surface().point(place, other_.state().position));
  const double distance = length(r);
  return law_.reach - (law_.side * dot(r, normal) >= 0.0 ? distance : -distance);
}

// From one node to the next the foot moves by about a cell, so that only the first of all is looked for everywhere.
double PlyPassState::search(std::vector<double>* depths) {
  wake();
  if (depths != nullptr) depths->assign(own_.nodes(), nothing);
  const PlySurface& surface = other_.surface();
  const auto& position = other_.state().position;
  double least_gap = std::numeric_limits<double>::infinity();
  SurfacePlace before;
  const int stride = own_.ply().packed().stride;
  for (int n = 0; n < own_.nodes(); ++n) {
    if (own_.mass()[n] == 0.0) continue;
    SurfacePlace place = before;
    if (n >= stride && facet_[n - stride] >= 0) place = place_of(n - stride);
    if (place.facet < 0) place = surface.nearest_middle(own_.position(n), position);
    if (place.facet < 0) break;  // a surface without cells
    const Vec3 normal = own_.normal(n);
    if (!surface.follow(place, own_.position(n), normal, position)) {
      place = surface.nearest_middle(own_.position(n), position);
      if (!surface.follow(place, own_.position(n), normal, position)) continue;
    }
    before = place;
    facet_[n] = place.facet;
    place_[0][n] = place.xi;
    place_[1][n] = place.eta;
    if (surface.outside(place) > cell_border) continue;
    const double depth = depth_at(n, place, normal);
    turn_on(n, place, depth);
    least_gap = std::min(least_gap, touch_ - depth);
    if (depths != nullptr) (*depths)[n] = depth;
  }
  for (int b = 0; b < own_.blocks(); ++b) {
    off_[b] = 0;
    for (int n = nodes_of_block(b); n < nodes_of_block(b) + own_.block_size(b); ++n)
      if (own_.mass()[n] > 0.0 && stiffness_[n] == 0.0) ++off_[b];
    double deepest = nothing;
    for (int n = nodes_of_block(b); n < nodes_of_block(b) + own_.block_size(b); ++n)
      if (stiffness_[n] > 0.0) deepest = std::max(deepest, depth_[n]);
    least_gap = std::min(least_gap, clearance(b, deepest));
  }
  return least_gap;
}

void PlyPassState::set_corners(int node) {
  const auto corners = stiffness_[node] > 0.0 ? other_.surface().corners(facet_[node]) : std::array<int, 4>{0, 0, 0, 0};
  for (std::size_t a = 0; a < 4; ++a) corner_[a][node] = corners[a];
}

void PlyPassState::turn_on(int node, const SurfacePlace& place, double depth) {
  facet_[node] = place.facet;
  place_[0][node] = anchor_[0][node] = place.xi;
  place_[1][node] = anchor_[1][node] = place.eta;
  depth_[node] = depth;
  for (auto& drag : drag_) drag[node] = 0.0;
  stiffness_[node] =
      node_stiffness(own_.touching(), other_.touching(), frequency_, own_.mass()[node], own_.area()[node]);
  set_corners(node);
  if (origin_facet_[node] >= 0) return;
  origin_facet_[node] = place.facet;
  origin_[0][node] = place.xi;
  origin_[1][node] = place.eta;
}

void PlyPassState::turn_off(int node) {
  stiffness_[node] = normal_[node] = tangential_[node] = 0.0;
  for (auto& drag : drag_) drag[node] = 0.0;
  set_corners(node);
}

void PlyPassState::look(int block, const BlockNormals& normals, double inverse_time, bool look_for_lost,
                        PlyReturn& back) {
  const int first = nodes_of_block(block), count = own_.block_size(block);
  const bool was_clear = clear_[block] != 0;
  if (was_clear) find_again(block);
  if (look_for_lost && off_[block] > 0) find_lost(block);
  alignas(64) double force[3][ply_nodes_at_a_time], on_corners[4][3][ply_nodes_at_a_time];
  PlyPassNodes nodes{};
  nodes.count = count;
  nodes.stiffness = stiffness_.data() + first;
  nodes.area = own_.area().data() + first;
  nodes.depth = depth_.data() + first;
  nodes.path = path_.data() + first;
  nodes.normal_force = normal_.data() + first;
  nodes.tangential_force = tangential_.data() + first;
  for (int k = 0; k < 2; ++k) {
    nodes.place[k] = place_[k].data() + first;
    nodes.anchor[k] = anchor_[k].data() + first;
  }
  for (int c = 0; c < 3; ++c) {
    nodes.x[c] = own_.state().position[c].data() + first;
    nodes.normal[c] = normals.n[c];
    nodes.surface[c] = other_.state().position[c].data();
    nodes.drag[c] = drag_[c].data() + first;
    nodes.force[c] = force[c];
  }
  for (int a = 0; a < 4; ++a) {
    nodes.corner[a] = corner_[a].data() + first;
    for (int c = 0; c < 3; ++c) nodes.back[a][c] = on_corners[a][c];
  }
  const bool with_tables = law_.shear.intervals > 0 || law_.pressure.intervals > 0;
  const PlyLoops& loops = loops_of_plies();
  PlyPassSums& sums = sums_[block];
  sums = (with_tables ? loops.tables : loops.springs)(law_, was_clear ? 0.0 : inverse_time, nodes);
  measured_[block] = sums.depth > touch_ ? 1 : 0;
  if (measured_[block] != 0) {
    for (int c = 0; c < 3; ++c) {
      double* into = own_.state().force[c].data() + first;
      for (int i = 0; i < count; ++i) into[i] += force[c][i];
    }
    give_back(block, on_corners, back);
  }
  if (sums.outside > cell_border) move_feet(block);
  const double room = measured_[block] != 0 ? 0.0 : clearance(block, sums.depth);
  clear_[block] = room > 0.0 ? 1 : 0;
  far_[block] = room > 0.0 ? own_.way + other_.way + room : nothing;
}

void PlyPassState::give_back(int block, const double (&back)[4][3][ply_nodes_at_a_time], PlyReturn& into) const {
  if (into.force[0].empty())
    for (auto& component : into.force) component.assign(other_.nodes(), 0.0);
  const int first = nodes_of_block(block), count = own_.block_size(block);
  double *fx = into.force[0].data(), *fy = into.force[1].data(), *fz = into.force[2].data();
  int begin = into.begin < into.end ? into.begin : std::numeric_limits<int>::max(), end = into.end;
  for (int i = 0; i < count; ++i) {
    if (normal_[first + i] == 0.0 && tangential_[first + i] == 0.0) continue;
    for (int a = 0; a < 4; ++a) {
      const int node = corner_[a][first + i];
      fx[node] += back[a][0][i];
      fy[node] += back[a][1][i];
      fz[node] += back[a][2][i];
      begin = std::min(begin, node);
      end = std::max(end, node + 1);
    }
  }
  into.begin = begin;
  into.end = end;
}

// To the next cell, or off the ply.
void PlyPassState::move_feet(int block) {
  const PlySurface& surface = other_.surface();
  for (int n = nodes_of_block(block); n < nodes_of_block(block) + own_.block_size(block); ++n) {
    if (stiffness_[n] == 0.0) continue;
    const SurfacePlace now = place_of(n);
    if (surface.outside(now) <= cell_border) continue;
    const SurfacePlace next = surface.find(surface.material(now));
    if (next.facet < 0) {
      if (surface.outside(now) <= ply_border) continue;
      turn_off(n);
      ++off_[block];
      continue;
    }
    const Vec2 stretch = surface.carried_over({now.xi - anchor_[0][n], now.eta - anchor_[1][n]}, now.facet, next.facet);
    const Vec2 drag = surface.carried_over({drag_[1][n], drag_[2][n]}, now.facet, next.facet);
    facet_[n] = next.facet;
    place_[0][n] = next.xi;
    place_[1][n] = next.eta;
    anchor_[0][n] = next.xi - stretch[0];
    anchor_[1][n] = next.eta - stretch[1];
    drag_[1][n] = drag[0];
    drag_[2][n] = drag[1];
    set_corners(n);
  }
}

// After steps without a look feet may be anywhere; nothing is stretched where nothing touched.
void PlyPassState::find_again(int block) {
  const PlySurface& surface = other_.surface();
  for (int n = nodes_of_block(block); n < nodes_of_block(block) + own_.block_size(block); ++n) {
    if (own_.mass()[n] == 0.0 || facet_[n] < 0) continue;
    const bool was_on = stiffness_[n] > 0.0;
    SurfacePlace place = place_of(n);
    const Vec3 normal = own_.normal(n);
    const bool meets = surface.follow(place, own_.position(n), normal, other_.state().position);
    if (meets && surface.outside(place) <= (was_on ? ply_border : 0.0)) {
      turn_on(n, place, depth_at(n, place, normal));
      if (!was_on) --off_[block];
      continue;
    }
    if (meets) {
      facet_[n] = place.facet;
      place_[0][n] = place.xi;
      place_[1][n] = place.eta;
    }
    if (!was_on) continue;
    turn_off(n);
    ++off_[block];
  }
}

// Feet that are off, from where they left or from where a neighbour's is.
void PlyPassState::find_lost(int block) {
  const PlySurface& surface = other_.surface();
  for (int n = nodes_of_block(block); n < nodes_of_block(block) + own_.block_size(block); ++n) {
    if (own_.mass()[n] == 0.0 || stiffness_[n] > 0.0) continue;
    SurfacePlace place = place_of(n);
    for (const int beside : own_.arms()[n].arm)
      if (place.facet < 0) place = place_of(beside);
    if (place.facet < 0) continue;
    const Vec3 normal = own_.normal(n);
    if (!surface.follow(place, own_.position(n), normal, other_.state().position)) continue;
    facet_[n] = place.facet;
    place_[0][n] = place.xi;
    place_[1][n] = place.eta;
    if (surface.outside(place) > 0.0) continue;
    turn_on(n, place, depth_at(n, place, normal));
    --off_[block];
  }
}

// mm; how far a block is from touching, of nodes beside the ply how far they are from its edge.
double PlyPassState::clearance(int block, double depth) const {
  double room = depth > nothing ? safe_part * (touch_ - depth) : std::numeric_limits<double>::max();
  if (off_[block] == 0 || room <= 0.0) return std::max(room, 0.0);
  for (int n = nodes_of_block(block); n < nodes_of_block(block) + own_.block_size(block) && room > 0.0; ++n) {
    if (own_.mass()[n] == 0.0 || stiffness_[n] > 0.0 || facet_[n] < 0) continue;
    const Vec2 now = other_.surface().material(place_of(n));
    SurfacePlace held = place_of(n);
    held.xi = std::clamp(held.xi, 0.0, 1.0);
    held.eta = std::clamp(held.eta, 0.0, other_.surface().is_triangle(held.facet) ? 1.0 - held.xi : 1.0);
    const Vec2 edge = other_.surface().material(held);
    room = std::min(
        room, safe_part * other_.touching().spacing * std::max(std::abs(now[0] - edge[0]), std::abs(now[1] - edge[1])));
  }
  return std::max(room, 0.0);
}

PlyPassSums PlyPassState::sums() const {
  PlyPassSums all;
  for (std::size_t b = 0; b < sums_.size(); ++b) {
    if (measured_[b] == 0) continue;
    const PlyPassSums& one = sums_[b];
    all.area += one.area;
    all.normal += one.normal;
    all.friction += one.friction;
    all.energy += one.energy;
    all.friction_work += one.friction_work;
    all.damping_work += one.damping_work;
    all.depth = std::max(all.depth, one.depth);
    all.pressure = std::max(all.pressure, one.pressure);
  }
  return all;
}

bool PlyPassState::any_clear() const {
  return std::find(clear_.begin(), clear_.end(), char{1}) != clear_.end();
}

int PlyPassState::deepest() const {
  int node = -1;
  for (int n = 0; n < own_.nodes(); ++n)
    if (stiffness_[n] > 0.0 && (node < 0 || depth_[n] > depth_[node])) node = n;
  return node;
}

// A spring between a node and the corners of its foot's cell, K (t - sum v_a t_a)^2 / 2: |K_ij| = K |v_i| |v_j|.
// Across the surface v_a = N_a; along it the corners also turn the cell, v_a = N_a + |r| |grad N_a|. Dampers shorten the
// step like stiffness (contact.cpp).
void PlyPassState::add_stiffness_bound(double fabric_frequency, double stiffest, Doubles& own_bound,
                                       Doubles& other_bound) const {
  const double fastest = std::hypot(fabric_frequency, frequency_);
  const auto& position = other_.state().position;
  for (int n = 0; n < own_.nodes(); ++n) {
    if (stiffness_[n] == 0.0) continue;
    const double damper = law_.damping_time * stiffness_[n] * fastest;
    const double across = std::max(stiffness_[n], law_.share * own_.area()[n] * stiffest) + damper;
    const double along = law_.tangential * (stiffness_[n] + damper);
    const SurfacePlace place = place_of(n);
    const auto node = other_.surface().corners(place.facet);
    const bool triangle = other_.surface().is_triangle(place.facet);
    const double twist = triangle ? 0.0 : 1.0;
    Vec3 s1, s2;
    for (std::size_t c = 0; c < 3; ++c) {
      const double e3 =
          twist * (position[c][node[3]] - position[c][node[1]] - position[c][node[2]] + position[c][node[0]]);
      s1[c] = position[c][node[1]] - position[c][node[0]] + place.eta * e3;
      s2[c] = position[c][node[2]] - position[c][node[0]] + place.xi * e3;
    }
    const double area = length(cross(s1, s2)), height1 = area / length(s2), height2 = area / length(s1);
    const double n3 = twist * place.xi * place.eta;
    const double weight[4] = {1.0 - place.xi - place.eta + n3, place.xi - n3, place.eta - n3, n3};
    const double by_xi[4] = {twist * place.eta - 1.0, 1.0 - twist * place.eta, -twist * place.eta, twist * place.eta};
    const double by_eta[4] = {twist * place.xi - 1.0, -twist * place.xi, 1.0 - twist * place.xi, twist * place.xi};
    double plain[4], turning[4], plain_sum = 1.0, turning_sum = 1.0;
    for (int a = 0; a < 4; ++a) {
      plain[a] = std::abs(weight[a]);
      turning[a] = plain[a] + law_.reach * (std::abs(by_xi[a]) / height1 + std::abs(by_eta[a]) / height2);
      plain_sum += plain[a];
      turning_sum += turning[a];
    }
    own_bound[n] += std::max(across * plain_sum, along * turning_sum);
    for (int a = 0; a < (triangle ? 3 : 4); ++a)
      other_bound[node[a]] += std::max(across * plain[a] * plain_sum, along * turning[a] * turning_sum);
  }
}

// The place where the node is now, from that of the material it lay on at first.
Vec3 PlyPassState::slip(int node) const {
  if (stiffness_[node] == 0.0 || origin_facet_[node] < 0) return {0.0, 0.0, 0.0};
  const auto& position = other_.state().position;
  return minus(other_.surface().point(place_of(node), position),
               other_.surface().point({origin_facet_[node], origin_[0][node], origin_[1][node]}, position));
}

PlyPassState::Press PlyPassState::press(int node) const {
  const int block = node / ply_nodes_at_a_time;
  Press press;
  if (stiffness_[node] == 0.0 || measured_[block] == 0) return press;
  press.normal = normal_[node];
  press.tangential = tangential_[node];
  const double area = law_.share * own_.area()[node];
  press.pressure = area > 0.0 ? press.normal / area : 0.0;
  if (!(press.normal > 0.0) && !(press.tangential > 0.0)) return press;
  constexpr double at_the_limit = 1.0 - 1e-6;
  double limit = law_.friction * press.normal;
  if (law_.shear.intervals > 0 && depth_[node] > law_.adhesion) {
    const double along = std::min(path_[node] * law_.shear.per_unit, static_cast<double>(law_.shear.intervals));
    const int left = std::min(static_cast<int>(along), law_.shear.intervals - 1);
    limit += area * (law_.shear.value[left] + (along - left) * (law_.shear.value[left + 1] - law_.shear.value[left]));
  }
  press.friction = press.tangential >= at_the_limit * limit ? FrictionState::slip : FrictionState::stick;
  return press;
}

void PlyPassState::archive(Archive& archive) {
  const int facets = other_.surface().facets();
  archive.indices("a foot's cell", facet_, -1, facets - 1);
  archive.indices("a first foot's cell", origin_facet_, -1, facets - 1);
  archive.numbers("a spring between plies", stiffness_, not_negative);
  for (auto* places : {&place_, &anchor_, &origin_})
    for (auto& numbers : *places) archive.numbers("a foot", numbers);
  archive.numbers("a depth between plies", depth_);
  for (auto& drag : drag_) archive.numbers("a drag between plies", drag);
  archive.numbers("a slip path", path_, not_negative);
  archive.numbers("a force between plies", normal_, not_negative);
  archive.numbers("a force between plies", tangential_, not_negative);
  archive.numbers("a clearance between plies", far_, infinite_too);
  archive.indices("a block's nodes beside the ply", off_, 0, ply_nodes_at_a_time);
  std::vector<int> flags(2 * clear_.size());
  for (std::size_t b = 0; b < clear_.size(); ++b) flags[2 * b] = clear_[b], flags[2 * b + 1] = measured_[b];
  archive.indices("whether a block is clear", flags, 0, 1);
  for (std::size_t b = 0; b < clear_.size(); ++b) {
    clear_[b] = static_cast<char>(flags[2 * b]);
    measured_[b] = static_cast<char>(flags[2 * b + 1]);
  }
  for (int n = 0; n < own_.nodes(); ++n) {
    if (stiffness_[n] > 0.0 && facet_[n] < 0) throw DamagedState{"a spring between plies without a foot"};
    if (facet_[n] >= 0 && !other_.surface().exists(facet_[n])) throw DamagedState{"a foot where there is no cell"};
    set_corners(n);
  }
}

}  // namespace weaveform
