#include "solver/ply/motion.hpp"

#include "solver/lattice/row_kernels.hpp"

namespace weaveform {

Motion::Motion(const PackedMesh& packed, double damping, Team& team)
    : packed_(packed), damping_(damping), team_(team), inverse_mass_(packed.nodes, 0.0), mass_(packed.nodes, 0.0) {
  for (const int n : packed.packed_of_mesh) {
    mass_[n] = packed.mass[n];
    inverse_mass_[n] = packed.mass[n] > 0.0 ? 1.0 / packed.mass[n] : 0.0;  // tied nodes have none
  }
  for (int j = 0; j < packed.rows; ++j) {
    const Run span = padded(packed.span(j));
    if (span.begin != span.end) range_.push_back({j * packed.stride + span.begin, j * packed.stride + span.end});
  }
  if (packed.lattice_nodes() < packed.nodes) range_.push_back({packed.lattice_nodes(), packed.nodes});
  sums_.resize(range_.size());
}

const Motion::Outcome& Motion::advance(State& state, std::vector<Grip>& grips, const std::vector<double>& from,
                                       const std::vector<double>& to, double step_before, double step) {
  const double kick_time = 0.5 * (step_before + step);
  const double half = 0.5 * damping_ * kick_time;
  const double keep = (1.0 - half) / (1.0 + half), kick = kick_time / (1.0 + half);
  for (auto& grip : grips) remember_velocities(grip, state);
  const RowLoops& loops = loops_of_rows();

  // One sum per range and lane, added in order below: the same bits for any number of threads.
  team_.run(static_cast<int>(range_.size()), [&](int r) {
    sums_[r].fill(0.0);
    for (int c = 0; c < 3; ++c)
      loops.advance(inverse_mass_.data(), mass_.data(), state.force[c].data(), state.velocity[c].data(),
                    state.position[c].data(), keep, kick, step, range_[r].begin, range_[r].end, sums_[r].data());
  });
  double sum = 0.0;
  for (const auto& range_sums : sums_)
    for (const double lane : range_sums) sum += lane;

  outcome_.grip_force.resize(grips.size());
  for (std::size_t g = 0; g < grips.size(); ++g)
    outcome_.grip_force[g] = apply_grip(grips[g], packed_, state, from[g], to[g], kick, step, sum);
  outcome_.kinetic = 0.5 * sum;
  outcome_.kick = kick_time;
  return outcome_;
}

}  // namespace weaveform
