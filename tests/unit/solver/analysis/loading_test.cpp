// What is said of a duration that the scene leaves out.
#include "solver/analysis/loading.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mesher/resolve/resolve.hpp"
#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

std::string said_of(const std::string& example, std::vector<std::string> overrides) {
  overrides.emplace_back("blank.coarsening=8");
  Findings found(Findings::Want::first);
  const Resolved model =
      resolve(std::string(WEAVEFORM_SOURCE_DIR) + "/examples/" + example + ".toml", overrides, found);
  found.throw_if_any();
  return describe_automatic_duration(model);
}

TEST(AutomaticDuration, IsSaidWithWhereItComesFrom) {
  const std::string waves = said_of("shear_frame_pw", {"analysis.duration=auto"});
  EXPECT_TRUE(test::says(waves, " s: left out, 16 times as long as the slowest shear wave")) << waves;
  EXPECT_FALSE(test::says(waves, "\"auto\"")) << waves;
}

TEST(AutomaticDuration, OfToolsSaysThatInertiaMayChooseIt) {
  // 90 mm by a smooth step, 15/8 times as fast at its middle as on the mean, at 1000 mm/s
  const std::string fastest = said_of("hemisphere_pw", {"analysis.duration=0.1", "analysis.inertia=0.01"});
  EXPECT_EQ(fastest, "");
  const std::string open = said_of("hemisphere_pw", {});
  EXPECT_TRUE(test::says(open, "analysis.duration = 0.169 s: not by trials, so that no tool is faster than 1000 mm/s"))
      << open;
  EXPECT_TRUE(test::says(open, "'weaveform mesh' makes the trials")) << open;
}

}  // namespace
}  // namespace weaveform
