// The analytic loops; compiled for the machine's own instruction set, so this file includes nothing whose inline code
// other files share.
#include "mesher/tools/distance.hpp"

#include <cmath>

namespace weaveform {
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

// Least of `count` values.
double least(const double (&values)[points_at_a_time], int count) {
  constexpr int lanes = 8;
  double lane[lanes];
  for (int l = 0; l < lanes; ++l) lane[l] = values[0];
  int n = 0;
  for (; n + lanes <= count; n += lanes)
    for (int l = 0; l < lanes; ++l) lane[l] = lane[l] < values[n + l] ? lane[l] : values[n + l];
  double result = values[0];
  for (; n < count; ++n) result = result < values[n] ? result : values[n];
  for (int l = 0; l < lanes; ++l) result = result < lane[l] ? result : lane[l];
  return result;
}

// Whether the plate's face is nearest to all points: out of the fillet's reach, and not so deep that the opening's wall
// is nearer.
bool face_is_nearest(const Placement& place, double opening_radius, double fillet_radius, const Coordinates& x,
                     int count) {
  double square[points_at_a_time], height[points_at_a_time];
  for (int n = 0; n < count; ++n) {
    const double dx = x[0][n] - place.origin[0], dy = x[1][n] - place.origin[1], dz = x[2][n] - place.origin[2];
    height[n] = dx * place.axis[0] + dy * place.axis[1] + dz * place.axis[2];
    square[n] = dx * dx + dy * dy + dz * dz - height[n] * height[n];
  }
  const double deepest = -least(height, count);
  const double radius = opening_radius + (deepest > fillet_radius ? deepest : fillet_radius);
  return least(square, count) >= radius * radius;
}

}  // namespace

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
  // most blocks of a blank lie on the plate, where roots and quotients can be spared
  if (face_is_nearest(place, a, f, x, count)) return plane_distances(place, x, count, out);
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
    return HalfPlane{size - f + deep, normal_r * inverse_r, normal_z};
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

}  // namespace weaveform
