// Loading speed. The share of inertia and damping in the loads, told from the kinetic energy alone
// (post/trust/inertia.hpp), against what slow loading shows it to be.
#include <gtest/gtest.h>

#include <cmath>

#include "post/trust/inertia.hpp"
#include "tests/support/ask_border.hpp"
#include "tests/support/scene_run.hpp"

namespace weaveform {
namespace {

using namespace test;

constexpr double limit = 0.02;  // of post/trust/fast_loading.cpp

double at_way(const History& history, const std::string& part, const std::string& column, double way) {
  const auto x = history.values(part + ".displacement_mm"), y = history.values(column);
  for (std::size_t k = 1; k < x.size(); ++k)
    if (x[k] >= way) return y[k - 1] + (way - x[k - 1]) / (x[k] - x[k - 1]) * (y[k] - y[k - 1]);
  return y.back();
}

// Greatest difference of the loads from those of slow loading, each a mean over a twentieth of the way, over the
// greatest load; from a tenth of the way on.
double load_error(const History& fast, const History& slow, const std::string& part) {
  constexpr int points = 400, window = points / 20;
  const std::string force = part + ".force_N";
  const double way = slow.values(part + ".displacement_mm").back();
  double greatest = 0.0, worst = 0.0, sum = 0.0;
  std::vector<double> difference;
  for (int n = points / 10; n <= points; ++n) {
    const double at = way * n / points, right = at_way(slow, part, force, at);
    greatest = std::max(greatest, std::abs(right));
    difference.push_back(at_way(fast, part, force, at) - right);
    sum += difference.back() / window;
    if (difference.size() > window) sum -= difference[difference.size() - 1 - window] / window;
    if (difference.size() >= window) worst = std::max(worst, std::abs(sum));
  }
  return worst / greatest;
}

struct SpeedCase {
  std::string example, part;
  std::vector<std::string> overrides;
  double slow, border;  // s; durations: of the reference, and where the share is 2 % (bench/stability/loading_speed*)
};

Scene at_duration(const SpeedCase& test, double duration) {
  std::vector<std::string> overrides = test.overrides;
  overrides.push_back("analysis.duration=" + std::to_string(duration));
  return example(test.example, overrides);
}

// `multiplied`: least and greatest ratio of the load's error to the share of inertia.
void check_border(const SpeedCase& test, const std::array<double, 2>& multiplied) {
  const Solved slow(at_duration(test, test.slow));
  for (const double side : {1.2, 1.0 / 1.2}) {
    const Solved fast(at_duration(test, side * test.border));
    const double share =
        std::abs(inertia_share(fast.scene, fast.result.history, fast.result.statistics.damping_per_s).share);
    const double error = load_error(fast.result.history, slow.result.history, test.part);
    EXPECT_GT(error, multiplied[0] * share) << side;
    EXPECT_LT(error, multiplied[1] * share) << side;
    EXPECT_EQ(share > limit, side < 1.0) << side << ": " << share;
    EXPECT_EQ(error > std::sqrt(multiplied[0] * multiplied[1]) * limit, side < 1.0) << side << ": " << error;
    EXPECT_EQ(!ask(warn_of_fast_loading, fast.scene, fast.card, fast.mesh, fast.result).empty(), side < 1.0) << side;
  }
}

TEST(LoadingSpeed, ShareOfInertiaInABiasExtensionIsTheErrorOfItsLoad) {
  // Here nothing multiplies the inertia, and the share is the error but for what a mean over the way leaves out.
  check_border({"bias_extension_pw", "top", {"blank.coarsening=4"}, 1.0, 0.110}, {0.95, 1.05});
}

TEST(LoadingSpeed, ShareOfInertiaInADrawingIsTheErrorOfThePunchForce) {
  // Inertia of the fabric that is drawn in passes over the die's fillet, where friction multiplies it by up to
  // exp(mu pi/2) = 1.6.
  check_border({"hemisphere_pw", "punch", {"blank.coarsening=8", late_punch}, 0.6, 0.139}, {1.0, 1.6});
}

TEST(LoadingSpeed, OfTheBiasExtensionAsShippedAndOfASlowHemisphereDoesNotWarn) {
  for (const Scene& scene : {example("bias_extension_pw", {"blank.coarsening=4"}),
                             example("hemisphere_pw", {"blank.coarsening=4", "analysis.duration=0.4", late_punch})}) {
    const Solved run(scene);
    EXPECT_TRUE(ask(warn_of_fast_loading, run.scene, run.card, run.mesh, run.result).empty()) << scene.file;
  }
}

}  // namespace
}  // namespace weaveform
