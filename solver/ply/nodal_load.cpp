#include "solver/ply/nodal_load.hpp"

namespace weaveform {

NodalLoad::NodalLoad(const PackedMesh& packed)
    : packed_(packed),
      force_(packed.packed_of_mesh.size(), Vec3{0.0, 0.0, 0.0}),
      force_before_(force_),
      position_before_(force_) {}

void NodalLoad::add_forces(State& state, double /*step*/) {
  for (std::size_t n = 0; n < force_.size(); ++n) {
    const int at = packed_.packed_of_mesh[n];
    for (int c = 0; c < 3; ++c) {
      const double now = state.position[c][at];
      if (acted_) work_ += 0.5 * (force_before_[n][c] + force_[n][c]) * (now - position_before_[n][c]);
      state.force[c][at] += force_[n][c];
      position_before_[n][c] = now;
    }
  }
  force_before_ = force_;
  acted_ = true;
}

void NodalLoad::archive(Archive& archive) {
  for (auto* vectors : {&force_, &force_before_, &position_before_})
    for (Vec3& vector : *vectors)
      for (double& component : vector) archive.number("a load from outside", component);
  std::int64_t acted = acted_ ? 1 : 0;
  archive.count("whether a load acted", acted, 0, 1);
  acted_ = acted != 0;
  archive.number("the work of a load", work_);
}

}  // namespace weaveform
