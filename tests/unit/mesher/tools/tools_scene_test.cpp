// [tools.NAME] in scene files: keys, overrides, complaints, and where tools stand when the scene leaves it to them.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/vector/vector.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/tools/tool.hpp"

namespace weaveform {
namespace {

const std::string hemisphere_scene = R"([tools.punch]
shape = "sphere"
radius = 75
travel = 90
friction = 0.3
[tools.binder]
shape = "ring"
axis = [0, 0, -2]
opening_radius = 77
force = 650
[tools.die]
shape = "ring"
opening_radius = 77
fillet_radius = 15
)";

std::string scene_complaint(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    (void)read_scene_text(text, "s.toml", overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ToolScene, ToolsAreNamedByTheirTablesAndComeInTheOrderOfNames) {
  const Scene scene = read_scene_text(hemisphere_scene, "s.toml");
  ASSERT_EQ(scene.tools.size(), 3U);
  EXPECT_EQ(scene.tools[0].name, "binder");
  EXPECT_EQ(scene.tools[0].force, 650.0);
  EXPECT_EQ(scene.tools[1].name, "die");
  EXPECT_EQ(scene.tools[2].name, "punch");
  EXPECT_EQ(scene.tools[2].radius, 75.0);
}

TEST(ToolScene, EchoReadsBackToTheSameTools) {
  Scene scene = read_scene_text(hemisphere_scene, "s.toml");
  scene.tools[2].speed = {{0, 0}, {0.25, 1}, {1, 1.0 / 3.0}};
  scene.tools[2].direction = {{0.1, 0, -1}};
  scene.tools[2].offset = 0.0;
  EXPECT_EQ(read_scene_text(scene_to_toml(scene), "s.toml"), scene) << scene_to_toml(scene);
}

TEST(ToolScene, AGentleSpeedIsFastAtFirstAndEverSlowerToTheEnd) {
  const Scene scene = read_scene_text(hemisphere_scene, "s.toml", {"tools.punch.speed=gentle"});
  const auto& speed = scene.tools[2].speed;
  ASSERT_GE(speed.size(), 3U);
  EXPECT_EQ(speed.front(), (std::vector<double>{0, 0}));
  EXPECT_EQ(speed.back().front(), 1.0);
  EXPECT_LT(speed.back()[1], 0.2);
  for (std::size_t n = 2; n < speed.size(); ++n) EXPECT_LE(speed[n][1], speed[n - 1][1]);
  EXPECT_EQ(read_scene_text(scene_to_toml(scene), "s.toml"), scene);
  EXPECT_NE(scene_complaint(hemisphere_scene, {"tools.punch.speed=gentel"})
                .find("it must be a list of lists of numbers or \"gentle\""),
            std::string::npos);
}

TEST(ToolScene, OverridesReachANamedTool) {
  const Scene scene = read_scene_text(hemisphere_scene, "s.toml", {"tools.punch.travel=60", "tools.die.friction=0.1"});
  EXPECT_EQ(scene.tools[2].travel, 60.0);
  EXPECT_EQ(scene.tools[1].friction, 0.1);
  EXPECT_EQ(scene_complaint(hemisphere_scene, {"tools.punsh.travel=60"}),
            "--set tools.punsh.travel: no [tools.punsh]; did you mean 'punch'?");
  EXPECT_EQ(scene_complaint(hemisphere_scene, {"tools.travel=60"}), "--set tools.travel: write tools.NAME.KEY=VALUE");
}

TEST(ToolScene, EachComplaintSaysWhereAndWhat) {
  const std::string text = R"([tools.a]
shape = "spere"
[tools.b]
shape = "sphere"
opening_radius = 3
[tools.c]
shape = "plane"
travel = 3
force = 4
speed = [[0, 1], [0.5, 1]]
[tools.d]
shape = "cylinder"
radius = 2
axis = [0, 0, 0]
[tools.e]
shape = "ring"
opening_radius = 2
axis = [1, 0, 0]
[tools.f]
shape = "revolved"
profile = [1, 2]
position = [0, 0, 0]
mass = 1e-4
)";
  const std::string all = scene_complaint(text);
  for (const char* line :
       {"s.toml:2:9: 'shape' is 'spere'", "did you mean 'sphere'", "s.toml:3:1: [tools.b] lacks 'radius'",
        "s.toml:5:18: 'opening_radius' means nothing to the shape 'sphere'; it belongs to ring",
        "s.toml:9:9: [tools.c] has both 'travel' and 'force'", "'speed' must begin at part 0 and end at part 1",
        "s.toml:11:1: [tools.d] lacks 'position'", "s.toml:14:8: 'axis' is zero",
        "s.toml:15:1: [tools.e] lacks 'position'", "s.toml:21:12: 'profile' is",
        "s.toml:23:8: 'mass' is that of a tool"})
    EXPECT_NE(all.find(line), std::string::npos) << line << "\nin\n" << all;
  EXPECT_NE(scene_complaint("[tools]\npunch = 3").find("begin each with [tools.NAME]"), std::string::npos);
  EXPECT_NE(scene_complaint("[[tools]]\nshape = \"plane\"").find("begin each with [tools.NAME]"), std::string::npos);
}

TEST(ToolScene, ToolsLeftToThemselvesTouchTheBlank) {
  Scene scene = read_scene_text(hemisphere_scene, "s.toml");
  scene.blank.position = {1.0, 2.0, 3.0};
  const auto tools = make_tools(scene, 0.5);
  EXPECT_EQ(tools[0].start.origin, (Vec3{1.0, 2.0, 3.25}));   // binder, facing down
  EXPECT_EQ(tools[1].start.origin, (Vec3{1.0, 2.0, 2.75}));   // die, facing up
  EXPECT_EQ(tools[2].start.origin, (Vec3{1.0, 2.0, 78.25}));  // punch, tip down
  EXPECT_EQ(tools[0].direction, (Vec3{0.0, 0.0, -1.0}));
  EXPECT_EQ(tools[1].direction, (Vec3{0.0, 0.0, 1.0}));
  EXPECT_EQ(tools[2].direction, (Vec3{0.0, 0.0, -1.0}));
}

}  // namespace
}  // namespace weaveform
