// What a bias extension says of its own mesh: lines that miss the grips' ends, borders as wide as a cell.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

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

// Lines are fitted to the grips' ends, by a share that no two coarsenings have in common.
TEST(BiasExtensionMesh, WhoFollowsTheAdviceIsNotWarnedAgain) {
  const std::string words = "as wide as a cell", advice = "set blank.coarsening to ";
  const auto coarsening = [](double value) { return fmt::format("blank.coarsening={:.2g}", value); };
  for (const std::string scene : {"bias_extension_pw", "bias_extension_tw"})
    for (const double start : {1.3, 2.0, 4.0}) {
      std::string advised;
      for (const auto& line : said(scene, {coarsening(start)}))
        if (line.find(words) != std::string::npos) advised = line.substr(line.find(advice) + advice.size());
      ASSERT_FALSE(advised.empty()) << scene << " at " << start;
      const std::string followed = coarsening(std::stod(advised));
      EXPECT_FALSE(test::says(said(scene, {followed}), words)) << scene << ": " << followed;
    }
}

}  // namespace
}  // namespace weaveform
