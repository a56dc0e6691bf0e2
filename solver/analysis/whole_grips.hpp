// The scene's grips as they hold all plies of a world: one may hold several, and what it feels is what all of them do.
#pragma once

#include <vector>

#include "solver/analysis/world.hpp"

namespace weaveform {

class WholeGrips {
public:
  // In the order in which the plies' grips come, each once.
  explicit WholeGrips(const World& world);

  [[nodiscard]] const std::vector<Grip>& grips() const { return grips_; }  // names and motions; nodes of one ply
  // mm; per grip.
  [[nodiscard]] const std::vector<double>& displacements(const World& world);
  // N; per grip, along its motion, of the whole.
  [[nodiscard]] const std::vector<double>& forces(World& world);

private:
  std::vector<Grip> grips_;
  std::vector<std::vector<std::size_t>> number_;  // per ply: of each of its grips
  std::vector<double> displacement_, force_;
};

}  // namespace weaveform
