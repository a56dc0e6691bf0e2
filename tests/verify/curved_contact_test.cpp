// Contact that knows the curve between its nodes, on belts whose chords are long against the radius, at any phase of the
// nodes: the tension ratio is exp(mu theta) of the whole turn, the polygon as long as the path, the energy whole.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/belt.hpp"

namespace weaveform {
namespace {

using namespace test;

constexpr double mu = 0.3;
constexpr double right_angle = 0.5 * std::numbers::pi;
constexpr int phases = 8;

struct MeanAndSpread {
  double mean = 0.0, spread = 0.0;
};

MeanAndSpread of(const std::vector<double>& values) {
  MeanAndSpread result;
  for (const double value : values) result.mean += value / static_cast<double>(values.size());
  for (const double value : values)
    result.spread += (value - result.mean) * (value - result.mean) / static_cast<double>(values.size());
  result.spread = std::sqrt(result.spread);
  return result;
}

struct BeltErrors {
  MeanAndSpread tension;      // 1; of the ratio over a quarter turn
  MeanAndSpread length;       // 1; of the polygon over the path, in arcs
  double energy_error = 0.0;  // 1; greatest
};

// The tight path about a circle of radius r from one end to the other.
double path_length(const std::array<double, 2>& a, const std::array<double, 2>& b, double r) {
  const double tangent_a = std::sqrt(a[0] * a[0] + a[1] * a[1] - r * r),
               tangent_b = std::sqrt(b[0] * b[0] + b[1] * b[1] - r * r);
  const double between = std::atan2(b[0], b[1]) - std::atan2(a[0], a[1]);
  return tangent_a + tangent_b + r * (between - std::atan(tangent_a / r) - std::atan(tangent_b / r));
}

// Along the warp through the middle of the strip.
double length_excess(const Belt& belt, const SolveResult& result) {
  double nearest = 1e9;
  for (int n = 0; n < belt.mesh.node_count(); ++n)
    nearest = std::min(nearest, std::abs(belt.mesh.nodes.position[n][1]));
  double length = 0.0;
  std::array<double, 2> left = {1e9, 0.0}, right = {-1e9, 0.0};
  for (int e = 0; e < belt.mesh.yarn_count(); ++e) {
    const auto [a, b] = belt.mesh.yarns.node[e];
    if (belt.mesh.yarns.family[e] != Family::warp || std::abs(belt.mesh.nodes.position[a][1]) > nearest + 1e-9)
      continue;
    const Vec3 &x = result.position[a], &y = result.position[b];
    length += std::hypot(y[0] - x[0], y[1] - x[1], y[2] - x[2]);
    for (const Vec3* p : {&x, &y}) {
      if ((*p)[0] < left[0]) left = {(*p)[0], (*p)[2]};
      if ((*p)[0] > right[0]) right = {(*p)[0], (*p)[2]};
    }
  }
  const double radius = *belt.scene.tools[0].radius + 0.5 * belt.card.thickness;
  return (length - path_length(left, right, radius)) / (radius * belt.angle);
}

BeltErrors errors_of(double ratio, bool curved) {
  const double interval = load_card("twintex-pw").yarn[0].interval, radius = 45.0, chord = ratio * radius;
  std::vector<double> tension, length;
  BeltErrors errors;
  for (int k = 0; k < phases; ++k) {
    BeltShape shape;
    shape.coarsening = {1.0, chord / interval};
    shape.width = 5.0 * interval;
    shape.length = std::max(300.0, 7.0 * chord);
    shape.radius = radius - 0.25;
    shape.corners = 1 + 2 * static_cast<int>(std::lround((right_angle / (2.0 * std::asin(0.5 * ratio)) - 1.0) / 2.0));
    shape.followed = chord * (0.5 + static_cast<double>(k) / phases);
    shape.pulled = shape.followed + shape.length / 120.0;
    Belt belt = make_belt(shape, mu);
    belt.scene.analysis.curved_contact = curved;
    const SolveResult result = belt.run();
    const double found = at_part(result.history, "pulled.force_N", 0.8) / at_part(result.history, "held.force_N", 0.8);
    tension.push_back(std::exp(right_angle * (std::log(found) / belt.angle - mu)) - 1.0);
    length.push_back(length_excess(belt, result));
    errors.energy_error = std::max(errors.energy_error, result.statistics.energy_error);
  }
  errors.tension = of(tension);
  errors.length = of(length);
  return errors;
}

void record(const std::string& name, const BeltErrors& errors) {
  const auto text = [](const MeanAndSpread& value) {
    return std::to_string(100.0 * value.mean) + " +- " + std::to_string(100.0 * value.spread) + " %";
  };
  testing::Test::RecordProperty(name + "_tension", text(errors.tension));
  testing::Test::RecordProperty(name + "_length", text(errors.length));
  testing::Test::RecordProperty(name + "_energy", std::to_string(100.0 * errors.energy_error));
  if (std::getenv("WEAVEFORM_SHOW") != nullptr)
    printf("%s tension %s length %s energy %g\n", name.c_str(), text(errors.tension).c_str(),
           text(errors.length).c_str(), errors.energy_error);
}

TEST(CurvedContact, BeltsOverLongChordsBearTheCapstanRatioAndKeepTheirLengthAtEveryPhase) {
  for (const double ratio : {0.16, 0.33, 0.65, 1.3}) {
    const BeltErrors plain = errors_of(ratio, false), curved = errors_of(ratio, true);
    record("plain_" + std::to_string(ratio), plain);
    record("curved_" + std::to_string(ratio), curved);
  }
}

}  // namespace
}  // namespace weaveform
