// A duration that the program chooses from the share of the loads that inertia may be, and with it the speed of tools.
#include "app/stages/chosen_duration.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "mesher/resolve/resolve.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/scene/taken.hpp"
#include "post/trust/inertia.hpp"
#include "solver/solve.hpp"
#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

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
  double share_of(const std::string& scene, const std::vector<std::string>& overrides) {
    Findings found(Findings::Want::first);
    const Resolved model = resolve(scene, overrides, found);
    found.throw_if_any();
    const SolveResult result = solve(model, {}, {.quiet = true});
    return std::abs(inertia_share(model.scene, result.history, result.statistics.damping_per_s).share);
  }
};

// On the scene's own mesh, which is finer than most trials': above a half of what was asked, below a tenth more.
TEST_F(ChosenDuration, HasTheShareThatWasAskedFor) {
  for (const auto& text : {drawing("inertia = 0.02"), bias("inertia = 0.02"), bias("inertia = 0.005")}) {
    const std::string scene = write(text);
    const auto chosen = choose_duration(scene, {});
    ASSERT_TRUE(chosen.has_value());
    const double asked = text.ends_with("0.005") ? 0.005 : 0.02,
                 share = share_of(scene, with_duration({"output.history=200"}, chosen));
    EXPECT_LT(share, 1.1 * asked) << chosen->duration;
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

TEST_F(ChosenDuration, BringsToolsASpeedThatStartsAndStopsGently) {
  const std::string scene = write(drawing("duration = \"auto\""));
  const auto chosen = choose_duration(scene, {});
  ASSERT_TRUE(chosen.has_value());
  EXPECT_EQ(chosen->tools, std::vector<std::string>{"punch"});
  ASSERT_FALSE(chosen->speed.empty());
  EXPECT_EQ(chosen->speed.front()[1], 0.0);
  EXPECT_LT(chosen->speed.back()[1], 0.3);
  EXPECT_LT(chosen->duration, chosen->smooth_duration);
  EXPECT_LE(chosen->share, inertia_of_auto);
  const auto check = test::run_command("weaveform check scene.toml --resolved", folder.path());
  ASSERT_EQ(check.exit_code, 0) << check.err;
  EXPECT_TRUE(test::says(check.out, fmt::format("# analysis.duration = {:g}: ", chosen->duration))) << check.out;
  EXPECT_TRUE(test::says(check.out, "# tools.punch.speed = [[0, 0], [")) << check.out;
  EXPECT_TRUE(test::says(check.out, "\ninertia = 0.01")) << check.out;
}

// As if an older program had taken another duration before the run was stopped.
TEST_F(ChosenDuration, AndTheSpeedAreThoseOfTheFolderForARunThatGoesOn) {
  write(drawing("inertia = 0.05"));
  const auto weaveform = [&](const std::string& arguments) {
    const auto result = test::run_command("weaveform " + arguments, folder.path());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result;
  };
  const fs::path file = folder.path() / "out/scene.toml";
  EXPECT_TRUE(test::says(weaveform("mesh scene.toml --output out"), "tools.punch.speed = [["));
  const Scene taken = read_scene(file);
  ASSERT_NE(find_taken(taken, "tools.punch.speed"), nullptr);
  std::string text = test::read_text(file);
  const std::string now = find_taken(taken, duration_key)->value;
  for (std::size_t at = text.find(now); at != std::string::npos; at = text.find(now, at + 1))
    text.replace(at, now.size(), "0.021");
  test::write_text(text, file);
  weaveform("mesh out/scene.toml --output out");
  weaveform("run scene.toml --output out --resume");
  const Scene kept = read_scene(file);
  EXPECT_EQ(kept.analysis.duration, 0.021);
  EXPECT_EQ(kept.tools, taken.tools);
  ASSERT_EQ(kept.taken.size(), 2u);
  // given by hand, it is no longer what the program took
  const Scene by_hand = read_scene(file, {"tools.punch.speed=[[0,1],[1,1]]"});
  EXPECT_EQ(find_taken(by_hand, "tools.punch.speed"), nullptr);
  EXPECT_NE(find_taken(by_hand, duration_key), nullptr);
}

TEST_F(ChosenDuration, LeavesASpeedThatIsGivenAndMotionsThatHaveNone) {
  std::string given = drawing("inertia = 0.05");
  given.replace(given.find("travel = 40.0"), 13, "travel = 40.0\nspeed = [[0, 0], [0.5, 1], [1, 0]]");
  EXPECT_TRUE(choose_duration(write(given), {})->tools.empty());
  EXPECT_TRUE(choose_duration(write(bias("inertia = 0.05")), {})->tools.empty());
}

// A mesh from elsewhere comes with no coarser ones, so that the trials are on it.
TEST_F(ChosenDuration, OfAMeshFromElsewhereIsChosenWhenItIsSolved) {
  write(bias("inertia = 0.02"));
  const auto weaveform = [&](const std::string& arguments) {
    const auto result = test::run_command("weaveform " + arguments, folder.path());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.err;
  };
  weaveform("export scene.toml --set analysis.duration=0.3 --format gmsh --output mesh.msh");
  weaveform("import mesh.msh --set analysis.duration=auto --output out");
  EXPECT_FALSE(read_scene(folder.path() / "out/scene.toml").analysis.duration.has_value());
  const std::string log = weaveform("solve out");
  const Scene copy = read_scene(folder.path() / "out/scene.toml");
  ASSERT_NE(find_taken(copy, duration_key), nullptr);
  EXPECT_TRUE(test::says(log, fmt::format("analysis.duration = {:g}: inertia is", *copy.analysis.duration))) << log;
  weaveform("post out");
  const std::string summary = test::read_text(folder.path() / "out/summary.json");
  EXPECT_TRUE(test::says(summary, "\"analysis.duration\"")) << summary;
  const double share = share_of((folder.path() / "scene.toml").string(),
                                {fmt::format("analysis.duration={}", *copy.analysis.duration), "output.history=200"});
  EXPECT_LT(share, 0.02);
  EXPECT_GT(share, 0.01);
  EXPECT_FALSE(test::says(weaveform("solve out"), "left to trials")) << "chosen once";
}

TEST_F(ChosenDuration, OfTrialsThatAreStoppedIsSaidAsFarAsItIsKnown) {
  const std::string scene = write(bias("inertia = 0.02"));
  long steps = 0;
  const auto whole = choose_duration(scene, {}, [&] { return ++steps, false; });
  for (const long last : {10L, steps - 10}) {
    long taken = 0;
    try {
      (void)choose_duration(scene, {}, [&] { return ++taken > last; });
      FAIL() << "not stopped";
    } catch (const TrialsStopped& stopped) {
      if (last == 10)
        EXPECT_EQ(stopped.so_far(), 0.0);
      else
        EXPECT_NEAR(stopped.so_far(), whole->duration, 0.3 * whole->duration);
    }
  }
}

// Three plies on coarser meshes go through each other, so that trials are on the scene's own, and take longer than a check.
TEST_F(ChosenDuration, OfTrialsThatACheckDoesNotWaitForIsSaid) {
  std::string text = drawing("duration = \"auto\"");
  for (const auto& [ply, angle] : {std::pair{"low", 0}, {"middle", 45}, {"high", 0}})
    text.insert(text.find("[tools.punch]"),
                fmt::format("[[ply]]\nname = \"{}\"\nyarn_angle = {}\ncell = \"rotation-free\"\n", ply, angle));
  for (const auto& [is, shall_be] : {std::pair{"[236.16, 236.16]", "[300.0, 300.0]\n"},
                                     {"radius = 50.0", "radius = 75.0"},
                                     {"travel = 40.0", "travel = 50.0"},
                                     {"fillet_radius = 25.0", "fillet_radius = 7.5"},
                                     {"opening_radius = 54.0", "opening_radius = 80.0"},
                                     {"opening_radius = 54.0", "opening_radius = 80.0"}})
    text.replace(text.find(is), std::string(is).size(), shall_be);
  write(text);
  const auto check = test::run_command("weaveform check scene.toml", folder.path());
  ASSERT_EQ(check.exit_code, 0) << check.err;
  EXPECT_TRUE(test::says(check.out, "# analysis.duration: left to trials, which take longer than 3 s")) << check.out;
  EXPECT_TRUE(test::says(check.out, "\nduration = \"auto\"")) << check.out;
  EXPECT_TRUE(test::says(check.out, "\ninertia = 0.01")) << check.out;
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
