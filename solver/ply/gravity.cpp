#include "solver/ply/gravity.hpp"

namespace weaveform {
namespace {

Vec3 mass_moment(const std::vector<double>& mass, const State& state) {
  Vec3 moment = {0.0, 0.0, 0.0};
  for (int c = 0; c < 3; ++c)
    for (std::size_t n = 0; n < mass.size(); ++n) moment[c] += mass[n] * state.position[c][n];
  return moment;
}

}  // namespace

Gravity::Gravity(const PackedMesh& packed, const State& start, const Vec3& acceleration)
    : acceleration_(acceleration), mass_(packed.nodes, 0.0) {
  for (const int n : packed.packed_of_mesh) mass_[n] = packed.mass[n];
  start_moment_ = mass_moment(mass_, start);
}

void Gravity::add_forces(State& state, double /*step*/) {
  for (int c = 0; c < 3; ++c)
    for (std::size_t n = 0; n < mass_.size(); ++n) state.force[c][n] += mass_[n] * acceleration_[c];
  const Vec3 moment = mass_moment(mass_, state);
  work_ = 0.0;
  for (int c = 0; c < 3; ++c) work_ += acceleration_[c] * (moment[c] - start_moment_[c]);
}

}  // namespace weaveform
