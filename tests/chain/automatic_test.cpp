// Mesh and elements by themselves through the program: shown before anything runs, kept by the folder, checked at the end.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "mesher/scene/reader.hpp"
#include "mesher/scene/taken.hpp"
#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

using test::run_command;
using test::says;

// A strip of fabric, held at both ends and pressed by a bar: a second or less.
const std::string belt = R"([blank]
size = [240, 160]
yarn_angle = 0
coarsening = "auto"
[model]
yarn = "auto"
cell = "auto"
[accuracy]
force = 0.02
angle = 1
[[grip]]
name = "left"
edge = "left"
[[grip]]
name = "right"
edge = "right"
[tools.bar]
shape = "cylinder"
radius = 12
axis = [0, 1, 0]
position = [0, 0, 12.25]
travel = 12
[analysis]
duration = 0.1
[output]
frames = 1
)";

class AutomaticChoice : public testing::Test {
protected:
  test::TemporaryFolder folder;
  void SetUp() override { test::write_text(belt, folder.path() / "scene.toml"); }
  [[nodiscard]] test::CommandResult weaveform(const std::string& arguments) const {
    return run_command("weaveform " + arguments, folder.path());
  }
  [[nodiscard]] nlohmann::json summary(const std::string& directory) const {
    return nlohmann::json::parse(test::read_text(folder.path() / directory / "summary.json"));
  }
  [[nodiscard]] Scene copy(const std::string& directory) const {
    return read_scene(folder.path() / directory / "scene.toml");
  }
};

TEST_F(AutomaticChoice, IsShownBeforeAnythingRuns) {
  const auto check = weaveform("check scene.toml");
  ASSERT_EQ(check.exit_code, 0) << check.err;
  EXPECT_TRUE(says(check.out, "# blank.coarsening = [")) << check.out;
  EXPECT_TRUE(says(check.out, "# model.cell = \"rotation-free\": ")) << check.out;
  EXPECT_TRUE(says(check.out, "tool 'bar' bends the fabric over 12.")) << check.out;
  const auto plan = weaveform("mesh scene.toml --plan");
  ASSERT_EQ(plan.exit_code, 0) << plan.err;
  EXPECT_TRUE(says(plan, "blank.coarsening = [")) << plan.err;
}

TEST_F(AutomaticChoice, IsInTheLogTheFoldersSceneAndTheSummary) {
  const auto run = weaveform("run scene.toml --output out");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Scene scene = copy("out");
  EXPECT_FALSE(leaves_open(scene));
  const auto taken = summary("out")["taken"];
  ASSERT_EQ(taken.size(), 3u);
  for (const auto& one : taken) {
    const TakenSpec* kept = find_taken(scene, one["key"]);
    ASSERT_NE(kept, nullptr) << one;
    EXPECT_EQ(one["value"], kept->value);
    EXPECT_TRUE(says(run, kept->key + " = " + kept->value + ": " + kept->why)) << run.err;
    EXPECT_TRUE(one.value("held", true)) << one;
  }
  // the folder's own scene gives the same run again, and says the same of it
  const auto again = weaveform("run out/scene.toml --output again");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(summary("again")["taken"], taken);
  EXPECT_EQ(summary("again")["tools"], summary("out")["tools"]);
}

TEST_F(AutomaticChoice, IsTheSameForEveryStage) {
  ASSERT_EQ(weaveform("run scene.toml --output out").exit_code, 0);
  ASSERT_EQ(weaveform("mesh scene.toml --output staged").exit_code, 0);
  ASSERT_EQ(weaveform("solve staged").exit_code, 0);
  ASSERT_EQ(weaveform("post staged").exit_code, 0);
  EXPECT_EQ(summary("staged")["taken"], summary("out")["taken"]);
  EXPECT_EQ(summary("staged")["tools"], summary("out")["tools"]);
}

// As if an older program had taken another mesh before the run was stopped.
TEST_F(AutomaticChoice, OfTheFolderIsTakenByARunThatGoesOn) {
  ASSERT_EQ(weaveform("mesh scene.toml --output out").exit_code, 0);
  const std::string now = find_taken(copy("out"), "blank.coarsening")->value;
  std::string text = test::read_text(folder.path() / "out/scene.toml");
  for (std::size_t at = text.find(now); at != std::string::npos; at = text.find(now, at + 1))
    text.replace(at, now.size(), "[2.5, 2.5]");
  test::write_text(text, folder.path() / "out/scene.toml");
  ASSERT_EQ(weaveform("mesh out/scene.toml --output out").exit_code, 0);
  const auto run = weaveform("run scene.toml --output out --resume");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(copy("out").blank.coarsening, (std::array<double, 2>{2.5, 2.5}));
  EXPECT_EQ(summary("out")["taken"][2]["value"], "[2.5, 2.5]");
  // what is given by hand is another run
  EXPECT_EQ(weaveform("run scene.toml --output out --resume --set blank.coarsening=2").exit_code, 2);
  EXPECT_EQ(weaveform("run scene.toml --output out --resume --set accuracy.force=0.05").exit_code, 2);
}

// The record stays with the folder's scene, the die's fillet is made tighter than the mesh was taken for.
TEST_F(AutomaticChoice, ThatDidNotHoldIsAWarning) {
  ASSERT_EQ(weaveform("mesh '" WEAVEFORM_SOURCE_DIR "/examples/hemisphere_pw_fast.toml' --output out --set "
                      "blank.coarsening=auto --set accuracy.force=0.05 --set accuracy.angle=2")
                .exit_code,
            0);
  const auto held = weaveform("run out/scene.toml --output as_taken");
  EXPECT_FALSE(says(held, "is lost")) << held.err;
  EXPECT_TRUE(summary("as_taken")["taken"][0]["held"]);
  const auto tight = weaveform("run out/scene.toml --output tight --set tools.die.fillet_radius=6");
  ASSERT_EQ(tight.exit_code, 0) << tight.err;
  EXPECT_TRUE(says(tight, "the accuracy that blank.coarsening was taken for is lost")) << tight.err;
  const auto taken = summary("tight")["taken"];
  EXPECT_EQ(taken[0]["key"], "blank.coarsening");
  EXPECT_FALSE(taken[0]["held"]);
}

// The box's fillets run along the yarns: contact at nodes scatters there by more than 2 % of the force.
TEST_F(AutomaticChoice, OfEdgesAlongTheYarnsSaysWhatItCannotPromise) {
  const std::string check =
      "check '" WEAVEFORM_SOURCE_DIR "/examples/cad_box.toml' --set blank.coarsening=auto --set analysis.duration=0.05";
  EXPECT_TRUE(says(weaveform(check), "edges of tool 'die' run along the yarns"));
  for (const char* with :
       {" --set analysis.curved_contact=true", " --set accuracy.force=0.1", " --set blank.yarn_angle=30"})
    EXPECT_FALSE(says(weaveform(check + with), "run along the yarns")) << with;
}

TEST_F(AutomaticChoice, IsRefusedWhereAFoldersSceneWasOpenedByHand) {
  ASSERT_EQ(weaveform("mesh scene.toml --output out").exit_code, 0);
  test::write_text(belt, folder.path() / "out/scene.toml");
  const auto solve = weaveform("solve out");
  EXPECT_EQ(solve.exit_code, 2);
  EXPECT_TRUE(says(solve, "weaveform mesh")) << solve.err;
}

TEST_F(AutomaticChoice, AccuracyWithNothingToDecideIsSaid) {
  const auto check =
      weaveform("check scene.toml --set blank.coarsening=2 --set model.yarn=truss --set model.cell=membrane");
  EXPECT_EQ(check.exit_code, 0);
  EXPECT_TRUE(says(check, "[accuracy] decides nothing")) << check.err;
}

}  // namespace
}  // namespace weaveform
