#include "solver/contact/contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "solver/constraint/ties.hpp"
#include "solver/contact/node_area.hpp"
#include "solver/state/row_blocks.hpp"

namespace weaveform {
namespace {

constexpr int parts_of_thread = 4;
constexpr double start_tolerance = 1e-9;  // mm; a start this deep counts as touching

double stiffness_factor(const AnalysisSpec& analysis) {
  return analysis.contact_stiffness.value_or(analysis.step_bound == StepBound::reached ? contact_stiffness_reached
                                                                                       : 1.0);
}

// Every thread has the blocks of about those rows whose forces it computes: its cache holds them, and fetching them from
// another's costs more than an even load would gain. Others take of them by whole parts.
std::vector<int> parts_of_blocks(const PackedMesh& packed, int threads, int blocks) {
  std::vector<int> first = balanced_blocks(packed, parts_of_thread * threads);
  for (int& row : first) row = row * packed.stride / points_at_a_time;
  first.back() = blocks;
  return first;
}

}  // namespace

double contact_frequency(const AnalysisSpec& analysis, double fabric_step) {
  return std::sqrt(contact_stiffness_share * stiffness_factor(analysis)) * 2.0 / fabric_step;
}

Contact::Contact(const Mesh& mesh, const PackedMesh& packed, const State& start, const SprungPly& ply,
                 RigidTools& tools, Team& team, const std::vector<Tool>* own, ShearedThickness* sheared)
    : mesh_(mesh),
      packed_(packed),
      team_(team),
      tools_(tools),
      sheared_(sheared),
      thickness_(mesh.thickness),
      frequency_(ply.frequency),
      mass_(packed.nodes, 0.0),
      area_(node_areas(mesh, packed)),
      mesh_of_packed_(packed.nodes, -1) {
  for (int n = 0; n < mesh.node_count(); ++n) {
    const int p = packed.packed_of_mesh[n];
    mass_[p] = packed.mass[p];
    mesh_of_packed_[p] = mesh.shown_node(n);
  }
  if (ply.curved_after && sheared != nullptr)
    throw InputError(
        "analysis.curved_contact does not know of thickness that grows with shear; leave it out, or set "
        "model.contact_thickness back");
  if (ply.curved_after) curved_.emplace(mesh, packed, *ply.curved_after);
  for (std::size_t t = 0; t < tools.tools().size(); ++t) {
    const Tool& tool = tools.tools()[t].tool;
    touch_.push_back(make_touch(tool, own != nullptr ? (*own)[t].offset : tool.offset));
  }
  loads_.resize(touch_.size());
  part_ = parts_of_blocks(packed, team.threads(), block_count());
  refuse_penetration(start);
}

Contact::Touch Contact::make_touch(const Tool& tool, double offset) const {
  Touch touch;
  touch.law = {.offset = offset,
               .softening = contact_softening * thickness_,
               .frequency2 = frequency_ * frequency_,
               .damping_rate = 2.0 * contact_damping * frequency_,
               .friction = tool.friction};
  for (auto& component : touch.anchor) component.assign(packed_.nodes, no_anchor);
  for (auto& component : touch.drag) component.assign(packed_.nodes, 0.0);
  touch.clearance.assign(group_count(), 0.0);
  touch.held.assign(group_count(), 0);
  touch.measured.assign(block_count(), 0);
  touch.sums.resize(block_count());
  touch.depth.assign(block_count(), 0.0);
  if (curved_) touch.curved = curved_->new_memory();
  if (tool.shape == ToolShape::triangles) {
    touch.hint.assign(packed_.nodes, 0);
    touch.far.assign(packed_.nodes, -std::numeric_limits<double>::infinity());
    for (auto& component : touch.measured_at) component.assign(packed_.nodes, 0.0);
    // no fabric, no distance: nodes that do not exist are never measured
    for (int n = 0; n < packed_.nodes; ++n)
      if (mass_[n] == 0.0 && area_[n] == 0.0) touch.far[n] = 1e30;
  }
  return touch;
}

int Contact::group_count() const {
  return (packed_.nodes + group_nodes - 1) / group_nodes;
}

int Contact::block_count() const {
  return (packed_.nodes + points_at_a_time - 1) / points_at_a_time;
}

void Contact::refuse_penetration(const State& start) const {
  std::vector<std::string> complaints;
  for (std::size_t t = 0; t < touch_.size(); ++t) {
    const Tool& tool = tools_.tools()[t].tool;
    double deepest = start_tolerance;
    int node = -1;
    for (int n = 0; n < packed_.nodes; ++n) {
      if (mass_[n] == 0.0) continue;
      Distances found;
      int hint = 0;
      tool_distances(tool, tool.start, {&start.position[0][n], &start.position[1][n], &start.position[2][n]}, 1, &hint,
                     found);
      const double depth = offset_at(touch_[t], n) - found.distance[0];
      if (depth > deepest) {
        deepest = depth;
        node = n;
      }
    }
    if (node >= 0)
      complaints.push_back(fmt::format(
          "[tools.{}]: node {} at ({:.6g}, {:.6g}, {:.6g}) mm starts {:.4g} mm inside it (fabric's half thickness "
          "{:.4g} mm included); move the tool's position or the blank's",
          tool.name, mesh_of_packed_[node], start.position[0][node], start.position[1][node], start.position[2][node],
          deepest, offset_at(touch_[t], node)));
  }
  if (!complaints.empty()) throw InputError(complaints);
}

void Contact::add_forces(State& state, double /*step*/) {
  const auto begin = std::chrono::steady_clock::now();
  const double step = tools_.step_made();
  team_.run(static_cast<int>(part_.size()) - 1, [&](int part) {
    for (int block = part_[part]; block < part_[part + 1]; ++block) treat_block(block, state, step);
  });
  for (std::size_t t = 0; t < touch_.size(); ++t) {
    sum_blocks(touch_[t], step > 0.0, loads_[t]);
    check(t, state);
  }
  wall_s_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

ContactNodes Contact::block_nodes(int block, Touch& touch, State& state) const {
  const int first = block * points_at_a_time;
  ContactNodes nodes{};
  nodes.count = std::min(points_at_a_time, packed_.nodes - first);
  nodes.mass = mass_.data() + first;
  nodes.area = area_.data() + first;
  for (int c = 0; c < 3; ++c) {
    nodes.x[c] = state.position[c].data() + first;
    nodes.v[c] = state.velocity[c].data() + first;
    nodes.force[c] = state.force[c].data() + first;
    nodes.anchor[c] = touch.anchor[c].data() + first;
    nodes.drag[c] = touch.drag[c].data() + first;
  }
  if (sheared_ != nullptr) {
    nodes.swell = sheared_->swell().data() + first;
    nodes.load = sheared_->load().data() + first;
  }
  return nodes;
}

// A closest triangle is dear, a point far from it most of all. A distance changes by no more than point and tool move,
// so that most points need no new one: they get a lower bound, which contact, seeing no touch, takes for the distance.
void Contact::triangle_distances(Touch& touch, const MovingTool& tool, const ContactNodes& nodes, int first,
                                 const ContactGroups& groups, Distances& distances) const {
  constexpr double rounding = 1e-9;  // mm
  const double near = rounding + (curved_ ? curved_->greatest_lift() : 0.0);
  for (int q = 0; q < groups.count * group_nodes; ++q) {
    const int n = groups.node[q / group_nodes] + q % group_nodes, node = first + n;
    if (n >= nodes.count) break;
    const Vec3 moved = {nodes.x[0][n] - touch.measured_at[0][node], nodes.x[1][n] - touch.measured_at[1][node],
                        nodes.x[2][n] - touch.measured_at[2][node]};
    const double bound =
        touch.far[node] - tool.way - std::sqrt(moved[0] * moved[0] + moved[1] * moved[1] + moved[2] * moved[2]);
    if (bound > offset_at(touch, node) + near) {
      distances.distance[q] = bound;
      for (int c = 0; c < 3; ++c) distances.normal[c][q] = c == 2 ? 1.0 : 0.0;
      continue;
    }
    Distances one;
    tool_distances(tool.tool, tool.place(), {nodes.x[0] + n, nodes.x[1] + n, nodes.x[2] + n}, 1, &touch.hint[node],
                   one);
    distances.distance[q] = one.distance[0];
    for (int c = 0; c < 3; ++c) {
      distances.normal[c][q] = one.normal[c][0];
      touch.measured_at[c][node] = nodes.x[c][n];
    }
    touch.far[node] = one.distance[0] + tool.way;
  }
}

// The groups whose clearance may be used up.
ContactGroups Contact::near_groups(Touch& touch, const MovingTool& tool, int first, const ContactNodes& nodes,
                                   double step, Common& common) const {
  constexpr double rounding = 1.0 + 1e-9;  // of speeds, ways and times
  ContactGroups near;
  for (int n = 0; n < nodes.count; n += group_nodes) {
    double& clearance = touch.clearance[(first + n) / group_nodes];
    if (clearance > 0.0) {
      if (common.speed < 0.0) common.speed = greatest_speed({0.0, 0.0, 0.0}, nodes);
      clearance -= (common.speed * step + std::abs(tool.motion.state().way)) * rounding;
      if (sheared_ != nullptr) clearance -= touch.law.offset * sheared_->greatest_rise() * rounding;
    }
    if (clearance <= 0.0) near.add(n, near.count * group_nodes);
  }
  return near;
}

void Contact::measure(Touch& touch, const MovingTool& tool, const ContactNodes& nodes, int first,
                      const ContactGroups& groups, Distances& distances) const {
  if (!touch.hint.empty()) return triangle_distances(touch, tool, nodes, first, groups, distances);
  const bool all = groups.count * group_nodes >= nodes.count;
  if (all)
    return tool_distances(tool.tool, tool.place(), {nodes.x[0], nodes.x[1], nodes.x[2]}, nodes.count, nullptr,
                          distances);
  double x[3][points_at_a_time];
  int count = 0;
  for (int g = 0; g < groups.count; ++g) {
    const int from = groups.node[g], lanes = std::min(group_nodes, nodes.count - from);
    for (int c = 0; c < 3; ++c) {
      if (lanes == group_nodes)  // a few moves: of a known number of bytes, which cannot overlap
        std::memcpy(x[c] + count, nodes.x[c] + from, group_nodes * sizeof(double));
      else
        std::copy_n(nodes.x[c] + from, lanes, x[c] + count);
    }
    count += lanes;
  }
  tool_distances(tool.tool, tool.place(), {x[0], x[1], x[2]}, count, nullptr, distances);
}

// Those that touch or did so at the step before; `lift` (mm) may yet bring the tool nearer.
void Contact::keep_touching(const Touch& touch, int first, double (&gap)[groups_in_block], double lift,
                            ContactGroups& groups) {
  const int count = std::exchange(groups.count, 0);
  for (int g = 0; g < count; ++g) {
    if (gap[g] > lift && touch.held[(first + groups.node[g]) / group_nodes] == 0) continue;
    gap[groups.count] = gap[g];
    groups.add(groups.node[g], groups.at[g], groups.upright[g]);
  }
}

void Contact::lift(const Touch& touch, const State& state, int first, int count, const ContactGroups& groups,
                   Common& common, Distances& distances, ChordTerms& terms) const {
  unsigned wanted = 0;
  for (int g = 0; g < groups.count; ++g) wanted |= 1U << (groups.node[g] / group_nodes);
  wanted &= ~common.turned;
  if (wanted != 0) curved_->find_turns(state, first, count, wanted, common.turns);
  common.turned |= wanted;
  curved_->lift_groups(common.turns, state.time, first, count, groups, touch.law.friction, distances, terms);
}

// Touches only the block's own nodes and entries, so that blocks can be treated side by side.
void Contact::treat_block(int block, State& state, double step) {
  Common common;
  for (std::size_t tool = 0; tool < touch_.size(); ++tool) treat_tool(tool, block, state, step, common);
}

void Contact::treat_tool(std::size_t number, int block, State& state, double step, Common& common) {
  const int first = block * points_at_a_time;
  Touch& touch = touch_[number];
  const MovingTool& moving = tools_.tools()[number];
  const ContactNodes nodes = block_nodes(block, touch, state);
  touch.measured[block] = 0;
  ContactGroups near = near_groups(touch, moving, first, nodes, step, common);
  if (near.count == 0) return;
  Distances distances;
  ChordTerms terms;
  double gap[groups_in_block];  // mm
  measure(touch, moving, nodes, first, near, distances);
  least_gaps(distances, touch.law.offset, nodes, near, gap);
  const double greatest_lift = curved_ ? curved_->greatest_lift() : 0.0;
  for (int g = 0; g < near.count; ++g)
    touch.clearance[(first + near.node[g]) / group_nodes] = std::max(gap[g] - greatest_lift, 0.0);
  keep_touching(touch, first, gap, greatest_lift, near);
  if (near.count == 0) return;
  find_upright(distances, nodes.count, near);
  if (curved_) {
    lift(touch, state, first, nodes.count, near, common, distances, terms);
    least_gaps(distances, touch.law.offset, nodes, near, gap);
    keep_touching(touch, first, gap, 0.0, near);
    if (near.count == 0) return;
  }
  double depth = 0.0;
  for (int g = 0; g < near.count; ++g) {
    touch.held[(first + near.node[g]) / group_nodes] = gap[g] < 0.0 ? 1 : 0;
    depth = std::max(depth, -gap[g]);
  }
  touch.depth[block] = depth;
  const ContactTool tool = moving.contact_tool();
  touch.sums[block] = curved_ ? chord_forces(touch.law, tool, distances, terms, step, nodes, near,
                                             {touch.curved.lift.data() + first, touch.curved.normal.data() + first})
                              : contact_forces(touch.law, tool, distances, step, nodes, near);
  touch.measured[block] = 1;
}

// Before the first step nothing has moved, though a perturbation may have displaced nodes: nothing is lost.
void Contact::sum_blocks(const Touch& touch, bool moved, ToolLoad& load) {
  load.force = {0.0, 0.0, 0.0};
  load.area = load.energy = load.deepest = 0.0;
  for (std::size_t b = 0; b < touch.sums.size(); ++b) {
    if (touch.measured[b] == 0) continue;
    const ContactSums& sums = touch.sums[b];
    for (int c = 0; c < 3; ++c) load.force[c] += sums.force[c];
    load.area += sums.area;
    load.energy += sums.energy;
    if (moved) {
      load.friction_work += sums.friction_work;
      load.damping_work += sums.damping_work;
    }
    load.deepest = std::max(load.deepest, touch.depth[b]);
  }
}

void Contact::check(std::size_t number, const State& state) const {
  const double deepest = loads_[number].deepest;
  if (deepest <= thickness_) return;
  const MovingTool& moving = tools_.tools()[number];
  for (int n = 0; n < packed_.nodes; ++n) {
    Distances found;
    int hint = 0;
    tool_distances(moving.tool, moving.place(), {&state.position[0][n], &state.position[1][n], &state.position[2][n]},
                   1, &hint, found);
    const double lift = curved_ ? touch_[number].curved.lift[n] : 0.0;
    if (mass_[n] == 0.0 || offset_at(touch_[number], n) + lift - found.distance[0] < deepest * (1.0 - 1e-9)) continue;
    throw PhysicsError(fmt::format(
        "at t = {:.4g} s, step {}: node {} at ({:.6g}, {:.6g}, {:.6g}) mm has gone {:.4g} mm into tool '{}', more than "
        "the fabric's thickness ({:.4g} mm); load more slowly, see whether the tools can close, or, where friction or "
        "a binder pull the yarns over an edge, make blank.coarsening smaller: a node bears so much",
        state.time, state.step, mesh_of_packed_[n], state.position[0][n], state.position[1][n], state.position[2][n],
        deepest, moving.tool.name, thickness_));
  }
}

// A node may touch two tools at once (binder and die). Damping that acts on velocities half a step behind shortens the
// stable step like a stiffness: (sqrt(1 + z^2) - z) with z = c/(2 m w) is that of w^2 + c w/m to first order; w is the
// greatest of fabric and contact.
void Contact::add_stiffness_bound(const std::vector<Vec3>& position, double fabric_frequency,
                                  std::vector<double>& bound) const {
  const double greatest = std::hypot(fabric_frequency, std::sqrt(2.0) * frequency_);
  std::vector<double> rates;  // 1/s^2
  for (std::size_t k = 0; k < touch_.size(); ++k)
    rates.push_back((tools_.tools()[k].motion.pushed() ? 1.0 + coupling_split : 1.0) * touch_[k].law.frequency2 +
                    touch_[k].law.damping_rate * greatest);
  std::sort(rates.rbegin(), rates.rend());
  const double rate = (curved_ ? curved_stiffness : 1.0) * (rates.front() + (rates.size() > 1 ? rates[1] : 0.0));
  if (sheared_ != nullptr) return add_swollen_bound(position, rate, bound);
  for (std::size_t n = 0; n < bound.size(); ++n) bound[n] += rate * mass_[packed_.packed_of_mesh[n]];
}

// The springs hang on the ends of a and b too, through the thickness: k (x + offset sum v_a x_a)^2 / 2.
void Contact::add_swollen_bound(const std::vector<Vec3>& position, double rate, std::vector<double>& bound) const {
  double offset = 0.0;  // mm
  for (const auto& touch : touch_) offset = std::max(offset, touch.law.offset);
  Components at;
  for (std::size_t c = 0; c < 3; ++c) {
    at[c].assign(packed_.nodes, 0.0);
    for (std::size_t n = 0; n < position.size(); ++n) at[c][packed_.packed_of_mesh[n]] = position[n][c];
  }
  Doubles sum(packed_.nodes, 0.0);
  for (const int n : packed_.packed_of_mesh) {
    if (mass_[n] == 0.0) continue;
    const double whole = rate * mass_[n] * (1.0 + offset * sheared_->lever(n, at));
    sum[n] += whole;
    sheared_->spread(n, at, offset, whole, sum);
  }
  add_packed_bound(mesh_, packed_, sum, bound);
}

void Contact::find_held(Touch& touch) const {
  std::fill(touch.held.begin(), touch.held.end(), 0);
  for (int n = 0; n < packed_.nodes; ++n)
    if (mass_[n] > 0.0 && touch.anchor[0][n] < no_anchor) touch.held[n / group_nodes] = 1;
}

// Clearances are found anew: what touches is all that has forces.
void Contact::archive(Archive& archive) {
  for (std::size_t k = 0; k < touch_.size(); ++k) {
    Touch& touch = touch_[k];
    for (auto& component : touch.anchor) archive.numbers("an anchor", component);
    for (auto& component : touch.drag) archive.numbers("a contact's drag", component);
    find_held(touch);
    archive_load(archive, loads_[k]);
    if (curved_) CurvedContact::archive(touch.curved, archive);
    if (touch.hint.empty()) continue;
    archive.indices("a triangle that the tool does not have", touch.hint, 0,
                    tools_.tools()[k].tool.surface->size() - 1);
    for (auto& component : touch.measured_at) archive.numbers("a measured place", component);
    archive.numbers("a distance", touch.far, infinite_too);
  }
}

}  // namespace weaveform
