// A duration that the program chooses from the share of the loads that inertia may be.
#include "app/stages/chosen_duration.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/error.hpp"
#include "mesher/resolve/resolve.hpp"
#include "mesher/scene/reader.hpp"
#include "post/trust/inertia.hpp"
#include "solver/solve.hpp"
#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

std::string drawing(const std::string& analysis) {
  return R"(
[fabric]
material = "twintex-pw"
[blank]
size = [236.16, 236.16]
yarn_angle = 0.0
coarsening = 2
[tools.punch]
shape = "sphere"
radius = 50.0
travel = 40.0
friction = 0.2
[tools.die]
shape = "ring"
opening_radius = 54.0
fillet_radius = 25.0
friction = 0.2
[tools.binder]
shape = "ring"
axis = [0, 0, -1]
opening_radius = 54.0
force = 400.0
friction = 0.2
[analysis]
)" + analysis;
}

// With cells as fine as the measurements of docs/stability.md have them at least.
std::string bias(const std::string& analysis) {
  std::string text = test::tiny_scene();
  text.replace(text.find("coarsening = 4"), 14, "coarsening = 2");
  return text + "\n[analysis]\n" + analysis;
}

class ChosenDuration : public testing::Test {
protected:
  test::TemporaryFolder folder;
  std::string write(const std::string& text) {
    const auto file = folder.path() / "scene.toml";
    test::write_text(text, file);
    return file.string();
  }
  double share_of(const std::string& scene, double duration) {
    Findings found(Findings::Want::first);
    const Resolved model =
        resolve(scene, {fmt::format("analysis.duration={:.17g}", duration), "output.history=200"}, found);
    found.throw_if_any();
    const SolveResult result = solve(model, {}, {.quiet = true});
    return std::abs(inertia_share(model.scene, result.history, result.statistics.damping_per_s).share);
  }
};

// On the scene's own mesh, which is finer than the trials': within a half of what was asked, on the safe side of a third more.
TEST_F(ChosenDuration, HasTheShareThatWasAskedFor) {
  for (const auto& text : {drawing("inertia = 0.02"), bias("inertia = 0.02"), bias("inertia = 0.005")}) {
    const std::string scene = write(text);
    const auto chosen = choose_duration(scene, {});
    ASSERT_TRUE(chosen.has_value());
    const double asked = text.ends_with("0.005") ? 0.005 : 0.02, share = share_of(scene, chosen->duration);
    EXPECT_LT(share, 1.33 * asked) << chosen->duration;
    EXPECT_GT(share, 0.5 * asked) << chosen->duration;
  }
}

TEST_F(ChosenDuration, IsTheSameEachTimeAndStandsInTheFoldersScene) {
  const std::string scene = write(bias("inertia = 0.02"));
  const auto once = choose_duration(scene, {}), again = choose_duration(scene, {});
  EXPECT_EQ(once->duration, again->duration);
  const auto made = test::run_command("weaveform mesh scene.toml --output out", folder.path());
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.err.find(fmt::format("analysis.duration = {:g}: inertia is", once->duration)), std::string::npos)
      << made.err;
  const Scene copy = read_scene((folder.path() / "out/scene.toml").string());
  EXPECT_EQ(copy.analysis.duration, once->duration);
  EXPECT_EQ(copy.analysis.inertia, 0.02);
  EXPECT_FALSE(choose_duration((folder.path() / "out/scene.toml").string(), {}).has_value());
}

TEST_F(ChosenDuration, DoesNotHangOnHowMuchIsWritten) {
  const std::string scene = write(bias("inertia = 0.02"));
  EXPECT_EQ(choose_duration(scene, {"output.history=10", "output.frames=0"})->duration,
            choose_duration(scene, {"output.history=1000", "output.frames=40"})->duration);
}

TEST_F(ChosenDuration, IsNotChosenWhereTheSceneHasOne) {
  EXPECT_FALSE(choose_duration(write(bias("inertia = 0.02\nduration = 0.1")), {}).has_value());
  EXPECT_FALSE(choose_duration(write(bias("inertia = 0.02\nloading_speed = 200")), {}).has_value());
  EXPECT_FALSE(choose_duration(write(bias("")), {}).has_value());
}

// At 0.11 s the bias extension has 2 % (docs/stability.md).
TEST_F(ChosenDuration, OfTheScenesOwnIsWarnedOfBeyondTheShareAllowed) {
  const auto warnings = [&](const std::string& inertia) {
    write(bias("duration = 0.16\n" + inertia));
    return test::run_command("weaveform run scene.toml --output out", folder.path()).err;
  };
  EXPECT_EQ(warnings("").find("inertia and damping are"), std::string::npos);
  const std::string strict = warnings("inertia = 0.005");
  EXPECT_NE(strict.find("inertia and damping are"), std::string::npos) << strict;
  EXPECT_NE(strict.find("(limit 0.5 %)"), std::string::npos) << strict;
}

TEST_F(ChosenDuration, NeedsSomethingThatMoves) {
  std::string still = bias("inertia = 0.02");
  still.replace(still.find("travel = 30.0"), 13, "travel = 0.0 ");
  const std::string scene = write(still);
  try {
    (void)choose_duration(scene, {});
    FAIL() << "nothing moves";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("give analysis.duration"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace weaveform
