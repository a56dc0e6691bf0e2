// The energy balance of a run: internal + kinetic + damping work - external work keeps its start value.
#pragma once

#include <algorithm>
#include <cmath>

namespace weaveform {

struct EnergyBalance {
  double internal = 0.0;          // mJ; stored in the fabric
  double kinetic = 0.0;           // mJ
  double damping = 0.0;           // mJ; work lost to damping, viscosity and friction
  double external = 0.0;          // mJ; work done by the grips and tools
  double bending = 0.0;           // mJ; part of internal
  double hourglass = 0.0;         // mJ; part of bending that one point per cell would not see
  double bending_friction = 0.0;  // mJ; part of damping
  double start = 0.0;             // mJ; internal energy at time 0
  double greatest = 0.0;          // mJ; greatest of the first four so far

  void note_greatest() {
    greatest = std::max({greatest, std::abs(internal), kinetic, damping, std::abs(external), std::abs(start)});
  }
  // Relative to the greatest energy so far.
  [[nodiscard]] double error() const {
    return greatest > 0.0 ? std::abs(internal + kinetic + damping - external - start) / greatest : 0.0;
  }
};

}  // namespace weaveform
