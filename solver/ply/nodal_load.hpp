// Forces on nodes that somebody outside sets from step to step (python/bindings). Not part of any scene; a ply has one
// only once it was asked for.
#pragma once

#include "solver/state/actor.hpp"
#include "solver/state/packed.hpp"

namespace weaveform {

class NodalLoad : public Actor {
public:
  // `packed` must outlive the load.
  explicit NodalLoad(const PackedMesh& packed);
  [[nodiscard]] std::string name() const override { return "load from outside"; }
  // N; per node of the mesh that is solved, in its order. What it holds when forces are computed acts in the step that
  // follows. Its place in memory stays.
  [[nodiscard]] std::vector<Vec3>& force() { return force_; }
  void add_forces(State& state, double step) override;
  // mJ; the work of the forces: from one step to the next, mean force times way.
  [[nodiscard]] EnergyFlow energy_flow() const override { return {.put_in = work_}; }
  void archive(Archive& archive) override;

private:
  const PackedMesh& packed_;
  std::vector<Vec3> force_, force_before_;  // N
  std::vector<Vec3> position_before_;       // mm
  bool acted_ = false;
  double work_ = 0.0;  // mJ
};

}  // namespace weaveform
