#include "fabric/identify/cantilever_profiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/vector/angle.hpp"
#include "fabric/identify/curve.hpp"
#include "fabric/identify/hanging_strip.hpp"

namespace weaveform::identify {
namespace {

// A profile in order from the clamp to the tip, x outwards, y up, from its first point on.
struct Profile {
  std::string name;
  std::vector<std::array<double, 2>> point;
  double length = 0.0;    // mm; along the strip
  double overhang = 0.0;  // mm; given, or the length
  std::vector<std::string> notes;
};

constexpr std::array<double, 2> plausible_overhang = {10.0, 3000.0};  // mm; of overhangs
constexpr double same_length = 0.1;                                   // between an overhang and its profile's length
constexpr double least_drop = 0.01;                                   // of the length

double angle_between(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  return std::atan2(a[1] - b[1], b[0] - a[0]);  // below the horizontal
}

std::array<double, 2> mean_point(const std::vector<std::array<double, 2>>& points, std::size_t from, std::size_t to) {
  std::array<double, 2> mean = {0.0, 0.0};
  for (std::size_t i = from; i < to; ++i)
    for (int c = 0; c < 2; ++c) mean[c] += points[i][c] / static_cast<double>(to - from);
  return mean;
}

// Rows in no order along the strip make a way many times its length.
void put_in_order(Profile& profile) {
  auto sorted = profile.point;
  std::sort(sorted.begin(), sorted.end());
  if (polyline_length(profile.point) < 4.0 * polyline_length(sorted)) return;
  profile.point = std::move(sorted);
  profile.notes.emplace_back("rows were not in order along the strip; sorted by x");
}

// From the clamp, the higher end, outwards.
void turn_to_tip(Profile& profile) {
  auto& point = profile.point;
  const std::size_t few = std::max<std::size_t>(1, point.size() / 20);
  const auto first = mean_point(point, 0, few), last = mean_point(point, point.size() - few, point.size());
  const double size = std::hypot(first[0] - last[0], first[1] - last[1]);
  if (!(std::abs(first[1] - last[1]) > least_drop * size))
    throw InputError(
        fmt::format("{}: both ends of the profile are at the same height, to {:.2g} mm; it is no strip that "
                    "hangs from a clamp, or x_column and y_column are exchanged",
                    profile.name, std::abs(first[1] - last[1])));
  if (first[1] < last[1]) {
    std::reverse(point.begin(), point.end());
    profile.notes.emplace_back("rows ran from the tip to the clamp; turned round");
  }
  const bool mirrored = point.back()[0] < point.front()[0];
  if (!mirrored) return;
  for (auto& at : point) at[0] = -at[0];
  profile.notes.emplace_back("the strip hangs towards negative x; mirrored");
}

// What lies in the jaws: beyond the overhang where it is given, else at x below zero.
void cut_jaws(Profile& profile, double given) {
  auto& point = profile.point;
  const double whole = polyline_length(thinned(point));
  std::size_t kept = 0;
  if (given > 0.0) {
    while (kept + 2 < point.size() && polyline_length(thinned({point.begin() + static_cast<std::ptrdiff_t>(kept),
                                                               point.end()})) > (1.0 + 0.002) * given)
      ++kept;
  } else {
    while (kept + 2 < point.size() && point[kept][0] < -1e-3 * whole) ++kept;
    // level, as in jaws; else the origin is not at the clamp's edge, and the profile begins where it begins
    constexpr double level = 0.03;
    if (std::abs(point[kept][1] - point.front()[1]) > level * std::abs(point.back()[1] - point.front()[1])) kept = 0;
  }
  if (kept > 0) profile.notes.push_back(fmt::format("the {} points before the clamp's edge left out", kept));
  point.erase(point.begin(), point.begin() + static_cast<std::ptrdiff_t>(kept));
  profile.length = polyline_length(thinned(point));
}

void ask_about_length(const Profile& profile, const TestSpec& test, double given) {
  const double length = profile.length;
  const auto plausible = [&](double ratio) {
    return given > 0.0 ? std::abs(ratio * length / given - 1.0) < same_length
                       : ratio * length > plausible_overhang[0] && ratio * length < plausible_overhang[1];
  };
  if (plausible(1.0)) return;
  const std::string units = fitting_units(Quantity::length, test.x_unit, plausible);
  if (given > 0.0)
    throw InputError(
        fmt::format("{}: the profile is {:.4g} mm long, its overhang {:.4g} mm; are x_unit and y_unit really "
                    "'{}'{}, does the profile reach from clamp to tip, and are the overhangs in the order of "
                    "the files?",
                    profile.name, length, given, test.x_unit, units));
  if (test.trust_units) return;
  throw InputError(
      fmt::format("{}: the profile is {:.4g} mm long; are x_unit and y_unit really '{}'{}? if they are right, "
                  "say trust_units = true",
                  profile.name, length, test.x_unit, units));
}

bool segments_cross(const std::array<double, 2>& a, const std::array<double, 2>& b, const std::array<double, 2>& c,
                    const std::array<double, 2>& d) {
  const auto side = [](const auto& p, const auto& q, const auto& r) {
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  };
  return side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
}

void refuse_wrong_shapes(const Profile& profile) {
  const auto few = thinned(profile.point);
  for (std::size_t i = 0; i + 1 < few.size(); ++i)
    for (std::size_t k = i + 2; k + 1 < few.size(); ++k)
      if (segments_cross(few[i], few[i + 1], few[k], few[k + 1]))
        throw InputError(
            fmt::format("{}: the profile crosses itself near x {:.4g} mm, y {:.4g} mm; give the points "
                        "in order along the strip, one strip a file",
                        profile.name, few[k][0], few[k][1]));
  const std::size_t part = std::max<std::size_t>(1, few.size() / 6);
  const double clamp = angle_between(few.front(), few[part]);
  const double tip = angle_between(few[few.size() - 1 - part], few.back());
  if (clamp < tip) return;
  throw InputError(
      fmt::format("{}: the strip leaves its higher end at {:.0f} deg below the horizontal and its lower end "
                  "at {:.0f} deg; a clamped one leaves level and steepens: do heights count downwards? then "
                  "say y_factor = -1",
                  profile.name, clamp / degree, tip / degree));
}

// Height of the profile below its first point at a level distance from it.
double drop_at(const Profile& profile, double x) {
  const auto few = thinned(profile.point);
  for (std::size_t i = 1; i < few.size(); ++i) {
    const double from = few[i - 1][0] - few[0][0], to = few[i][0] - few[0][0];
    if (to < x || !(to > from)) continue;
    return few[0][1] - (few[i - 1][1] + (x - from) / (to - from) * (few[i][1] - few[i - 1][1]));
  }
  return few[0][1] - few.back()[1];
}

// Of one fabric a longer overhang hangs lower everywhere. A profile that crosses a shorter one's, and whose curve says
// another stiffness by more than strips of one fabric differ, is of another fabric, or has another overhang or origin
// than said.
void refuse_crossings(const std::vector<Profile>& profiles, const std::vector<BendingSpecimen>& specimens) {
  constexpr double longer_by = 1.05, most_above = 0.03, most_ratio = 1.6;
  for (std::size_t a = 0; a < profiles.size(); ++a)
    for (std::size_t b = 0; b < profiles.size(); ++b) {
      const Profile &shorter = profiles[a], &longer = profiles[b];
      if (longer.overhang < longer_by * shorter.overhang) continue;
      const double at = 0.7 * std::min(specimens[a].reach, specimens[b].reach);
      const double ratio = moment_at(specimens[b], at) / moment_at(specimens[a], at);
      if (ratio < most_ratio) continue;
      const double reach = shorter.point.back()[0] - shorter.point.front()[0], drop = drop_at(shorter, reach);
      for (int k = 4; k <= 20; ++k) {
        const double x = reach * k / 20, above = drop_at(shorter, x) - drop_at(longer, x);
        if (above <= most_above * drop) continue;
        throw InputError(
            fmt::format("{}: the strip of {:.4g} mm hangs {:.3g} mm above that of {:.4g} mm ({}) at {:.4g} mm "
                        "from the clamp, as if {:.2g} times as stiff; a longer overhang of the same fabric "
                        "hangs lower everywhere: are files, overhangs or origins exchanged?",
                        longer.name, longer.overhang, above, shorter.overhang, shorter.name, x, ratio));
      }
    }
}

Profile prepared_profile(Curve raw, const TestSpec& test, std::size_t file) {
  Profile profile{.name = raw.specimen, .point = {}, .notes = raw.notes};
  const Curve rows = complete_rows(std::move(raw));
  for (std::size_t i = 0; i < rows.x.size(); ++i) profile.point.push_back({rows.x[i], rows.y[i]});
  const double given = test.overhangs.empty()       ? 0.0
                       : test.overhangs.size() == 1 ? test.overhangs[0]
                                                    : test.overhangs[file];
  put_in_order(profile);
  turn_to_tip(profile);
  cut_jaws(profile, given);
  ask_about_length(profile, test, given);
  refuse_wrong_shapes(profile);
  profile.overhang = given > 0.0 ? given : profile.length;
  if (given > 0.0 && profile.length < 0.97 * given)
    profile.notes.push_back(
        fmt::format("the profile is {:.4g} mm long, its overhang {:.4g} mm; its last point is taken "
                    "for the tip",
                    profile.length, given));
  return profile;
}

BendingSpecimen profile_specimen(const Profile& profile, const TestSpec& test, double weight) {
  const double margin = test.clamp_margin.value_or(0.0);
  StripShape shape;
  if (margin == 0.0) shape.clamp = profile.overhang;
  const auto& first = profile.point.front();
  for (const auto& at : profile.point)
    if (std::hypot(at[0] - first[0], at[1] - first[1]) >= margin) shape.point.push_back(at);
  constexpr std::size_t least_points = 8;
  if (shape.point.size() < least_points)
    throw InputError(
        fmt::format("{}: only {} points are left beyond 'clamp_margin' {:.4g} mm, at least {} are needed; "
                    "digitise more, or lower it",
                    profile.name, shape.point.size(), margin, least_points));
  BendingSpecimen specimen = fit_hanging_strip(shape, weight, profile.name);
  specimen.sense = test.sense;
  specimen.notes.insert(specimen.notes.begin(), profile.notes.begin(), profile.notes.end());
  constexpr double worst_misfit = 0.02;  // of the length
  if (specimen.misfit > worst_misfit * profile.length)
    throw InputError(
        fmt::format("{}: no strip that hangs under its weight alone has this shape: the points lie {:.3g} mm "
                    "(root mean square) beside the nearest; are the columns, the clamp's place and the tip "
                    "right?",
                    profile.name, specimen.misfit));
  if (!test.trust_units)
    ask_about_stiffness(specimen.name, specimen.first_stiffness, weight,
                        fmt::format("is 'weight' right, and are x_unit and y_unit really '{}'", test.x_unit));
  return specimen;
}

}  // namespace

std::vector<BendingSpecimen> cantilever_specimens(const TestSpec& test, const FitSpec& spec) {
  const Channel x{Quantity::length, "x", test.x_column, test.x_unit, test.x_factor};
  const Channel y{Quantity::length, "y", test.y_column, test.y_unit, test.y_factor};
  const double weight = test.weight ? *test.weight * 1e-6 : spec.area_weight();
  std::vector<Profile> profiles;
  for_each_specimen(test, spec.file, x, y, [&](Curve raw, std::size_t file) {
    profiles.push_back(prepared_profile(std::move(raw), test, file));
  });
  std::vector<BendingSpecimen> specimens;
  std::vector<std::string> complaints;
  for (const auto& profile : profiles) {
    try {
      specimens.push_back(profile_specimen(profile, test, weight));
    } catch (const InputError& error) {
      complaints.insert(complaints.end(), error.complaints().begin(), error.complaints().end());
    }
  }
  if (!complaints.empty()) throw InputError(complaints);
  refuse_crossings(profiles, specimens);
  for (auto& specimen : specimens) specimen.name = name_beside(specimen.name, spec.file);
  return specimens;
}

}  // namespace weaveform::identify
