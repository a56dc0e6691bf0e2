#include "mesher/tools/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/keys/key_value.hpp"
#include "core/vector/vector.hpp"

namespace weaveform {
namespace {

constexpr double same_point = 1e-9;  // mm; two corners closer than this are one

Vec2 along(const Vec2& point, const Vec2& direction, double way) {
  return plus(point, scaled(direction, way));
}

ProfilePiece line(const Vec2& start, const Vec2& end) {
  const Vec2 way = minus(end, start);
  const double size = plain_length(way);
  const Vec2 normal = {way[1] / size, -way[0] / size};
  return {.start = start, .end = end, .start_normal = normal, .end_normal = normal};
}

ProfilePiece arc(const Vec2& start, const Vec2& end, const Vec2& centre) {
  // turning left keeps the centre in the material
  const double side = cross(minus(start, centre), minus(end, centre)) > 0.0 ? 1.0 : -1.0;
  const double radius = 0.5 * (plain_length(minus(start, centre)) + plain_length(minus(end, centre)));
  const auto normal = [&](const Vec2& p) {
    const Vec2 out = minus(p, centre);
    return Vec2{side * out[0] / plain_length(out), side * out[1] / plain_length(out)};
  };
  return {.start = start,
          .end = end,
          .start_normal = normal(start),
          .end_normal = normal(end),
          .centre = centre,
          .radius = side * radius};
}

// The rounded corner between the lines before -> corner -> after, or nothing when it has no turn.
ProfilePiece rounding(const Vec2& before, const Vec2& corner, const Vec2& after, double radius,
                      const std::string& name) {
  const Vec2 in = minus(corner, before), out = minus(after, corner);
  const double in_length = plain_length(in), out_length = plain_length(out);
  const Vec2 u = divided(in, in_length), v = divided(out, out_length);
  const double turn = std::atan2(cross(u, v), dot(u, v));
  const double tangent = radius * std::tan(0.5 * std::abs(turn));
  const double room = std::min(in_length, out_length);
  if (!(tangent <= room * (1.0 + 1e-9)) || turn == 0.0)
    throw InputError(fmt::format(
        "{}: a radius of {} mm needs straight sides of {:.4g} mm (there are {:.4g}); make the radius smaller", name,
        radius, tangent, room));
  const Vec2 start = along(corner, u, -tangent), end = along(corner, v, tangent);
  const Vec2 left = {-u[1], u[0]};
  return arc(start, end, along(start, left, turn > 0.0 ? radius : -radius));
}

void check_corner(const std::vector<double>& corner, bool at_end, const std::string& name) {
  if (corner.size() < 2 || corner.size() > 4)
    throw InputError(name + ": write [r, z], [r, z, radius] or [r, z, centre_r, centre_z]");
  for (const double x : corner)
    if (!(std::abs(x) <= greatest_length))
      throw InputError(fmt::format("{}: {} is no length within {:g} mm", name, x, greatest_length));
  if (corner[0] < 0.0) throw InputError(fmt::format("{}: r is {}; it must not be negative", name, corner[0]));
  if (corner.size() == 3 && (corner[2] <= 0.0 || at_end))
    throw InputError(name + ": a rounded corner needs a radius above 0 and a line on either side");
}

void append_line(Profile& profile, const Vec2& start, const Vec2& end) {
  if (plain_length(minus(end, start)) > same_point) profile.piece.push_back(line(start, end));
}

void append_arc(Profile& profile, const Vec2& start, const std::vector<double>& corner, const std::string& name) {
  const Vec2 end = {corner[0], corner[1]}, centre = {corner[2], corner[3]};
  const double first = plain_length(minus(start, centre)), second = plain_length(minus(end, centre));
  if (!(std::abs(first - second) <= 1e-6 * first) || first <= same_point)
    throw InputError(fmt::format("{}: its centre is {:.8g} mm from the start of the arc and {:.8g} mm from its end",
                                 name, first, second));
  if (std::abs(cross(minus(start, centre), minus(end, centre))) < 1e-9 * first * first)
    throw InputError(name + ": the arc spans half a turn or nothing; put a corner in between");
  profile.piece.push_back(arc(start, end, centre));
}

// Squared distance of p from a piece; `nearest` and `normal` of the nearest point of it.
double nearest_on(const ProfilePiece& piece, const Vec2& p, Vec2& nearest, Vec2& normal) {
  if (piece.radius == 0.0) {
    const Vec2 way = minus(piece.end, piece.start);
    double t = dot(minus(p, piece.start), way) / dot(way, way);
    if (!piece.endless[0]) t = std::max(t, 0.0);
    if (!piece.endless[1]) t = std::min(t, 1.0);
    nearest = t == 1.0 ? piece.end : along(piece.start, way, t);
    normal = piece.start_normal;
  } else {
    const double side = piece.radius > 0.0 ? 1.0 : -1.0;
    const Vec2 out = minus(p, piece.centre);
    const double size = plain_length(out);
    const bool after_start = side * cross(minus(piece.start, piece.centre), out) >= 0.0;
    const bool before_end = side * cross(out, minus(piece.end, piece.centre)) >= 0.0;
    if (after_start && before_end && size > 0.0) {
      nearest = along(piece.centre, out, std::abs(piece.radius) / size);
      normal = {side * out[0] / size, side * out[1] / size};
    } else {
      const Vec2 to_start = minus(p, piece.start), to_end = minus(p, piece.end);
      const bool start_nearer = dot(to_start, to_start) <= dot(to_end, to_end);
      nearest = start_nearer ? piece.start : piece.end;
      normal = start_nearer ? piece.start_normal : piece.end_normal;
    }
  }
  const Vec2 off = minus(p, nearest);
  return dot(off, off);
}

// At a corner the sign comes from both pieces' normals together (the pseudo-normal of Baerentzen and Aanaes, 2005).
Vec2 normal_at_corner(const Profile& profile, const Vec2& corner, const Vec2& normal) {
  Vec2 sum = {0.0, 0.0};
  for (const auto& piece : profile.piece) {
    for (const auto& [point, its_normal] : {std::pair(piece.start, piece.start_normal), {piece.end, piece.end_normal}})
      if (plain_length(minus(point, corner)) <= same_point) sum = along(sum, its_normal, 1.0);
  }
  const double size = plain_length(sum);
  return size > 0.0 ? divided(sum, size) : normal;
}

}  // namespace

Profile make_profile(const std::vector<std::vector<double>>& corners, const std::string& where) {
  if (corners.size() < 2) throw InputError(where + ": an outline needs two corners or more");
  const auto name = [&](std::size_t n) { return fmt::format("{}: corner {}", where, n + 1); };
  const auto point = [&](std::size_t n) { return Vec2{corners[n][0], corners[n][1]}; };
  for (std::size_t n = 0; n < corners.size(); ++n) check_corner(corners[n], n == 0 || n + 1 == corners.size(), name(n));

  Profile profile;
  Vec2 at = point(0);
  for (std::size_t n = 1; n < corners.size(); ++n) {
    if (plain_length(minus(point(n), point(n - 1))) <= same_point)
      throw InputError(name(n) + " is the corner before it once more");
    if (corners[n].size() == 4) {
      append_arc(profile, at, corners[n], name(n));
      at = point(n);
    } else if (corners[n].size() == 3) {
      if (corners[n + 1].size() == 4) throw InputError(name(n) + ": no rounding next to an arc; draw it as an arc");
      const ProfilePiece round = rounding(at, point(n), point(n + 1), corners[n][2], name(n));
      append_line(profile, at, round.start);
      profile.piece.push_back(round);
      at = round.end;
    } else {
      append_line(profile, at, point(n));
      at = point(n);
    }
  }
  auto &first = profile.piece.front(), &last = profile.piece.back();
  if ((first.radius != 0.0 && first.start[0] > same_point) || (last.radius != 0.0 && last.end[0] > same_point))
    throw InputError(where +
                     ": the outline ends on an arc; begin and end it on the axis or with a line, which goes on");
  first.endless[0] = first.radius == 0.0 && first.start[0] > same_point;
  last.endless[1] = last.radius == 0.0 && last.end[0] > same_point;
  return profile;
}

ProfileDistance profile_distance(const Profile& profile, double r, double z) noexcept {
  const Vec2 p = {r, z};
  double least = std::numeric_limits<double>::infinity();
  Vec2 nearest = p, normal = {0.0, 1.0};
  const ProfilePiece* owner = nullptr;
  for (const auto& piece : profile.piece) {
    Vec2 candidate, candidate_normal;
    const double square = nearest_on(piece, p, candidate, candidate_normal);
    if (square >= least) continue;
    least = square;
    nearest = candidate;
    normal = candidate_normal;
    owner = &piece;
  }
  const bool at_start = plain_length(minus(nearest, owner->start)) <= same_point && !owner->endless[0];
  const bool at_end = plain_length(minus(nearest, owner->end)) <= same_point && !owner->endless[1];
  if (at_start || at_end) normal = normal_at_corner(profile, nearest, normal);
  const Vec2 off = minus(p, nearest);
  const double size = plain_length(off);
  if (size <= same_point) return {dot(off, normal), normal[0], normal[1]};
  const double side = dot(off, normal) >= 0.0 ? 1.0 : -1.0;
  return {side * size, side * off[0] / size, side * off[1] / size};
}

}  // namespace weaveform
