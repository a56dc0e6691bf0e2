// The length that wrinkles would have, told from a scene before it is run.
#include "post/trust/expected_waves.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesher/resolve/resolve.hpp"
#include "post/forming/waves.hpp"

namespace weaveform {
namespace {

Resolved drawing(const std::vector<std::string>& overrides) {
  Findings found(Findings::Want::first);
  return resolve(std::string(WEAVEFORM_SOURCE_DIR) + "/examples/hemisphere_pw_fast.toml", overrides, found);
}

bool speaks_of_waves(const Resolved& model) {
  const auto lines = warnings_before(model);
  return std::any_of(lines.begin(), lines.end(),
                     [](const std::string& line) { return line.find("if it wrinkles") != std::string::npos; });
}

TEST(ExpectedWaves, FollowFromRigidityFrictionAndForce) {
  const auto waves =
      expected_waves(drawing({"blank.coarsening=8", "tools.binder.friction=0.1", "tools.die.friction=0.4"}));
  ASSERT_TRUE(waves);
  EXPECT_DOUBLE_EQ(waves->rigidity, 2.0) << "twintex-pw";
  EXPECT_NEAR(waves->tension, 0.5 * 650.0 / (2.0 * std::numbers::pi * 77.0), 1e-12);
  EXPECT_EQ(waves->span, 77.0);
  EXPECT_NEAR(waves->wavelength,
              2.0 * std::sqrt(std::numbers::pi * 77.0) * std::pow(waves->rigidity / waves->tension, 0.25), 1e-9);
  EXPECT_NEAR(waves->cells, waves->wavelength / (8 * 4.92), 0.15 * waves->cells) << "spacing may be fitted";
}

TEST(ExpectedWaves, AreUnknownWhereNothingHoldsOrBends) {
  const std::vector<std::string> coarse = {"blank.coarsening=8"};
  EXPECT_FALSE(expected_waves(drawing({coarse[0], "model.cell=membrane", "analysis.bending_every=1"})));
  EXPECT_FALSE(expected_waves(drawing({coarse[0], "tools.binder.friction=0", "tools.die.friction=0"})));
}

TEST(ExpectedWaves, AMeshThatHasNoSuchWaveIsWarnedOf) {
  EXPECT_TRUE(speaks_of_waves(drawing({"blank.coarsening=8"})));
  EXPECT_FALSE(speaks_of_waves(drawing({"blank.coarsening=2"})));
  EXPECT_FALSE(speaks_of_waves(drawing({"blank.coarsening=8", "model.cell_bending=[300, 300, 20]"})));
}

}  // namespace
}  // namespace weaveform
