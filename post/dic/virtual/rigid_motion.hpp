// A motion of the plane without change of shape: from the measurement onto the blank.
#pragma once

#include <cmath>

#include "post/dic/virtual/flat_mesh.hpp"

namespace weaveform::dic {

// blank = R(angle) measurement + shift
struct RigidMotion {
  double angle = 0.0;  // rad
  Vec2 shift = {0.0, 0.0};
  [[nodiscard]] Vec2 turned(const Vec2& p) const {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * p[0] - s * p[1], s * p[0] + c * p[1]};
  }
  [[nodiscard]] Vec2 moved(const Vec2& p) const {
    const Vec2 t = turned(p);
    return {t[0] + shift[0], t[1] + shift[1]};
  }
};

}  // namespace weaveform::dic
