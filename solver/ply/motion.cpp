#include "solver/ply/motion.hpp"

#include <algorithm>

namespace weaveform {
namespace {

constexpr int bands_at_a_time = 8, blocks_at_a_time = 256;  // that a thread moves before it looks for more

int parts_of(int count, int part) {
  return (count + part - 1) / part;
}

}  // namespace

Motion::Motion(const PackedMesh& packed, const Bands& bands, const std::vector<char>& waits, double damping, Team& team)
    : packed_(packed),
      bands_(bands),
      blocks_(split_by_waiting(bands, waits)),
      waiting_(blocks_.waiting.item),
      damping_(damping),
      team_(team),
      inverse_mass_(packed.nodes, 0.0),
      mass_(packed.nodes, 0.0),
      sums_(bands.size()) {
  for (const int n : packed.packed_of_mesh) {
    mass_[n] = packed.mass[n];
    inverse_mass_[n] = packed.mass[n] > 0.0 ? 1.0 / packed.mass[n] : 0.0;  // tied nodes have none
  }
  for (int n = packed.lattice_nodes(); n < packed.nodes; n += vector_width) waiting_.push_back(n);
  waiting_sums_.resize(parts_of(static_cast<int>(waiting_.size()), blocks_at_a_time));
}

BandMove Motion::begin(State& state, std::vector<Grip>& grips, double step_before, double step) {
  const double kick = 0.5 * (step_before + step), half = 0.5 * damping_ * kick;
  for (auto& grip : grips) remember_velocities(grip, state);
  BandMove move = {.blocks = blocks_,
                   .nodes = {},
                   .step = {.keep = (1.0 - half) / (1.0 + half), .kick = kick / (1.0 + half), .drift = step},
                   .advance = flat_ ? node_loops().advance_flat : node_loops().advance,
                   .sums = sums_};
  move.nodes.inverse_mass = inverse_mass_.data();
  move.nodes.mass = mass_.data();
  for (int c = 0; c < 3; ++c) {
    move.nodes.force[c] = state.force[c].data();
    move.nodes.velocity[c] = state.velocity[c].data();
    move.nodes.position[c] = state.position[c].data();
  }
  outcome_.kick = kick;
  return move;
}

void Motion::move_free(const BandMove& move) {
  team_.run(parts_of(bands_.size(), bands_at_a_time), [&](int part) {
    const int last = std::min(bands_.size(), (part + 1) * bands_at_a_time);
    for (int b = part * bands_at_a_time; b < last; ++b)
      move_free_nodes(move, b, bands_.first_row[b], bands_.first_row[b + 1]);
  });
}

// One sum per part and lane, added in order: the same bits for any number of threads.
double Motion::move_waiting(const BandMove& move) {
  const int count = static_cast<int>(waiting_.size());
  team_.run(static_cast<int>(waiting_sums_.size()), [&](int part) {
    const int first = part * blocks_at_a_time;
    waiting_sums_[part] = {};
    move.advance(move.nodes, move.step, waiting_.data() + first, std::min(blocks_at_a_time, count - first),
                 waiting_sums_[part].lane);
  });
  double sum = 0.0;
  for (const auto* sums : {&sums_, &waiting_sums_})
    for (const LaneSums& one : *sums)
      for (const double lane : one.lane) sum += lane;
  return sum;
}

const Motion::Outcome& Motion::finish(State& state, const BandMove& move, std::vector<Grip>& grips,
                                      const std::vector<double>& from, const std::vector<double>& to) {
  double sum = move_waiting(move);
  outcome_.grip_force.resize(grips.size());
  for (std::size_t g = 0; g < grips.size(); ++g)
    outcome_.grip_force[g] = apply_grip(grips[g], packed_, state, from[g], to[g], move.step.kick, move.step.drift, sum);
  outcome_.kinetic = 0.5 * sum;
  return outcome_;
}

const Motion::Outcome& Motion::advance(State& state, std::vector<Grip>& grips, const std::vector<double>& from,
                                       const std::vector<double>& to, double step_before, double step) {
  const BandMove move = begin(state, grips, step_before, step);
  move_free(move);
  return finish(state, move, grips, from, to);
}

std::vector<char> waiting_nodes(const Mesh& mesh, const PackedMesh& packed, const std::vector<Grip>& grips) {
  std::vector<char> waits(packed.nodes, 0);
  const auto mark = [&](const std::vector<int>& nodes) {
    for (const int n : nodes) waits[n] = 1;
  };
  const auto mark_of_mesh = [&](int n) { waits[packed.packed_of_mesh[n]] = 1; };
  for (const LooseYarns& yarns : packed.loose_yarns) {
    mark(yarns.node0);
    mark(yarns.node1);
  }
  for (const auto& nodes : packed.loose_cells.node)
    for (const int n : nodes) waits[n] = 1;
  for (const Grip& grip : grips) mark(grip.node);
  for (const auto& tie : mesh.tie)
    for (const int n : {tie.node, tie.to[0], tie.to[1]}) mark_of_mesh(n);
  for (const auto& nodes : mesh.symmetry.on_plane)
    for (const int n : nodes) mark_of_mesh(n);
  for (const auto& image : mesh.symmetry.image)
    for (const int n : {image.node, image.of}) mark_of_mesh(n);
  return waits;
}

}  // namespace weaveform
