// Contact that knows the curve between its nodes, on belts whose chords are long against the radius, at any phase of the
// nodes: the tension ratio is exp(mu theta) of the whole turn, the polygon as long as the path, the energy whole.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "solver/constraint/grips.hpp"
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
struct TightPath {
  double length = 0.0, turn = 0.0;  // mm, rad
};
TightPath tight_path(const std::array<double, 2>& a, const std::array<double, 2>& b, double r) {
  const double tangent_a = std::sqrt(a[0] * a[0] + a[1] * a[1] - r * r),
               tangent_b = std::sqrt(b[0] * b[0] + b[1] * b[1] - r * r);
  const double between = std::atan2(b[0], b[1]) - std::atan2(a[0], a[1]);
  const double turn = between - std::atan(tangent_a / r) - std::atan(tangent_b / r);
  return {tangent_a + tangent_b + r * turn, turn};
}

struct WarpYarn {
  double length = 0.0;                    // mm; of its chords
  std::array<double, 2> left{}, right{};  // mm; x and z of its ends
};

// The one nearest to the middle of the strip, at the end.
WarpYarn middle_yarn(const Belt& belt, const SolveResult& result) {
  double nearest = 1e9;
  for (const auto& flat : belt.mesh.nodes.position) nearest = std::min(nearest, std::abs(flat[1]));
  WarpYarn yarn{0.0, {1e9, 0.0}, {-1e9, 0.0}};
  for (int e = 0; e < belt.mesh.yarn_count(); ++e) {
    const auto [a, b] = belt.mesh.yarns.node[e];
    if (belt.mesh.yarns.family[e] != Family::warp || std::abs(belt.mesh.nodes.position[a][1]) > nearest + 1e-9)
      continue;
    const Vec3 &x = result.position[a], &y = result.position[b];
    yarn.length += std::hypot(y[0] - x[0], y[1] - x[1], y[2] - x[2]);
    for (const Vec3* p : {&x, &y}) {
      if ((*p)[0] < yarn.left[0]) yarn.left = {(*p)[0], (*p)[2]};
      if ((*p)[0] > yarn.right[0]) yarn.right = {(*p)[0], (*p)[2]};
    }
  }
  return yarn;
}

// An end where it was at a part of the time: ends move along straight lines with their grips.
std::array<double, 2> end_at(const std::array<double, 2>& end, const GripSpec& grip, double part) {
  const double back = (1.0 - smooth_step(part)) * grip.travel;
  return {end[0] - back * (*grip.direction)[0], end[1] - back * (*grip.direction)[2]};
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
    const double r = *belt.scene.tools[0].radius + 0.5 * belt.card.thickness;
    const WarpYarn yarn = middle_yarn(belt, result);
    // while all of it slides
    const double found = at_part(result.history, "pulled.force_N", 0.8) / at_part(result.history, "held.force_N", 0.8);
    const double turn =
        tight_path(end_at(yarn.left, belt.scene.grip[0], 0.8), end_at(yarn.right, belt.scene.grip[1], 0.8), r).turn;
    tension.push_back(std::exp(right_angle * (std::log(found) / turn - mu)) - 1.0);
    const TightPath path = tight_path(yarn.left, yarn.right, r);
    length.push_back((yarn.length - path.length) / (r * path.turn));
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

// What is left in tension is 0.1 to 0.3 % of inertia and bending at every ratio, and springs that lag over long chords.
TEST(CurvedContact, BeltsOverLongChordsBearTheCapstanRatioAndKeepTheirLengthAtEveryPhase) {
  struct Bounds {
    double ratio, tension, spread, length;
  };
  for (const Bounds& bounds :
       {Bounds{0.16, 0.004, 0.002, 0.001}, Bounds{0.33, 0.005, 0.004, 0.0015}, Bounds{0.65, 0.007, 0.008, 0.005}}) {
    const BeltErrors plain = errors_of(bounds.ratio, false), curved = errors_of(bounds.ratio, true);
    record("plain_" + std::to_string(bounds.ratio), plain);
    record("curved_" + std::to_string(bounds.ratio), curved);
    EXPECT_LT(std::abs(curved.tension.mean), bounds.tension) << bounds.ratio;
    EXPECT_LT(curved.tension.spread, bounds.spread) << bounds.ratio;
    EXPECT_LT(std::abs(curved.length.mean), bounds.length) << bounds.ratio;
    EXPECT_LT(std::abs(curved.length.mean), 0.35 * std::abs(plain.length.mean)) << bounds.ratio;
    EXPECT_LT(curved.energy_error, 0.002) << bounds.ratio;
  }
}

TEST(CurvedContact, ChordsLongerThanTheRadiusLoseMostOfTheirError) {
  const BeltErrors plain = errors_of(1.3, false), curved = errors_of(1.3, true);
  record("plain_1.3", plain);
  record("curved_1.3", curved);
  EXPECT_GT(plain.tension.mean, 0.05);
  EXPECT_LT(std::abs(curved.tension.mean), 0.02);
  EXPECT_LT(curved.tension.spread, 0.4 * plain.tension.spread);
  EXPECT_LT(std::abs(curved.length.mean), 0.4 * std::abs(plain.length.mean));
  EXPECT_LT(curved.energy_error, 0.01);
}

}  // namespace
}  // namespace weaveform
