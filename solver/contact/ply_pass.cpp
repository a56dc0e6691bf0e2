#include "solver/contact/ply_pass.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weaveform {
namespace {

constexpr int tidy_every = 8, look_for_lost_every = 16;  // steps; for feet that have left the ply, and may come back
constexpr double worth_clearing = 20.0;  // steps; feet of a clear block are searched again, which costs as much
constexpr double safe_part = 0.5;  // of a measured clearance: distances along normals are not quite the least ones

void add_sums(const PlyPassSums& one, PlyPassSums& all) {
  all.area += one.area;
  all.normal += one.normal;
  all.friction += one.friction;
  all.energy += one.energy;
  all.friction_work += one.friction_work;
  all.damping_work += one.damping_work;
  all.depth = std::max(all.depth, one.depth);
  all.pressure = std::max(all.pressure, one.pressure);
}

double table_value(const EvenTable& table, double x) {
  const double along = x * table.per_unit, inside = std::min(along, static_cast<double>(table.intervals));
  const int left = std::min(static_cast<int>(inside), table.intervals - 1);
  const double low = table.value[left], high = table.value[left + 1];
  return low + (high - low) * (inside - left) + table.last_slope * (along - inside);
}

}  // namespace

PlyPassState::PlyPassState(PlyFace& own, const PlyFace& other, const PlyPassLaw& law, double frequency, bool swollen)
    : own_(own),
      other_(other),
      law_(law),
      frequency_(frequency),
      swollen_(swollen),
      touch_(law.adhesion),
      far_(own.blocks().size(), no_depth),
      clear_(own.blocks().size(), 0),
      measured_(own.blocks().size(), 0),
      off_(own.blocks().size(), 0),
      triangles_(own.blocks().size(), 0),
      sums_(own.blocks().size()) {}

std::vector<Doubles*> PlyPassState::numbers() {
  return {&stiffness_, &on_quads_, &anchor_[0], &anchor_[1], &origin_[0], &origin_[1], &depth_, &path_};
}

void PlyPassState::wake() {
  const auto count = static_cast<std::size_t>(own_.lanes());
  facet_.resize(count, -1);
  for (auto& list : place_) list.resize(count, 0.0);
  origin_facet_.assign(count, -1);
  corner_.assign(count, 0);
  first_corner_.assign(count, 0);
  for (auto* list : numbers()) list->assign(count, 0.0);
  for (auto& list : drag_) list.assign(count, 0.0);
}

void PlyPassState::forget() {
  origin_facet_ = {};
  corner_ = first_corner_ = {};
  for (auto* list : numbers()) *list = {};
  for (auto& list : drag_) list = {};
}

// mm; |r| at which the two touch.
double PlyPassState::reach_at(int lane, const SurfacePlace& place) const {
  if (!swollen_) return law_.reach;
  const auto node = other_.surface().corners(place.facet);
  const double n3 = other_.surface().is_triangle(place.facet) ? 0.0 : place.xi * place.eta;
  const double weight[4] = {1.0 - place.xi - place.eta + n3, place.xi - n3, place.eta - n3, n3};
  double other = 0.0;
  for (std::size_t a = 0; a < 4; ++a) other += weight[a] * other_.swell()[node[a]];
  return law_.reach + law_.half_own * (own_.swell()[own_.node_of(lane)] - 1.0) + law_.half_other * (other - 1.0);
}

// The depth at a foot, |r| counted as in ply_kernel.hpp.
double PlyPassState::depth_at(int lane, const SurfacePlace& place, const Vec3& normal) const {
  const Vec3 r = minus(own_.position(own_.node_of(lane)), frame_at(place).point);
  const double distance = length(r);
  return reach_at(lane, place) - (law_.side * dot(r, normal) >= 0.0 ? distance : -distance);
}

void PlyPassState::count_off(int number) {
  const PlyBlock& block = own_.blocks()[number];
  off_[number] = triangles_[number] = 0;
  for (int l = block.at; l < block.at + block.count; ++l) {
    if (stiffness_[l] == 0.0)
      ++off_[number];
    else if (other_.surface().is_triangle(facet_[l]))
      ++triangles_[number];
  }
}

void PlyPassState::put(int lane, const SurfacePlace& place) {
  facet_[lane] = place.facet;
  place_[0][lane] = place.xi;
  place_[1][lane] = place.eta;
}

void PlyPassState::set_corner(int lane) {
  const bool on_quad = stiffness_[lane] > 0.0 && !other_.surface().is_triangle(facet_[lane]);
  on_quads_[lane] = on_quad ? stiffness_[lane] : 0.0;
  first_corner_[lane] = stiffness_[lane] > 0.0 ? other_.surface().corners(facet_[lane])[0] : 0;
  corner_[lane] = on_quad ? first_corner_[lane] : 0;
}

void PlyPassState::turn_on(int lane, const SurfacePlace& place, double depth) {
  put(lane, place);
  anchor_[0][lane] = place.xi;
  anchor_[1][lane] = place.eta;
  depth_[lane] = depth;
  for (auto& drag : drag_) drag[lane] = 0.0;
  stiffness_[lane] =
      node_stiffness(own_.touching(), other_.touching(), frequency_, own_.mass()[lane], own_.area()[lane]);
  set_corner(lane);
  if (origin_facet_[lane] >= 0) return;
  origin_facet_[lane] = place.facet;
  origin_[0][lane] = place.xi;
  origin_[1][lane] = place.eta;
}

void PlyPassState::turn_off(int lane) {
  stiffness_[lane] = 0.0;
  for (auto& drag : drag_) drag[lane] = 0.0;
  set_corner(lane);
}

PlyPassNodes PlyPassState::nodes_of(int number, const BlockFrame& frame) {
  const PlyBlock& block = own_.blocks()[number];
  const int stride = other_.ply().packed().stride;
  PlyPassNodes nodes{};
  nodes.count = block.lanes;
  nodes.normals = &frame.normals;
  nodes.stiffness = on_quads_.data() + block.at;
  nodes.area = own_.area().data() + block.at;
  nodes.corner = corner_.data() + block.at;
  nodes.beside[0] = 1;
  nodes.beside[1] = stride;
  nodes.beside[2] = stride + 1;
  nodes.depth = depth_.data() + block.at;
  nodes.path = path_.data() + block.at;
  for (int k = 0; k < 2; ++k) {
    nodes.place[k] = place_[k].data() + block.at;
    nodes.anchor[k] = anchor_[k].data() + block.at;
  }
  nodes.swell = swollen_ ? own_.swell().data() + block.first : nullptr;
  nodes.surface_swell = swollen_ ? other_.swell().data() : nullptr;
  for (int c = 0; c < 3; ++c) {
    nodes.x[c] = frame.x[c];
    nodes.surface[c] = other_.state().position[c].data();
    nodes.drag[c] = drag_[c].data() + block.at;
  }
  return nodes;
}

bool PlyPassState::look(int number, const BlockFrame& frame, double inverse_time, PlyPull& pull, PlyReturn& back) {
  const PlyBlock& block = own_.blocks()[number];
  const bool was_clear = clear_[number] != 0;
  if (was_clear) find_again(number);
  const bool tidies = (own_.state().step + number) % tidy_every == 0;
  if (off_[number] > 0 && (own_.state().step + number) % look_for_lost_every == 0) find_lost(number);
  const PlyLoops& loops = loops_of_plies();
  const PlyPassNodes nodes = nodes_of(number, frame);
  PlyFeet feet;
  double outside = loops.feet(nodes, feet, 0, block.lanes);
  if (triangles_[number] > 0)
    for (int i = 0; i < block.count; ++i)
      if (is_on_triangle(block.at + i)) outside = std::max(outside, find_one(number, nodes, feet, i));
  if (outside > cell_border) move_feet(number, nodes, feet, tidies);
  RoundedFeet rounded;
  rounded.count = 0;
  if (other_.edges().any()) round_edges(number, nodes, feet, rounded);
  measured_[number] = 0;
  sums_[number] = {};
  press(number, nodes, feet, rounded, was_clear ? 0.0 : inverse_time, pull, back);
  double room = 0.0;
  if (measured_[number] == 0) {
    const double way = inverse_time > 0.0 ? own_.speed(number) / inverse_time : 0.0;  // and the other ply's
    room = clearance(number, sums_[number].depth, worth_clearing * 2.0 * way);
  }
  clear_[number] = room > 0.0 ? 1 : 0;
  far_[number] = room > 0.0 ? own_.way + other_.way + room : no_depth;
  return measured_[number] != 0;
}

bool PlyPassState::is_on_triangle(int lane) const {
  return stiffness_[lane] > 0.0 && other_.surface().is_triangle(facet_[lane]);
}

// The kernel's nodes as they are for one of them, on whatever facet.
PlyPassNodes PlyPassState::alone(int number, const PlyPassNodes& nodes, int i) const {
  PlyPassNodes one = nodes;
  const int lane = own_.blocks()[number].at + i;
  const auto corner = other_.surface().corners(facet_[lane]);
  one.stiffness = stiffness_.data() + own_.blocks()[number].at;
  one.corner = first_corner_.data() + own_.blocks()[number].at;
  for (int a = 0; a < 3; ++a) one.beside[a] = corner[a + 1] - corner[0];
  return one;
}

double PlyPassState::find_one(int number, const PlyPassNodes& nodes, PlyFeet& feet, int i) {
  return loops_of_plies().feet(alone(number, nodes, i), feet, i, i + 1);
}

// Quads all at once, triangles one by one.
void PlyPassState::press(int number, const PlyPassNodes& nodes, PlyFeet& feet, const RoundedFeet& rounded,
                         double inverse_time, PlyPull& pull, PlyReturn& back) {
  const PlyBlock& block = own_.blocks()[number];
  const PlyLawKind kind = {
      .sheared = law_.shear.intervals > 0, .measured = law_.pressure.intervals > 0, .swollen = swollen_};
  const PlyLoops& loops = loops_of_plies();
  const auto& press = loops.press[kind.number()];
  const auto& share = swollen_ ? loops.share_swollen : loops.share;
  PlyPassForces forces;
  const auto press_some = [&](const PlyPassNodes& some, int first, int end, const RoundedFeet* on_edges) {
    const PlyPassSums sums = press(law_, inverse_time, some, feet, forces, first, end);
    add_sums(sums, sums_[number]);
    if (!(sums.depth > touch_)) return;
    measured_[number] = 1;
    share(law_, some, feet, pull, forces, first, end);
    make_room(back);
    if (on_edges != nullptr) give_back_rounded(*on_edges, some, forces, back);
    loops.give_back(first, std::min(end, block.count), some.corner, some.beside, forces, back.force.data(),
                    back.touched.data());
  };
  press_some(nodes, 0, block.lanes, &rounded);
  if (triangles_[number] == 0) return;
  for (int i = 0; i < block.count; ++i)
    if (is_on_triangle(block.at + i)) press_some(alone(number, nodes, i), i, i + 1, nullptr);
}

void PlyPassState::make_room(PlyReturn& back) const {
  if (!back.force.empty()) return;
  back.force.assign(4 * static_cast<std::size_t>(other_.nodes()), 0.0);
  back.touched.assign(static_cast<std::size_t>(other_.nodes()) / ply_segment + 1, 0);
}

// mm; how far a block is from touching, of nodes beside the ply how far they are from its edge, along the ply or over it;
// 0 where that is no more than `least`.
double PlyPassState::clearance(int number, double depth, double least) const {
  double room = depth > no_depth ? safe_part * (touch_ - depth) : std::numeric_limits<double>::max();
  if (off_[number] == 0 || room <= least) return room > least ? room : 0.0;
  const PlyBlock& block = own_.blocks()[number];
  for (int l = block.at; l < block.at + block.count && room > least; ++l) {
    if (stiffness_[l] > 0.0 || facet_[l] < 0) continue;
    const SurfacePlace place = place_of(l), edge = other_.surface().held_inside(place);
    if (other_.surface().outside(place) <= cell_border) return 0.0;  // in a fold
    const double beside = other_.touching().spacing * other_.surface().away(place),
                 over = plain_length(minus(own_.position(own_.node_of(l)),
                                           other_.surface().frame(edge, other_.state().position).point)) -
                        reach_at(l, edge) + touch_;
    room = std::min(room, safe_part * std::max(beside, over));
  }
  return room > least ? room : 0.0;
}

PlyPassSums PlyPassState::sums() const {
  PlyPassSums all;
  for (std::size_t b = 0; b < sums_.size(); ++b)
    if (measured_[b] != 0) add_sums(sums_[b], all);
  return all;
}

bool PlyPassState::any_clear() const {
  return std::find(clear_.begin(), clear_.end(), char{1}) != clear_.end();
}

int PlyPassState::deepest() const {
  int lane = -1;
  for (int l = 0; l < own_.lanes(); ++l)
    if (stiffness_[l] > 0.0 && depth_[l] < 2.0 * reach_at(l, place_of(l)) && (lane < 0 || depth_[l] > depth_[lane]))
      lane = l;
  return lane < 0 ? -1 : own_.node_of(lane);
}

SurfaceFrame PlyPassState::frame_at(const SurfacePlace& place) const {
  return other_.edges().frame(place, other_.state().position);
}

// A spring between a node and the corners of its foot's cell, K (t - sum v_a t_a)^2 / 2: |K_ij| = K |v_i| |v_j|, with
// v = N_a at the corners. Along the surface the node's neighbours turn its normal, too: v = |r| over the way between
// them. Where plies thicken, v has those of w as well. Dampers shorten the step like stiffness (contact.cpp).
void PlyPassState::add_stiffness_bound(double fabric_frequency, double stiffest, Doubles& own_bound,
                                       Doubles& other_bound) const {
  const double fastest = std::hypot(fabric_frequency, frequency_);
  for (int l = 0; l < own_.lanes(); ++l) {
    if (stiffness_[l] == 0.0) continue;
    const double damper = law_.damping_time * stiffness_[l] * fastest;
    const double across = std::max(stiffness_[l], law_.share * own_.area()[l] * stiffest) + damper;
    const double along = law_.tangential * (stiffness_[l] + damper);
    const SurfacePlace place = place_of(l);
    const auto corner = other_.surface().corners(place.facet);
    const bool triangle = other_.surface().is_triangle(place.facet);
    const double n3 = triangle ? 0.0 : place.xi * place.eta;
    const double weight[4] = {std::abs(1.0 - place.xi - place.eta + n3), std::abs(place.xi - n3),
                              std::abs(place.eta - n3), std::abs(n3)};
    const auto [a, b] = own_.between_neighbours(own_.node_of(l));
    const double turned = length(cross(a, b));
    const double reach = reach_at(l, place);
    const double lever[2] = {reach * length(b) / turned, reach * length(a) / turned};
    double plain_sum = 1.0 + weight[0] + weight[1] + weight[2] + weight[3];
    if (swollen_) plain_sum += thickness_sum(l, corner, weight);
    const double turning_sum = plain_sum + 2.0 * (lever[0] + lever[1]);
    const double one = std::max(across * plain_sum, along * turning_sum);
    own_bound[own_.node_of(l)] += one;
    for (std::size_t k = 0; k < 4; ++k) {
      own_bound[own_.arms(own_.node_of(l)).arm[k]] += along * lever[k / 2] * turning_sum;
      other_bound[corner[k]] += weight[k] * one;
    }
    if (!swollen_) continue;
    if (own_.thickens())
      own_.sheared()->spread(own_.node_of(l), own_.state().position, law_.half_own, across * plain_sum, own_bound);
    if (other_.thickens())
      for (std::size_t k = 0; k < 4; ++k)
        other_.sheared()->spread(corner[k], other_.state().position, law_.half_other * weight[k], across * plain_sum,
                                 other_bound);
  }
}

// What the ends of a and b have in a node's spring through the thickness of both plies.
double PlyPassState::thickness_sum(int lane, const std::array<int, 4>& corner, const double (&weight)[4]) const {
  double sum = 0.0;
  if (own_.thickens()) sum += law_.half_own * own_.sheared()->lever(own_.node_of(lane), own_.state().position);
  if (other_.thickens())
    for (std::size_t k = 0; k < 4; ++k)
      sum += law_.half_other * weight[k] * other_.sheared()->lever(corner[k], other_.state().position);
  return sum;
}

// The place where the node is now, from that of the material it lay on at first.
Vec3 PlyPassState::slip(int lane) const {
  if (stiffness_[lane] == 0.0 || origin_facet_[lane] < 0) return {0.0, 0.0, 0.0};
  return minus(frame_at(place_of(lane)).point,
               frame_at({origin_facet_[lane], origin_[0][lane], origin_[1][lane]}).point);
}

// The kernel's forces once more, from what it left: the stretch after the cut, and the dampers' share.
PlyPassState::Press PlyPassState::press(int lane) const {
  Press press;
  const double k = stiffness_[lane], depth = depth_[lane], area = law_.share * own_.area()[lane];
  if (k == 0.0 || !(depth > touch_) || depth >= 2.0 * reach_at(lane, place_of(lane))) return press;
  const double pressed = std::max(depth, 0.0), soft = std::min(pressed, law_.softening);
  const double elastic = law_.pressure.intervals > 0 ? area * table_value(law_.pressure, pressed)
                                                     : k * soft / law_.softening * (pressed - 0.5 * soft);
  press.normal = std::max(elastic + drag_[0][lane], 0.0);
  const SurfaceFrame frame = frame_at(place_of(lane));
  const double kt = law_.tangential * k;
  const Vec3 along = plus(scaled(frame.s1, kt * (place_[0][lane] - anchor_[0][lane]) - drag_[1][lane]),
                          scaled(frame.s2, kt * (place_[1][lane] - anchor_[1][lane]) - drag_[2][lane]));
  press.tangential = length(along);
  press.pressure = area > 0.0 ? press.normal / area : 0.0;
  if (!(press.normal > 0.0) && !(press.tangential > 0.0)) return press;
  constexpr double at_the_limit = 1.0 - 1e-5;  // single precision went into the cut
  double limit = law_.friction * press.normal;
  if (law_.shear.intervals > 0) {
    const double stretch = length(plus(scaled(frame.s1, place_[0][lane] - anchor_[0][lane]),
                                       scaled(frame.s2, place_[1][lane] - anchor_[1][lane])));
    limit += area * table_value(law_.shear, path_[lane] + stretch);
  }
  press.friction = press.tangential >= at_the_limit * limit ? FrictionState::slip : FrictionState::stick;
  return press;
}

void PlyPassState::archive_feet(Archive& archive) {
  archive.indices("a foot's cell", facet_, -1, other_.surface().facets() - 1);
  for (auto& list : place_) archive.numbers("a foot", list);
  for (const int facet : facet_)
    if (facet >= 0 && !other_.surface().exists(facet)) throw DamagedState{"a foot where there is no cell"};
}

void PlyPassState::archive(Archive& archive) {
  archive_feet(archive);
  archive.indices("a first foot's cell", origin_facet_, -1, other_.surface().facets() - 1);
  archive.numbers("a spring between plies", stiffness_, not_negative);
  for (auto* places : {&anchor_, &origin_})
    for (auto& list : *places) archive.numbers("a foot", list);
  archive.numbers("a depth between plies", depth_);
  archive.numbers("a slip path", path_, not_negative);
  for (auto& list : drag_) archive.numbers("a drag between plies", list);
  archive.numbers("a clearance between plies", far_, infinite_too);
  std::vector<int> flags;
  for (std::size_t b = 0; b < clear_.size(); ++b) flags.insert(flags.end(), {clear_[b], measured_[b]});
  archive.indices("whether a block is clear", flags, 0, 1);
  for (std::size_t b = 0; b < clear_.size(); ++b) {
    clear_[b] = static_cast<char>(flags[2 * b]);
    measured_[b] = static_cast<char>(flags[2 * b + 1]);
  }
  for (int l = 0; l < own_.lanes(); ++l) {
    if (stiffness_[l] > 0.0 && facet_[l] < 0) throw DamagedState{"a spring between plies without a foot"};
    if (origin_facet_[l] >= 0 && !other_.surface().exists(origin_facet_[l]))
      throw DamagedState{"a first foot where there is no cell"};
    set_corner(l);
  }
  for (std::size_t b = 0; b < clear_.size(); ++b) count_off(static_cast<int>(b));
}

}  // namespace weaveform
