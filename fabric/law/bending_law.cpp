#include "fabric/law/bending_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weaveform {
namespace {

TangentLaw half_with_constant(const TangentLaw& law, double stiffness) {
  auto pieces = law.pieces();
  if (pieces.empty()) return TangentLaw({{0.0, std::numeric_limits<double>::infinity(), {stiffness}}});
  for (auto& piece : pieces) piece.coefficient[0] += stiffness;
  return TangentLaw(std::move(pieces));
}

}  // namespace

double BendingLaw::moment(double curvature) const {
  return curvature < 0.0 ? -back_.stress(-curvature) : face_.stress(curvature);
}

double BendingLaw::energy(double curvature) const {
  return curvature < 0.0 ? back_.energy(-curvature) : face_.energy(curvature);
}

double BendingLaw::stiffest(double greatest) const {
  return std::max(face_.stiffest(0.0, greatest), back_.stiffest(0.0, greatest));
}

double BendingLaw::first_stiffness() const {
  return 0.5 * (face_.tangent(0.0) + back_.tangent(0.0));
}

double BendingLaw::mean_secant(double curvature) const {
  return 0.5 * (face_.stress(curvature) + back_.stress(curvature)) / curvature;
}

BendingLaw with_constant(const BendingLaw& law, double stiffness) {
  if (law.is_odd()) return half_with_constant(law.face(), stiffness);
  return {half_with_constant(law.face(), stiffness), half_with_constant(law.back(), stiffness)};
}

}  // namespace weaveform
