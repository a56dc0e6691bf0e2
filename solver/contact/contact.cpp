#include "solver/contact/contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/error.hpp"
#include "core/keys/advice.hpp"

namespace weaveform {
namespace {

constexpr double start_tolerance = 1e-9;  // mm; a start this deep counts as touching
constexpr double coupling_split = 0.1;    // how a spring to a pushed tool is shared between node and tool, see below

double dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double stiffness_factor(const AnalysisSpec& analysis) {
  return analysis.contact_stiffness.value_or(analysis.step_bound == "reached" ? contact_stiffness_reached : 1.0);
}

// A cell's area goes to its nodes in equal parts.
Doubles node_areas(const Mesh& mesh, const PackedMesh& packed) {
  Doubles area(packed.nodes, 0.0);
  for (int c = 0; c < mesh.cells.size(); ++c) {
    const int begin = mesh.cells.offset[c], end = mesh.cells.offset[c + 1];
    for (int a = begin; a < end; ++a)
      area[packed.packed_of_mesh[mesh.cells.node[a]]] += mesh.cells.area[c] / (end - begin);
  }
  const auto take_images = [&] {  // beyond a mirror plane
    for (const auto& image : mesh.symmetry.image) {
      double& there = area[packed.packed_of_mesh[image.node]];
      area[packed.packed_of_mesh[image.of]] += there;
      there = 0.0;
    }
  };
  take_images();
  for (const auto& tie : mesh.tie) {  // a node that follows others touches through them, as it has its mass in them
    double& there = area[packed.packed_of_mesh[tie.node]];
    const double share = std::max(tie.share, 0.0);
    area[packed.packed_of_mesh[tie.to[0]]] += (1.0 - share) * there;
    area[packed.packed_of_mesh[tie.to[1]]] += share * there;
    there = 0.0;
  }
  take_images();
  return area;
}

// Along the mirror planes that mirror a resting tool onto itself: the force across them is zero.
Vec3 along_planes(Vec3 direction, const std::vector<SymmetryPlane>& planes) {
  for (const auto& plane : planes) {
    const double across = dot(direction, plane.normal);
    for (int c = 0; c < 3; ++c) direction[c] -= across * plane.normal[c];
  }
  return direction;
}

}  // namespace

double Contact::Partner::reaction() const {
  return dot(force, tool.direction);
}

Placement Contact::Partner::place() const {
  Placement place = tool.start;
  for (int c = 0; c < 3; ++c) place.origin[c] += motion.displacement() * tool.direction[c];
  return place;
}

ContactTool Contact::Partner::contact_tool() const {
  const double v = motion.velocity();
  return {place().origin, {v * tool.direction[0], v * tool.direction[1], v * tool.direction[2]}};
}

Contact::Contact(const Mesh& mesh, const Scene& scene, const std::vector<Tool>& tools, const PackedMesh& packed,
                 const State& start, double duration, double fabric_step, Team& team)
    : packed_(packed),
      team_(team),
      thickness_(mesh.thickness),
      least_spacing_(std::min(mesh.spacing[0], mesh.spacing[1])),
      frequency_(std::sqrt(contact_stiffness_share * stiffness_factor(scene.analysis)) * 2.0 / fabric_step),
      fabric_frequency_(2.0 / fabric_step),
      parts_(mesh.symmetry.parts()),
      planes_(mesh.symmetry.plane),
      mass_(packed.nodes, 0.0),
      area_(node_areas(mesh, packed)),
      mesh_of_packed_(packed.nodes, -1) {
  for (int n = 0; n < mesh.node_count(); ++n) {
    const int p = packed.packed_of_mesh[n];
    mass_[p] = packed.mass[p];
    mesh_of_packed_[p] = mesh.shown_node(n);
    blank_mass_ += packed.mass[p];
  }
  for (std::size_t t = 0; t < tools.size(); ++t) {
    Tool tool = tools[t];
    ToolSpec spec = scene.tools[t];
    // a half or quarter of the fabric meets a half or quarter of the tool
    if (spec.force) *spec.force /= parts_;
    if (spec.mass) *spec.mass /= parts_;
    if (spec.travel == 0.0 && !spec.force) tool.direction = along_planes(tool.direction, mesh.symmetry.plane);
    partners_.push_back(make_partner(tool, spec, duration, start, default_tool_mass(scene.analysis, blank_mass_)));
  }
  refuse_penetration(start);
}

Contact::Partner Contact::make_partner(const Tool& tool, const ToolSpec& spec, double duration, const State& start,
                                       double free_mass) const {
  const double mass = spec.mass.value_or(free_mass);
  // k (u - U)^2 <= (1 + e) k u^2 + (1 + 1/e) k U^2: the tool's share must stay below the fabric's greatest omega^2
  const double least_mass =
      (1.0 + 1.0 / coupling_split) * frequency_ * frequency_ * blank_mass_ / (fabric_frequency_ * fabric_frequency_);
  if (spec.force && mass < least_mass)
    throw InputError(
        fmt::format("[tools.{}] mass {:.4g} tonne is too light for the stable step; give {:.4g} or more (the blank has "
                    "{:.4g})",
                    spec.name, parts_ * mass, rounded_up(parts_ * least_mass, 4), parts_ * blank_mass_));
  Partner partner(tool, ToolMotion(spec, duration, mass));
  partner.law = {.offset = tool.offset,
                 .softening = contact_softening * thickness_,
                 .frequency2 = frequency_ * frequency_,
                 .damping_rate = 2.0 * contact_damping * frequency_,
                 .friction = tool.friction};
  partner.anchor = start.position;
  for (int c = 0; c < 3; ++c)
    for (double& value : partner.anchor[c]) value -= tool.start.origin[c];
  partner.clearance.assign(block_count(), 0.0);
  partner.measured.assign(block_count(), 0);
  partner.sums.resize(block_count());
  partner.depth.assign(block_count(), 0.0);
  if (tool.shape == ToolShape::triangles) {
    partner.hint.assign(packed_.nodes, 0);
    partner.far.assign(packed_.nodes, -std::numeric_limits<double>::infinity());
    for (auto& component : partner.measured_at) component.assign(packed_.nodes, 0.0);
    // no fabric, no distance: nodes that do not exist are never measured
    for (int n = 0; n < packed_.nodes; ++n)
      if (mass_[n] == 0.0 && area_[n] == 0.0) partner.far[n] = 1e30;
  }
  return partner;
}

int Contact::block_count() const {
  return (packed_.nodes + points_at_a_time - 1) / points_at_a_time;
}

void Contact::refuse_penetration(const State& start) const {
  std::vector<std::string> complaints;
  for (const auto& partner : partners_) {
    double deepest = start_tolerance;
    int node = -1;
    for (int n = 0; n < packed_.nodes; ++n) {
      if (mass_[n] == 0.0) continue;
      Distances found;
      int hint = 0;
      tool_distances(partner.tool, partner.tool.start,
                     {&start.position[0][n], &start.position[1][n], &start.position[2][n]}, 1, &hint, found);
      const double depth = partner.tool.offset - found.distance[0];
      if (depth > deepest) {
        deepest = depth;
        node = n;
      }
    }
    if (node >= 0)
      complaints.push_back(fmt::format(
          "[tools.{}]: node {} at ({:.6g}, {:.6g}, {:.6g}) mm starts {:.4g} mm inside it (fabric's half thickness "
          "{:.4g} mm included); move the tool's position or the blank's",
          partner.tool.name, mesh_of_packed_[node], start.position[0][node], start.position[1][node],
          start.position[2][node], deepest, partner.tool.offset));
  }
  if (!complaints.empty()) throw InputError(complaints);
}

void Contact::add_forces(State& state, double /*step*/) {
  const auto begin = std::chrono::steady_clock::now();
  const double step = started_ ? state.time - time_before_ : 0.0;
  std::vector<double> reaction_before(partners_.size());
  for (std::size_t t = 0; t < partners_.size(); ++t) reaction_before[t] = partners_[t].reaction();
  move_tools(state.time, step);
  team_.run(block_count(), [&](int block) { treat_block(block, state, step); });
  for (std::size_t t = 0; t < partners_.size(); ++t) {
    sum_blocks(partners_[t], reaction_before[t]);
    check(partners_[t], state);
  }
  read_instruments();
  started_ = true;
  time_before_ = state.time;
  wall_s_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void Contact::move_tools(double time, double step) {
  for (auto& partner : partners_) {
    partner.motion.advance(time, step, partner.reaction());
    const double way = std::abs(partner.motion.state().way);
    partner.way += way;
    if (way > least_spacing_)
      throw PhysicsError(fmt::format(
          "at t = {:.4g} s: tool '{}' moved {:.4g} mm in one step, more than a cell ({:.4g} mm); load more slowly "
          "(analysis.duration, analysis.loading_speed)",
          time, partner.tool.name, way, least_spacing_));
  }
}

ContactNodes Contact::block_nodes(int block, Partner& partner, State& state) const {
  const int first = block * points_at_a_time;
  ContactNodes nodes{};
  nodes.count = std::min(points_at_a_time, packed_.nodes - first);
  nodes.mass = mass_.data() + first;
  nodes.area = area_.data() + first;
  for (int c = 0; c < 3; ++c) {
    nodes.x[c] = state.position[c].data() + first;
    nodes.v[c] = state.velocity[c].data() + first;
    nodes.force[c] = state.force[c].data() + first;
    nodes.anchor[c] = partner.anchor[c].data() + first;
  }
  return nodes;
}

// A closest triangle is dear, a point far from it most of all. A distance changes by no more than point and tool move,
// so that most points need no new one: they get a lower bound, which contact, seeing no touch, takes for the distance.
void Contact::triangle_distances(Partner& partner, const ContactNodes& nodes, int first, Distances& distances) {
  constexpr double rounding = 1e-9;  // mm
  for (int n = 0; n < nodes.count; ++n) {
    const int node = first + n;
    const Vec3 moved = {nodes.x[0][n] - partner.measured_at[0][node], nodes.x[1][n] - partner.measured_at[1][node],
                        nodes.x[2][n] - partner.measured_at[2][node]};
    const double bound =
        partner.far[node] - partner.way - std::sqrt(moved[0] * moved[0] + moved[1] * moved[1] + moved[2] * moved[2]);
    if (bound > partner.tool.offset + rounding) {
      distances.distance[n] = bound;
      for (int c = 0; c < 3; ++c) distances.normal[c][n] = c == 2 ? 1.0 : 0.0;
      continue;
    }
    Distances one;
    tool_distances(partner.tool, partner.place(), {nodes.x[0] + n, nodes.x[1] + n, nodes.x[2] + n}, 1,
                   &partner.hint[node], one);
    distances.distance[n] = one.distance[0];
    for (int c = 0; c < 3; ++c) {
      distances.normal[c][n] = one.normal[c][0];
      partner.measured_at[c][node] = nodes.x[c][n];
    }
    partner.far[node] = one.distance[0] + partner.way;
  }
}

// Touches only the block's own nodes and entries, so that blocks can be treated side by side.
void Contact::treat_block(int block, State& state, double step) {
  constexpr double rounding = 1.0 + 1e-9;  // of speeds, ways and times
  double speed = -1.0;                     // mm/s; greatest of the block's nodes, measured when wanted
  for (auto& partner : partners_) {
    const ContactNodes nodes = block_nodes(block, partner, state);
    double& clearance = partner.clearance[block];
    const ContactTool tool = partner.contact_tool();
    const bool was_clear = clearance > 0.0;  // at the step before: no node stuck to the tool
    if (was_clear) {
      if (speed < 0.0) speed = greatest_speed({0.0, 0.0, 0.0}, nodes);
      clearance -= (speed * step + std::abs(partner.motion.state().way)) * rounding;
    }
    partner.measured[block] = 0;
    if (clearance > 0.0) continue;
    Distances distances;
    if (partner.hint.empty())
      tool_distances(partner.tool, partner.place(), {nodes.x[0], nodes.x[1], nodes.x[2]}, nodes.count, nullptr,
                     distances);
    else
      triangle_distances(partner, nodes, block * points_at_a_time, distances);
    const double gap = least_gap(distances, partner.tool.offset, nodes);
    if (was_clear) reset_anchors(tool, nodes);
    clearance = std::max(gap, 0.0);
    if (gap > 0.0) continue;
    partner.depth[block] = -gap;
    partner.sums[block] = contact_forces(partner.law, tool, distances, step, nodes);
    partner.measured[block] = 1;
  }
}

void Contact::sum_blocks(Partner& partner, double reaction_before) {
  partner.force = {0.0, 0.0, 0.0};
  partner.area = partner.energy = partner.deepest = 0.0;
  for (std::size_t b = 0; b < partner.sums.size(); ++b) {
    if (partner.measured[b] == 0) continue;
    const ContactSums& sums = partner.sums[b];
    for (int c = 0; c < 3; ++c) partner.force[c] += sums.force[c];
    partner.area += sums.area;
    partner.energy += sums.energy;
    partner.friction_work += sums.friction_work;
    partner.damping_work += sums.damping_work;
    partner.deepest = std::max(partner.deepest, partner.depth[b]);
  }
  greatest_depth_ = std::max(greatest_depth_, partner.deepest);
  partner.motion.add_travel_work(reaction_before, partner.reaction());
}

void Contact::read_instruments() {
  readings_.clear();
  for (const auto& partner : partners_) {
    // what the mirrored parts feel across a plane is the opposite
    Vec3 whole = along_planes(partner.force, planes_);
    for (double& component : whole) component *= parts_;
    readings_.push_back({partner.motion.displacement(), parts_ * partner.reaction(), parts_ * partner.area, whole});
  }
}

void Contact::check(const Partner& partner, const State& state) const {
  if (partner.deepest <= thickness_) return;
  for (int n = 0; n < packed_.nodes; ++n) {
    Distances found;
    int hint = 0;
    tool_distances(partner.tool, partner.place(), {&state.position[0][n], &state.position[1][n], &state.position[2][n]},
                   1, &hint, found);
    if (mass_[n] == 0.0 || partner.tool.offset - found.distance[0] < partner.deepest) continue;
    throw PhysicsError(fmt::format(
        "at t = {:.4g} s, step {}: node {} at ({:.6g}, {:.6g}, {:.6g}) mm has gone {:.4g} mm into tool '{}', more than "
        "the fabric's thickness ({:.4g} mm); load more slowly, see whether the tools can close, or, where friction or "
        "a "
        "binder pull the yarns over an edge, make blank.coarsening smaller: a node bears so much",
        state.time, state.step, mesh_of_packed_[n], state.position[0][n], state.position[1][n], state.position[2][n],
        partner.deepest, partner.tool.name, thickness_));
  }
}

double Contact::stored_energy() const {
  double sum = 0.0;
  for (const auto& partner : partners_) sum += partner.energy;
  return sum;
}

double Contact::kinetic_energy() const {
  double sum = 0.0;
  for (const auto& partner : partners_) sum += partner.motion.kinetic_energy(time_before_, partner.reaction());
  return sum;
}

double Contact::dissipated() const {
  const Cost total = cost();
  return total.friction_work + total.damping_work;
}

double Contact::external_work() const {
  double sum = 0.0;
  for (const auto& partner : partners_) sum += partner.motion.work();
  return sum;
}

// A node may touch two tools at once (binder and die). Damping that acts on velocities half a step behind shortens the
// stable step like a stiffness: (sqrt(1 + z^2) - z) with z = c/(2 m w) is that of w^2 + c w/m to first order; w is the
// greatest of fabric and contact.
void Contact::add_stiffness_bound(const std::vector<Vec3>& /*position*/, double fabric_frequency,
                                  std::vector<double>& bound) const {
  const double greatest = std::hypot(fabric_frequency, std::sqrt(2.0) * frequency_);
  std::vector<double> rates;  // 1/s^2
  for (const auto& partner : partners_)
    rates.push_back((partner.motion.pushed() ? 1.0 + coupling_split : 1.0) * partner.law.frequency2 +
                    partner.law.damping_rate * greatest);
  std::sort(rates.rbegin(), rates.rend());
  const double rate = rates.front() + (rates.size() > 1 ? rates[1] : 0.0);
  for (std::size_t n = 0; n < bound.size(); ++n) bound[n] += rate * mass_[packed_.packed_of_mesh[n]];
}

// The tool's part of k (u - U)^2, see make_partner, with the damping of all nodes counted as above.
double Contact::longest_step() const {
  double greatest = 0.0;  // 1/s^2
  for (const auto& partner : partners_) {
    if (!partner.motion.pushed()) continue;
    const double share = (1.0 + 1.0 / coupling_split) * blank_mass_ / partner.motion.mass();
    greatest = std::max(greatest, share * partner.law.frequency2 * (1.0 + 2.0 * contact_damping));
  }
  return 2.0 / std::sqrt(greatest);
}

Contact::Cost Contact::cost() const {
  Cost total{.penetration = greatest_depth_ / thickness_, .wall_s = wall_s_};
  for (const auto& partner : partners_) {
    total.friction_work += partner.friction_work;
    total.damping_work += partner.damping_work + partner.motion.damping_work();
  }
  return total;
}

namespace {

// One list for both ways: `visit` gets each number that a checkpoint keeps.
template <class Partner, class Visit>
void visit_memory(Partner& partner, Visit visit) {
  for (auto& component : partner.anchor)
    for (auto& value : component) visit(value);
  for (auto& value : partner.clearance) visit(value);
  for (auto& value : partner.hint) visit(value);
  for (auto& component : partner.measured_at)
    for (auto& value : component) visit(value);
  for (auto& value : partner.far) visit(value);
  visit(partner.way);
  auto& motion = partner.motion.state();
  for (auto* value : {&motion.displacement, &motion.velocity, &motion.step, &motion.way, &motion.work,
                      &motion.damping_work, &partner.area, &partner.energy, &partner.friction_work,
                      &partner.damping_work, &partner.deepest, &partner.force[0], &partner.force[1], &partner.force[2]})
    visit(*value);
}

}  // namespace

std::vector<double> Contact::memory() const {
  std::vector<double> memory = {time_before_, greatest_depth_, wall_s_};
  for (const auto& partner : partners_)
    visit_memory(partner, [&](auto value) { memory.push_back(static_cast<double>(value)); });
  return memory;
}

void Contact::recall(const std::vector<double>& memory) {
  started_ = true;
  time_before_ = memory.at(0);
  greatest_depth_ = memory.at(1);
  wall_s_ = memory.at(2);
  std::size_t next = 3;
  for (auto& partner : partners_) {
    const int triangles = partner.tool.surface ? partner.tool.surface->size() : 0;
    visit_memory(partner, [&](auto& value) {
      const double kept = memory.at(next++);
      if constexpr (std::is_same_v<decltype(value), int&>) {
        if (!(kept >= 0.0 && kept < triangles)) throw FileError("contact: a triangle that the tool does not have");
      } else if (std::isnan(kept)) {
        throw FileError("contact: not a number");
      }
      value = static_cast<std::remove_reference_t<decltype(value)>>(kept);
    });
  }
  read_instruments();
}

}  // namespace weaveform
