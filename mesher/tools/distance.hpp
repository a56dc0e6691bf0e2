// Signed distance to rigid tools, for a few points at a time. A tool does not turn: its place is an origin that may
// move and a fixed axis. All analytic tools are solids of revolution about that axis; with z along the axis and r the
// distance from it (Placement::origin is r = z = 0):
//   plane     distance = z                                           material below
//   sphere    distance = |(r, min(z, 0))| - R                        with a shank of the same radius up the axis
//   cylinder  distance = r - R                                       endless both ways
//   ring      with u = a + f - r, w = z + f:  |max((u, w), 0)| - f + min(max(u, w), 0)
//             the plate z < 0 outside the opening of radius a, its rim rounded with the fillet f
//   revolved  nearest point of a profile of lines and arcs (profile.hpp)
#pragma once

#include <array>

#include "mesher/tools/profile.hpp"

namespace weaveform {

struct Placement {
  std::array<double, 3> origin = {0.0, 0.0, 0.0};  // mm
  std::array<double, 3> axis = {0.0, 0.0, 1.0};    // unit
};

// Points measured at a time: a few vector registers of each quantity, all within the first cache.
inline constexpr int points_at_a_time = 64;

struct Distances {
  double distance[points_at_a_time];   // mm; from the tool's surface, negative inside
  double normal[3][points_at_a_time];  // unit; outward. The nearest point of the surface is x - distance * normal
};

// `count` <= points_at_a_time points with coordinates x[0..2][n].
using Coordinates = std::array<const double*, 3>;
void plane_distances(const Placement& place, const Coordinates& x, int count, Distances& out);
void sphere_distances(const Placement& place, double radius, const Coordinates& x, int count, Distances& out);
void cylinder_distances(const Placement& place, double radius, const Coordinates& x, int count, Distances& out);
void ring_distances(const Placement& place, double opening_radius, double fillet_radius, const Coordinates& x,
                    int count, Distances& out);
void revolved_distances(const Placement& place, const Profile& profile, const Coordinates& x, int count,
                        Distances& out);

// One compilation of the functions above (core/instructions/choose_loops.hpp).
struct DistanceLoops {
  decltype(&weaveform::plane_distances) plane_distances;
  decltype(&weaveform::sphere_distances) sphere_distances;
  decltype(&weaveform::cylinder_distances) cylinder_distances;
  decltype(&weaveform::ring_distances) ring_distances;
  decltype(&weaveform::revolved_distances) revolved_distances;
};

}  // namespace weaveform
