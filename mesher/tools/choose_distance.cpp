#include "core/instructions/choose_loops.hpp"
#include "mesher/tools/distance.hpp"

namespace weaveform {

WEAVEFORM_CHOOSE_LOOPS(DistanceLoops, distance_loops)

void plane_distances(const Placement& place, const Coordinates& x, int count, Distances& out) {
  chosen_distance_loops().plane_distances(place, x, count, out);
}

void sphere_distances(const Placement& place, double radius, const Coordinates& x, int count, Distances& out) {
  chosen_distance_loops().sphere_distances(place, radius, x, count, out);
}

void cylinder_distances(const Placement& place, double radius, const Coordinates& x, int count, Distances& out) {
  chosen_distance_loops().cylinder_distances(place, radius, x, count, out);
}

void ring_distances(const Placement& place, double opening_radius, double fillet_radius, const Coordinates& x,
                    int count, Distances& out) {
  chosen_distance_loops().ring_distances(place, opening_radius, fillet_radius, x, count, out);
}

void revolved_distances(const Placement& place, const Profile& profile, const Coordinates& x, int count,
                        Distances& out) {
  chosen_distance_loops().revolved_distances(place, profile, x, count, out);
}

}  // namespace weaveform
