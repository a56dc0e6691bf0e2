// What a bias extension says of its own mesh: lines that miss the grips' ends, borders as wide as a cell.
#include <gtest/gtest.h>

#include "tests/support/trust.hpp"

namespace weaveform {
namespace {

std::vector<std::string> said(const std::string& scene, const std::vector<std::string>& overrides) {
  std::vector<std::string> all = {"analysis.duration=0.1"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return test::warnings_of(test::Solved(test::example(scene, all)));
}

TEST(BiasExtensionMesh, LinesThatAreNotFittedToTheGripsAreWarnedOf) {
  const std::string words = "not fitted to the grips";
  EXPECT_TRUE(test::says(said("bias_extension_tw", {"blank.coarsening=4", "blank.fit=\"none\""}), words));
  EXPECT_TRUE(test::says(said("bias_extension_tw", {"blank.coarsening=4", "blank.phase=[0.5, 0.5]"}), words));
  EXPECT_FALSE(test::says(said("bias_extension_tw", {"blank.coarsening=4"}), words));
}

TEST(BiasExtensionMesh, BordersAsWideAsACellAreWarnedOfWhereYarnsStretchAndDoNotBend) {
  const std::string words = "as wide as a cell", coarse = "blank.coarsening=4";
  EXPECT_TRUE(test::says(said("bias_extension_pw", {coarse}), words));
  EXPECT_FALSE(test::says(said("bias_extension_pw", {coarse, "model.yarn=\"beam\""}), words));
  EXPECT_FALSE(test::says(said("bias_extension_pw", {coarse, "model.yarn_law=\"linear\""}), words));
  EXPECT_FALSE(test::says(said("bias_extension_pw", {coarse, "grip.top.travel=5"}), words));
}

}  // namespace
}  // namespace weaveform
