#include "mesher/scene/grip_direction.hpp"

#include <cmath>

namespace weaveform {

std::array<double, 3> grip_direction(const GripSpec& grip) {
  std::array<double, 3> direction = {0.0, 1.0, 0.0};
  if (grip.edge == BlankEdge::bottom) direction = {0.0, -1.0, 0.0};
  if (grip.edge == BlankEdge::left) direction = {-1.0, 0.0, 0.0};
  if (grip.edge == BlankEdge::right) direction = {1.0, 0.0, 0.0};
  if (grip.direction) direction = *grip.direction;
  const double length =
      std::sqrt(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2]);
  for (auto& component : direction) component /= length;
  return direction;
}

}  // namespace weaveform
