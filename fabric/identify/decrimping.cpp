#include "fabric/identify/decrimping.hpp"

#include <cmath>
#include <limits>

namespace weaveform::identify {

std::vector<TangentPiece> decrimping_law(double linear_modulus, double crimp) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!(crimp > 0.0)) return {{0.0, infinity, {linear_modulus}}};
  const double straight = std::log1p(crimp);                      // e0
  const double joint = 4.0 / 3.0 * straight;                      // e1
  const double cubic = linear_modulus / (joint * joint * joint);  // 4 a, MPa
  return {{0.0, joint, {0.0, 0.0, 0.0, cubic}}, {joint, infinity, {linear_modulus}}};
}

}  // namespace weaveform::identify
