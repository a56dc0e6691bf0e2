#include "solver/analysis/whole_grips.hpp"

#include <algorithm>

namespace weaveform {

WholeGrips::WholeGrips(const World& world) {
  for (std::size_t k = 0; k < world.size(); ++k) {
    auto& numbers = number_.emplace_back();
    for (const Grip& grip : world.ply(k).holds().grips()) {
      const auto known =
          std::find_if(grips_.begin(), grips_.end(), [&](const Grip& other) { return other.name == grip.name; });
      numbers.push_back(static_cast<std::size_t>(known - grips_.begin()));
      if (known == grips_.end()) grips_.push_back(grip);
    }
  }
  displacement_.resize(grips_.size());
  force_.resize(grips_.size());
}

const std::vector<double>& WholeGrips::displacements(const World& world) {
  for (std::size_t k = 0; k < number_.size(); ++k)
    for (std::size_t g = 0; g < number_[k].size(); ++g)
      displacement_[number_[k][g]] = world.ply(k).holds().displacement()[g];
  return displacement_;
}

// Of one ply they are its own, to the bit.
const std::vector<double>& WholeGrips::forces(World& world) {
  if (world.size() == 1) return world.ply(0).holds().whole_forces();
  std::fill(force_.begin(), force_.end(), 0.0);
  for (std::size_t k = 0; k < number_.size(); ++k) {
    const auto& own = world.ply(k).holds().whole_forces();
    for (std::size_t g = 0; g < own.size(); ++g) force_[number_[k][g]] += own[g];
  }
  return force_;
}

}  // namespace weaveform
