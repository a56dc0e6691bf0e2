// The outline of a tool of revolution: lines and arcs in the half-plane (r, z), r >= 0 the distance from the tool's
// axis and z along it. Seen along the outline, the tool's material is on the left, so the outward normal of a piece
// with direction (dr, dz) is (dz, -dr). The first and the last piece, when lines, go on for ever beyond an end off the
// axis.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace weaveform {

struct ProfilePiece {
  std::array<double, 2> start = {0.0, 0.0}, end = {0.0, 0.0};                // mm
  std::array<double, 2> start_normal = {0.0, 0.0}, end_normal = {0.0, 0.0};  // unit; outward
  std::array<double, 2> centre = {0.0, 0.0};                                 // mm; of an arc
  double radius = 0.0;   // mm; of an arc: > 0 bulging outward (centre in the material), < 0 hollow; 0 for a line
  bool endless[2] = {};  // a line that goes on beyond its start, its end
};

struct Profile {
  std::vector<ProfilePiece> piece;
};

// From the corners of the outline. A corner is
//   [r, z]          a straight line leads here from the corner before
//   [r, z, radius]  the same, and the corner itself is rounded with that radius (mm)
//   [r, z, cr, cz]  an arc about the centre (cr, cz), the shorter way, leads here from the corner before
// Throws InputError, beginning with `where`, when the corners do not make an outline.
[[nodiscard]] Profile make_profile(const std::vector<std::vector<double>>& corners, const std::string& where);

struct ProfileDistance {
  double distance;            // mm; negative inside the material
  double normal_r, normal_z;  // unit; outward, from the nearest point
};
// Exact; at equal distance the earlier piece counts.
[[nodiscard]] ProfileDistance profile_distance(const Profile& profile, double r, double z) noexcept;

}  // namespace weaveform
