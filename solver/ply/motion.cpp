#include "solver/ply/motion.hpp"

#include "solver/lattice/node_loops.hpp"

namespace weaveform {

Motion::Motion(const PackedMesh& packed, double damping, Team& team)
    : packed_(packed), damping_(damping), team_(team), inverse_mass_(packed.nodes, 0.0), mass_(packed.nodes, 0.0) {
  for (const int n : packed.packed_of_mesh) {
    mass_[n] = packed.mass[n];
    inverse_mass_[n] = packed.mass[n] > 0.0 ? 1.0 / packed.mass[n] : 0.0;  // tied nodes have none
  }
  for (int j = 0; j < packed.rows; ++j) {
    const Run span = padded(packed.span(j));
    if (span.begin != span.end) add_range({j * packed.stride + span.begin, j * packed.stride + span.end});
  }
  if (packed.lattice_nodes() < packed.nodes) add_range({packed.lattice_nodes(), packed.nodes});
  chunk_.push_back(static_cast<int>(begin_.size()));
  sums_.resize(chunk_.size() - 1);
}

void Motion::add_range(Run range) {
  constexpr int most = 2048;  // nodes that one call moves
  if (chunk_.empty() || in_chunk_ + (range.end - range.begin) > most) {
    chunk_.push_back(static_cast<int>(begin_.size()));
    in_chunk_ = 0;
  }
  in_chunk_ += range.end - range.begin;
  begin_.push_back(range.begin);
  end_.push_back(range.end);
}

const Motion::Outcome& Motion::advance(State& state, std::vector<Grip>& grips, const std::vector<double>& from,
                                       const std::vector<double>& to, double step_before, double step) {
  const double kick_time = 0.5 * (step_before + step);
  const double half = 0.5 * damping_ * kick_time;
  const double keep = (1.0 - half) / (1.0 + half), kick = kick_time / (1.0 + half);
  for (auto& grip : grips) remember_velocities(grip, state);
  NodeMotion nodes{};
  nodes.inverse_mass = inverse_mass_.data();
  nodes.mass = mass_.data();
  for (int c = 0; c < 3; ++c) {
    nodes.force[c] = state.force[c].data();
    nodes.velocity[c] = state.velocity[c].data();
    nodes.position[c] = state.position[c].data();
  }

  // One sum per chunk and lane, added in order below: the same bits for any number of threads.
  const AdvanceLoop advance_nodes = node_loops().advance;
  team_.run(static_cast<int>(sums_.size()), [&](int k) {
    for (double& lane : sums_[k].lane) lane = 0.0;
    advance_nodes(nodes, {keep, kick, step}, begin_.data() + chunk_[k], end_.data() + chunk_[k],
                  chunk_[k + 1] - chunk_[k], sums_[k].lane);
  });
  double sum = 0.0;
  for (const auto& chunk : sums_)
    for (const double lane : chunk.lane) sum += lane;

  outcome_.grip_force.resize(grips.size());
  for (std::size_t g = 0; g < grips.size(); ++g)
    outcome_.grip_force[g] = apply_grip(grips[g], packed_, state, from[g], to[g], kick, step, sum);
  outcome_.kinetic = 0.5 * sum;
  outcome_.kick = kick_time;
  return outcome_;
}

}  // namespace weaveform
