// The fabric's weight: m g on every node.
#pragma once

#include "solver/state/force_term.hpp"
#include "solver/state/packed.hpp"

namespace weaveform {

class Gravity : public ForceTerm {
public:
  // `acceleration` in mm/s^2, world frame.
  Gravity(const PackedMesh& packed, const State& start, const Vec3& acceleration);
  [[nodiscard]] std::string name() const override { return "gravity"; }
  void add_forces(State& state, double step) override;
  // mJ; the work of the weight is that of an outside force: m g . (x - x at the start).
  [[nodiscard]] double external_work() const override { return work_; }
  [[nodiscard]] std::vector<double> memory() const override { return {work_}; }
  void recall(const std::vector<double>& memory) override { work_ = memory[0]; }

private:
  Vec3 acceleration_;
  std::vector<double> mass_;  // tonne; 0 where no node is
  Vec3 start_moment_;         // tonne mm; sum of m x at the start
  double work_ = 0.0;         // mJ
};

}  // namespace weaveform
