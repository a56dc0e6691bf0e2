// The fabric's weight: m g on every node.
#pragma once

#include "solver/state/actor.hpp"
#include "solver/state/packed.hpp"

namespace weaveform {

class Gravity : public Actor {
public:
  // `acceleration` in mm/s^2, world frame.
  Gravity(const PackedMesh& packed, const State& start, const Vec3& acceleration);
  [[nodiscard]] std::string name() const override { return "gravity"; }
  void add_forces(State& state, double step) override;
  // mJ; the work of the weight is that of an outside force: m g . (x - x at the start).
  [[nodiscard]] EnergyFlow energy_flow() const override { return {.put_in = work_}; }
  void archive(Archive& archive) override { archive.number("the weight's work", work_); }

private:
  Vec3 acceleration_;
  std::vector<double> mass_;  // tonne; 0 where no node is
  Vec3 start_moment_;         // tonne mm; sum of m x at the start
  double work_ = 0.0;         // mJ
};

}  // namespace weaveform
