#include "solver/ply/motion.hpp"

namespace weaveform {
namespace {

constexpr std::size_t blocks_worth_a_team = 256;  // that wait

}  // namespace

Motion::Motion(const PackedMesh& packed, const Bands& bands, const std::vector<char>& waits, double damping, Team& team)
    : packed_(packed),
      bands_(bands),
      share_(balanced_bands(bands, team.threads())),
      blocks_(split_by_waiting(bands, waits)),
      damping_(damping),
      team_(team),
      inverse_mass_(packed.nodes, 0.0),
      mass_(packed.nodes, 0.0),
      sums_(bands.size()),
      waiting_sums_(bands.size() + 1) {
  for (const int n : packed.packed_of_mesh) {
    mass_[n] = packed.mass[n];
    inverse_mass_[n] = packed.mass[n] > 0.0 ? 1.0 / packed.mass[n] : 0.0;  // tied nodes have none
  }
  for (int n = packed.lattice_nodes(); n < packed.nodes; n += vector_width) ends_.push_back(n);
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

void Motion::move_waiting(const BandMove& move, int band) {
  const PerRow<int>& waiting = blocks_.waiting;
  const int first = waiting.first[bands_.first_row[band]], last = waiting.first[bands_.first_row[band + 1]];
  waiting_sums_[band] = {};
  move.advance(move.nodes, move.step, waiting.item.data() + first, last - first, waiting_sums_[band].lane);
}

// Sums in order: the same bits for any number of threads.
const Motion::Outcome& Motion::settle(State& state, const BandMove& move, std::vector<Grip>& grips,
                                      const std::vector<double>& from, const std::vector<double>& to) {
  LaneSums& of_ends = waiting_sums_.back();
  of_ends = {};
  move.advance(move.nodes, move.step, ends_.data(), static_cast<int>(ends_.size()), of_ends.lane);
  double sum = 0.0;
  for (const auto* sums : {&sums_, &waiting_sums_})
    for (const LaneSums& one : *sums)
      for (const double lane : one.lane) sum += lane;
  outcome_.grip_force.resize(grips.size());
  for (std::size_t g = 0; g < grips.size(); ++g)
    outcome_.grip_force[g] = apply_grip(grips[g], packed_, state, from[g], to[g], move.step.kick, move.step.drift, sum);
  outcome_.kinetic = 0.5 * sum;
  return outcome_;
}

const Motion::Outcome& Motion::finish(State& state, const BandMove& move, std::vector<Grip>& grips,
                                      const std::vector<double>& from, const std::vector<double>& to) {
  const bool together = blocks_.waiting.item.size() > blocks_worth_a_team;
  team_.run(together ? team_.threads() : 1, [&](int t) {
    const int first = together ? share_[t] : 0, last = together ? share_[t + 1] : bands_.size();
    for (int b = first; b < last; ++b) move_waiting(move, b);
  });
  return settle(state, move, grips, from, to);
}

const Motion::Outcome& Motion::advance(State& state, std::vector<Grip>& grips, const std::vector<double>& from,
                                       const std::vector<double>& to, double step_before, double step) {
  const BandMove move = begin(state, grips, step_before, step);
  team_.run(team_.threads(), [&](int t) {
    for (int b = share_[t]; b < share_[t + 1]; ++b) {
      move_free_nodes(move, b, bands_.first_row[b], bands_.first_row[b + 1]);
      move_waiting(move, b);
    }
  });
  return settle(state, move, grips, from, to);
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
