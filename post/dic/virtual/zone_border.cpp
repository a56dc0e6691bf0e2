#include "post/dic/virtual/zone_border.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/vector/angle.hpp"
#include "post/dic/virtual/simulation.hpp"
#include "post/dic/virtual/step_width.hpp"
#include "post/measure/bias_extension.hpp"

namespace weaveform::dic {
namespace {

constexpr int profile_points = 121, lines_along = 9;

using Angle = std::function<double(const Vec2&)>;  // not a number off the fabric

// Across a border: centre, the way from one zone into the other, half the length, and how far to average along it.
struct Profile {
  Vec2 centre, across, along;
  double reach, span;
};

// Border A-B and border B-C on the upper left of a specimen pulled along y (x across); zones.cpp has their lines. Both
// begin where they meet, in the middle of zone C's tip, and end at the free edge. The profiles cross them at 0.4 of
// their length: further out a wide window would look over the free edge, further in over the other border.
std::array<Profile, 2> profiles_of(const BiasSpecimen& specimen) {
  const double half = 0.5 * specimen.free_length(), r = std::sqrt(0.5);
  const double length = std::min(half, 0.5 * specimen.width) / r, at = 0.4 * length * r;
  const double reach = 0.24 * length, span = 0.08 * length;
  return {{{{-at, half - at}, {-r, r}, {r, r}, reach, span}, {{-at, half + at}, {r, r}, {-r, r}, reach, span}}};
}

// Across and along the pull to x and y of the blank's frame.
Vec2 in_frame(const Vec2& v, const BiasSpecimen& specimen) {
  return specimen.axis == 1 ? v : Vec2{v[1], v[0]};
}

struct MeanProfile {
  std::vector<double> distance, angle;
};

MeanProfile sample(const Profile& profile, const BiasSpecimen& specimen, const Angle& angle) {
  MeanProfile mean;
  for (int i = 0; i < profile_points; ++i) {
    const double s = profile.reach * (2.0 * i / (profile_points - 1) - 1.0);
    double sum = 0.0;
    for (int line = 0; line < lines_along; ++line) {
      const double t = profile.span * (2.0 * line / (lines_along - 1) - 1.0);
      sum += angle(in_frame({profile.centre[0] + s * profile.across[0] + t * profile.along[0],
                             profile.centre[1] + s * profile.across[1] + t * profile.along[1]},
                            specimen));
    }
    mean.distance.push_back(s);
    mean.angle.push_back(sum / lines_along);
  }
  return mean;
}

// Between the angles that the raw field has on both sides: a wide instrument's own profile need not reach them.
double width_between(const MeanProfile& profile, const std::array<double, 2>& ends) {
  return step_width(profile.distance, profile.angle, ends[0], ends[1]);
}

// Width of the ideal border through the instrument, over a profile long enough for it.
double ideal_width(double angle, double facet, double step, int window) {
  const double r = std::sqrt(0.5), reach = 3.0 * (window * step + facet);
  const YarnDirections yarns = {{r, r}, {-r, r}};
  const auto field = [&](const Vec2& place) { return ideal_zone_border(place, angle, yarns); };
  MeanProfile profile;
  for (int i = 0; i < 4 * profile_points; ++i) {
    const double s = reach * (2.0 * i / (4 * profile_points - 1) - 1.0);
    profile.distance.push_back(s);
    profile.angle.push_back(levelled_angle(field, {s * yarns.g2[0], s * yarns.g2[1]}, facet, step, window, yarns));
  }
  return step_width(profile.distance, profile.angle);
}

}  // namespace

Eigen::Vector2d ideal_zone_border(const Vec2& place, double angle, const YarnDirections& yarns) {
  const Eigen::Vector2d g1(yarns.g1[0], yarns.g1[1]), g2(yarns.g2[0], yarns.g2[1]), x(place[0], place[1]);
  const auto turned = [](const Eigen::Vector2d& v, double by) { return Eigen::Vector2d(Eigen::Rotation2Dd(by) * v); };
  const double first = x.dot(g1), second = x.dot(g2);
  return first * turned(g1, 0.5 * angle) + second * (second > 0.0 ? g2 : turned(g2, -0.5 * angle)) - x;
}

ZoneBorders zone_border_widths(const std::filesystem::path& result, const std::vector<double>& facet_sizes,
                               const Settings& settings) {
  const Simulation simulation(result, settings.stages.grip, settings.instrument.ply);
  const auto specimen = find_bias_extension(simulation.scene());
  if (!specimen)
    throw InputError(
        fmt::format("{}: is no bias extension of a whole rectangle with yarns at 45 deg; only there the "
                    "zones' borders are known",
                    result.string()));
  const SimulatedState state = simulation.at_frame(simulation.frame_count() - 1);
  const FlatMesh& flat = simulation.flat();
  const YarnDirections yarns = yarn_directions(simulation.scene().blank);
  const auto profiles = profiles_of(*specimen);

  ZoneBorders study;
  study.travel = state.travel;
  const Angle raw = [&](const Vec2& place) {
    const int cell = flat.cell_at(place);
    return cell < 0 ? std::nan("") : state.shear_angle[static_cast<std::size_t>(cell)];
  };
  const MeanProfile raw_ab = sample(profiles[0], *specimen, raw), raw_bc = sample(profiles[1], *specimen, raw);
  const auto ends_ab = end_angles(raw_ab.angle), ends_bc = end_angles(raw_bc.angle);
  study.angle = {ends_ab[0], ends_ab[1], ends_bc[1]};
  study.width.push_back({0.0, 0.0, 0, 0.0, width_between(raw_ab, ends_ab), width_between(raw_bc, ends_bc)});

  // Linear within a cell; off the fabric there is nothing to see.
  const auto displacement = [&](const Vec2& place) -> Eigen::Vector2d {
    const int cell = flat.cell_at(place);
    if (cell < 0) return {std::nan(""), std::nan("")};
    std::vector<FlatMesh::Entry> row;
    flat.add_weights(cell, place, 1.0, row);
    Eigen::Vector2d u(0.0, 0.0);
    for (const auto& [node, weight] : row)
      u += weight * Eigen::Vector2d(state.displacement[node][0], state.displacement[node][1]);
    return u;
  };
  const int window = settings.instrument.window ? static_cast<int>(*settings.instrument.window) : 5;
  for (const double facet : facet_sizes) {
    if (!(facet > 0.0)) throw InputError(fmt::format("facet size {} mm; it must be above 0", facet));
    const double step = settings.instrument.step.value_or(0.5 * facet);
    const Angle levelled = [&](const Vec2& place) {
      return levelled_angle(displacement, place, facet, step, window, yarns);
    };
    study.width.push_back({facet, step, window, ideal_width(study.angle[0], facet, step, window),
                           width_between(sample(profiles[0], *specimen, levelled), ends_ab),
                           width_between(sample(profiles[1], *specimen, levelled), ends_bc)});
  }
  return study;
}

std::string zone_border_table(const ZoneBorders& study) {
  std::string text = fmt::format(
      "Borders at {:.3g} mm of travel; shear angle {:.1f} deg in A, {:.1f} in B, {:.1f} in C. "
      "Widths from 10 to 90 % of the way, mm.\n\n",
      study.travel, study.angle[0] * degrees_per_radian, study.angle[1] * degrees_per_radian,
      study.angle[2] * degrees_per_radian);
  text += "| facet mm | step mm | window | a sharp border would seem | border A-B | border B-C |\n";
  text += "|---:|---:|---:|---:|---:|---:|\n";
  const auto cell = [](double width) {
    return std::isfinite(width) ? fmt::format("{:.1f}", width) : std::string("too wide");
  };
  for (const ZoneBorderWidth& row : study.width) {
    if (row.window == 0)
      text += fmt::format("| raw | | | | {} | {} |\n", cell(row.ab), cell(row.bc));
    else
      text += fmt::format("| {:.3g} | {:.3g} | {} x {} | {} | {} | {} |\n", row.facet_size, row.step, row.window,
                          row.window, cell(row.ideal), cell(row.ab), cell(row.bc));
  }
  return text;
}

nlohmann::ordered_json zone_border_json(const ZoneBorders& study) {
  nlohmann::ordered_json json = {{"travel_mm", study.travel},
                                 {"shear_angle_deg",
                                  {{"A", study.angle[0] * degrees_per_radian},
                                   {"B", study.angle[1] * degrees_per_radian},
                                   {"C", study.angle[2] * degrees_per_radian}}},
                                 {"widths", nlohmann::ordered_json::array()}};
  for (const ZoneBorderWidth& row : study.width) {
    const bool raw = row.window == 0;
    json["widths"].push_back({{"field", raw ? "raw" : "levelled"},
                              {"facet_size_mm", raw ? std::nan("") : row.facet_size},
                              {"step_mm", raw ? std::nan("") : row.step},
                              {"window_points", row.window},
                              {"sharp_border_mm", raw ? std::nan("") : row.ideal},
                              {"border_ab_mm", row.ab},
                              {"border_bc_mm", row.bc}});
  }
  return json;
}

}  // namespace weaveform::dic
