// The analytic loops; compiled once for each instruction set (core/instructions), so this file includes nothing whose
// inline code other files share.
#include "mesher/tools/distance.hpp"

#include <cmath>

namespace weaveform::WEAVEFORM_SET {
namespace {

// Distance and normal in the half-plane; the normal's radial part as n_r / r, so that it needs no direction at r = 0.
struct HalfPlane {
  double distance, normal_r_by_r, normal_z;
};

template <class Meridian>
[[gnu::always_inline]] inline void measure(const Placement& place, const Coordinates& x, int count, Distances& out,
                                           const Meridian& meridian) {
  const double ox = place.origin[0], oy = place.origin[1], oz = place.origin[2];
  const double ax = place.axis[0], ay = place.axis[1], az = place.axis[2];
  const double *px = x[0], *py = x[1], *pz = x[2];
#pragma omp simd
  for (int n = 0; n < count; ++n) {
    const double dx = px[n] - ox, dy = py[n] - oy, dz = pz[n] - oz;
    const double z = dx * ax + dy * ay + dz * az;
    const double rx = dx - z * ax, ry = dy - z * ay, rz = dz - z * az;
    const HalfPlane q = meridian(rx * rx + ry * ry + rz * rz, z);
    out.distance[n] = q.distance;
    out.normal[0][n] = q.normal_r_by_r * rx + q.normal_z * ax;
    out.normal[1][n] = q.normal_r_by_r * ry + q.normal_z * ay;
    out.normal[2][n] = q.normal_r_by_r * rz + q.normal_z * az;
  }
}

constexpr double tiny = 1e-300;  // keeps 0/0 out; mm or mm^2

// mm; the radius from which a point at z is nearest to the plate's face, and not to fillet or wall.
[[gnu::always_inline]] inline double face_from(double opening_radius, double fillet_radius, double z) {
  return opening_radius + (-z > fillet_radius ? -z : fillet_radius);
}

// Fills in the distances from the plate's face; true when nothing nearer is near: all points are out of the fillet's
// reach, and none so deep that the opening's wall is nearer. So it is for most blocks of a blank, and roots and
// quotients are spared. A point's numbers are those that it has among others: who is looked at with whom does not show.
bool face_distances(const Placement& place, double opening_radius, double fillet_radius, const Coordinates& x,
                    int count, Distances& out) {
  const double ox = place.origin[0], oy = place.origin[1], oz = place.origin[2];
  const double ax = place.axis[0], ay = place.axis[1], az = place.axis[2];
  const double *px = x[0], *py = x[1], *pz = x[2];
  double lowest = 1e300, least_square = 1e300;  // mm, mm^2
#pragma omp simd reduction(min : lowest, least_square)
  for (int n = 0; n < count; ++n) {
    const double dx = px[n] - ox, dy = py[n] - oy, dz = pz[n] - oz;
    const double z = dx * ax + dy * ay + dz * az;
    const double rx = dx - z * ax, ry = dy - z * ay, rz = dz - z * az, square = rx * rx + ry * ry + rz * rz;
    out.distance[n] = z;
    out.normal[0][n] = ax;
    out.normal[1][n] = ay;
    out.normal[2][n] = az;
    lowest = z < lowest ? z : lowest;
    least_square = square < least_square ? square : least_square;
  }
  const double radius = face_from(opening_radius, fillet_radius, lowest);
  return least_square >= radius * radius;
}

void plane_distances(const Placement& place, const Coordinates& x, int count, Distances& out) {
  measure(place, x, count, out, [](double /*r2*/, double z) { return HalfPlane{z, 0.0, 1.0}; });
}

void sphere_distances(const Placement& place, double radius, const Coordinates& x, int count, Distances& out) {
  measure(place, x, count, out, [radius](double r2, double z) {
    const double below = z < 0.0 ? z : 0.0;
    const double size = std::sqrt(r2 + below * below), inverse = 1.0 / (size > tiny ? size : tiny);
    return HalfPlane{size - radius, inverse, below * inverse};
  });
}

void cylinder_distances(const Placement& place, double radius, const Coordinates& x, int count, Distances& out) {
  measure(place, x, count, out, [radius](double r2, double /*z*/) {
    const double r = std::sqrt(r2);
    return HalfPlane{r - radius, 1.0 / (r > tiny ? r : tiny), 0.0};
  });
}

void ring_distances(const Placement& place, double opening_radius, double fillet_radius, const Coordinates& x,
                    int count, Distances& out) {
  const double f = fillet_radius, a = opening_radius;
  if (face_distances(place, a, f, x, count, out)) return;
  measure(place, x, count, out, [a, f](double r2, double z) {
    const double r = std::sqrt(r2), inverse_r = 1.0 / (r > tiny ? r : tiny);
    const double u = a + f - r, w = z + f;
    const double pu = u > 0.0 ? u : 0.0, pw = w > 0.0 ? w : 0.0;
    const double size = std::sqrt(pu * pu + pw * pw), inverse = 1.0 / (size > tiny ? size : tiny);
    const double greater = u > w ? u : w, deep = greater < 0.0 ? greater : 0.0;
    // inside the fillet's quadrant the nearer of the two faces
    const double face_r = u > w ? -1.0 : 0.0, face_z = u > w ? 0.0 : 1.0;
    const double normal_r = greater > 0.0 ? -pu * inverse : face_r;
    const double normal_z = greater > 0.0 ? pw * inverse : face_z;
    const double from = face_from(a, f, z);
    const bool on_face = r2 >= from * from;
    return HalfPlane{on_face ? z : size - f + deep, on_face ? 0.0 : normal_r * inverse_r, on_face ? 1.0 : normal_z};
  });
}

void revolved_distances(const Placement& place, const Profile& profile, const Coordinates& x, int count,
                        Distances& out) {
  measure(place, x, count, out, [&profile](double r2, double z) {
    const double r = std::sqrt(r2);
    const ProfileDistance q = profile_distance(profile, r, z);
    return HalfPlane{q.distance, q.normal_r / (r > tiny ? r : tiny), q.normal_z};
  });
}

}  // namespace

extern const DistanceLoops distance_loops;
const DistanceLoops distance_loops = {.plane_distances = plane_distances,
                                      .sphere_distances = sphere_distances,
                                      .cylinder_distances = cylinder_distances,
                                      .ring_distances = ring_distances,
                                      .revolved_distances = revolved_distances};

}  // namespace weaveform::WEAVEFORM_SET
