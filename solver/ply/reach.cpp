#include "solver/ply/reach.hpp"

#include <algorithm>
#include <cmath>

namespace weaveform {
namespace {

// Above what was reached, so that a steadily growing strain renews the step every five per cent, not at every step.
constexpr double margin = 1.05;
constexpr double least_range = 1e-3;  // always allowed: below it no law of a fabric has stiffened
// Of the logarithmic shear strain, in which laws are of the fourth degree at most (stress: fifth): a tenth of stiffness.
constexpr double shear_margin = 1.03;
constexpr double least_shear = 0.5;  // logarithmic strain; 27 degrees, always allowed

StrainRange widened_range(const StrainRange& reached) {
  return {std::max(-torn_strain, std::min(margin * reached.least, -least_range)),
          std::min(torn_strain, std::max(margin * reached.greatest, least_range))};
}

// sin^2 gamma; sin gamma = tanh of the logarithmic strain.
double widened_shear(double sharpest) {
  const double strain = std::max(least_shear, shear_margin * std::atanh(std::min(std::sqrt(sharpest), 1.0 - 1e-12)));
  const double sine = std::tanh(strain);
  return sine * sine;
}

}  // namespace

Reach::Reach(bool fixed)
    : fixed_(fixed),
      allowed_(fixed ? every_strain : FamilyStrains{widened_range(StrainRange{}), widened_range(StrainRange{})}),
      allowed_sharpest_(widened_shear(0.0)) {}

bool Reach::passed_by(const FamilyStrains& now, double sharpest) {
  if (fixed_) return false;
  reached_sharpest_ = std::max(reached_sharpest_, sharpest);
  for (std::size_t f = 0; f < now.size(); ++f) reached_[f].hold(now[f]);
  return !allows(now, sharpest);
}

bool Reach::passed() const {
  return !fixed_ && !allows(reached_, reached_sharpest_);
}

bool Reach::allows(const FamilyStrains& strains, double sharpest) const {
  return allowed_[0].holds(strains[0]) && allowed_[1].holds(strains[1]) && sharpest <= allowed_sharpest_;
}

void Reach::renew() {
  if (fixed_) return;
  for (std::size_t f = 0; f < allowed_.size(); ++f) allowed_[f] = widened_range(reached_[f]);
  reached_ = {};
  allowed_sharpest_ = widened_shear(reached_sharpest_);
  reached_sharpest_ = 0.0;
}

void Reach::archive(Archive& archive) {
  constexpr double any_strain = 1e3;
  const auto range = [&](StrainRange& strains, double most) {
    archive.number("a strain", strains.least, {-most, 0.0});
    archive.number("a strain", strains.greatest, {0.0, most});
  };
  for (auto& family : allowed_) range(family, torn_strain);
  for (auto& family : reached_) range(family, any_strain);
  archive.number("a shear", allowed_sharpest_, {0.0, 1.0});
  archive.number("a shear", reached_sharpest_, {0.0, 1.0});
}

}  // namespace weaveform
