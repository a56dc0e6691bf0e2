#include "solver/ply/reach.hpp"

#include <algorithm>

namespace weaveform {
namespace {

// Above what was reached, so that a steadily growing strain renews the step every five per cent, not at every step.
constexpr double margin = 1.05;
constexpr double least_range = 1e-3;  // always allowed: below it no law of a fabric has stiffened

StrainRange widened(const StrainRange& reached) {
  return {std::max(-torn_strain, std::min(margin * reached.least, -least_range)),
          std::min(torn_strain, std::max(margin * reached.greatest, least_range))};
}

}  // namespace

Reach::Reach(bool fixed) : fixed_(fixed), allowed_(fixed ? every_strain : FamilyStrains{widened({}), widened({})}) {}

bool Reach::passed_by(const FamilyStrains& now) {
  if (fixed_) return false;
  for (std::size_t f = 0; f < now.size(); ++f) reached_[f].hold(now[f]);
  return !allowed_[0].holds(now[0]) || !allowed_[1].holds(now[1]);
}

void Reach::renew() {
  if (fixed_) return;
  for (std::size_t f = 0; f < allowed_.size(); ++f) allowed_[f] = widened(reached_[f]);
  reached_ = {};
}

void Reach::archive(Archive& archive) {
  constexpr double any_strain = 1e3;
  const auto range = [&](StrainRange& strains, double most) {
    archive.number("a strain", strains.least, {-most, 0.0});
    archive.number("a strain", strains.greatest, {0.0, most});
  };
  for (auto& family : allowed_) range(family, torn_strain);
  for (auto& family : reached_) range(family, any_strain);
}

}  // namespace weaveform
