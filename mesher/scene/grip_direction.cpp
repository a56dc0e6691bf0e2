#include "mesher/scene/grip_direction.hpp"

#include <cmath>

#include "core/vector/vector.hpp"

namespace weaveform {

std::array<double, 3> grip_direction(const GripSpec& grip) {
  std::array<double, 3> direction = {0.0, 1.0, 0.0};
  if (grip.edge == BlankEdge::bottom) direction = {0.0, -1.0, 0.0};
  if (grip.edge == BlankEdge::left) direction = {-1.0, 0.0, 0.0};
  if (grip.edge == BlankEdge::right) direction = {1.0, 0.0, 0.0};
  if (grip.direction) direction = *grip.direction;
  return divided(direction, plain_length(direction));
}

}  // namespace weaveform
