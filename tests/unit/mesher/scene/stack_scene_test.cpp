// Scenes of several plies: what a ply takes over and leaves behind, round trip, overrides, and what is said of wrong ones.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "mesher/scene/ply_scene.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/scene/values.hpp"

namespace weaveform {
namespace {

using Texts = std::vector<std::string>;

const std::string two_plies = R"([blank]
size = [100, 200]
[model]
yarn = "beam"
yarn_bending = 2.0
[[ply]]
name = "lower"
yarn_angle = 0
[[ply]]
name = "upper"
yarn = "truss"
material = "twintex-tw"
)";

Scene stack_scene(const std::string& text, const Texts& overrides = {}) {
  return read_scene_text(text, "s.toml", overrides);
}

Texts stack_complaints(const std::string& text, const Texts& overrides = {}) {
  try {
    (void)stack_scene(text, overrides);
  } catch (const InputError& error) {
    return error.complaints();
  }
  return {};
}

std::string stack_complaint(const std::string& text, const Texts& overrides = {}) {
  const auto lines = stack_complaints(text, overrides);
  return lines.size() == 1 ? lines[0] : std::to_string(lines.size()) + " complaints";
}

TEST(StackScene, APlyTakesOverWhatItLeavesOutAndLeavesBehindWhatIsOfNoUseToIt) {
  const Scene scene = stack_scene(two_plies);
  ASSERT_EQ(scene.ply.size(), 2U);
  EXPECT_EQ(scene.ply[0].blank.size, (std::array{100.0, 200.0}));
  EXPECT_EQ(scene.ply[0].model.yarn_bending, (std::array{2.0, 2.0}));
  EXPECT_EQ(scene.ply[1].model.yarn_bending, std::nullopt) << "a truss bends not at all";
  EXPECT_EQ(scene.ply[1].blank.yarn_angle, 45.0);
  EXPECT_EQ(scene_of_ply(scene, 1).fabric.material, "twintex-tw");
  EXPECT_EQ(scene_of_ply(scene, 0).fabric.material, "twintex-pw");
}

TEST(StackScene, AnyPlyMayLieFaceDown) {
  const Scene scene = stack_scene(two_plies + "face = \"down\"\n");
  EXPECT_EQ(scene_of_ply(scene, 0).fabric.face, FabricFace::up);
  EXPECT_EQ(scene_of_ply(scene, 1).fabric.face, FabricFace::down);
}

TEST(StackScene, AShapeOfItsOwnDoesNotBringTheOthersCorners) {
  const Scene scene = stack_scene(
      "[blank]\nshape = \"polygon\"\ncorners = [[0, 0], [90, 0], [0, 90]]\n[[ply]]\nname = \"a\"\n[[ply]]\nname = "
      "\"b\"\nshape = \"disc\"\nsize = [80, 80]\n");
  EXPECT_EQ(scene.ply[0].blank.corners.size(), 3U);
  EXPECT_TRUE(scene.ply[1].blank.corners.empty());
}

TEST(StackScene, AnEchoReadsBackToTheSameScene) {
  const std::string all = two_plies + R"(position = [1, 2, 3]
[stack]
friction = 0.25
friction_law = "slip.csv"
gap = 0.1
[[stack.pair]]
plies = ["upper", "lower"]
friction = 0.4
compaction = "press.csv"
[[grip]]
name = "held"
edge = "top"
plies = ["upper"]
[[measure]]
name = "middle"
box = [-5, -5, 5, 5]
ply = "lower"
)";
  const Scene scene = stack_scene(all);
  EXPECT_EQ(stack_scene(scene_to_toml(scene)), scene);
  EXPECT_EQ(scene.ply[1].position, (std::array{1.0, 2.0, 3.0}));
  // also where [blank] and [model] have what the plies have not
  const Scene polygon = stack_scene(
      "[blank]\nshape = \"polygon\"\ncorners = [[0, 0], [90, 0], [0, 90]]\non_roll = [1, 2]\n[model]\nyarn_law = "
      "\"slack\"\nslack = 0.1\n[[ply]]\nname = \"b\"\nshape = \"rectangle\"\nphase = [0.5, 0]\nyarn_law = \"card\"\n");
  EXPECT_EQ(stack_scene(scene_to_toml(polygon)), polygon);
  EXPECT_EQ(polygon.ply[0].blank.on_roll, std::nullopt);
}

TEST(StackScene, ASceneWithoutPliesSaysNothingOfThem) {
  const std::string echo =
      scene_to_toml(stack_scene("[blank]\nsize = [10, 20]\n[[grip]]\nname = \"a\"\nedge = \"top\"\n"));
  for (const char* word : {"ply", "plies", "stack"}) EXPECT_EQ(echo.find(word), std::string::npos) << word;
}

TEST(StackScene, PliesAndPairsAreSetByNameAndNumber) {
  const std::string all = two_plies + "[stack]\nfriction = 0.25\n[[stack.pair]]\nplies = [\"lower\", \"upper\"]\n";
  const Scene scene = stack_scene(
      all, {"ply.upper.yarn_angle=30", "ply.0.coarsening=3", "stack.friction=0.5", "stack.pair.0.friction=0.75"});
  EXPECT_EQ(scene.ply[1].blank.yarn_angle, 30.0);
  EXPECT_EQ(scene.ply[0].blank.coarsening, (std::array{3.0, 3.0}));
  EXPECT_EQ(scene.stack.friction, 0.5);
  EXPECT_EQ(pair_of(scene.stack, "upper", "lower").friction, 0.75);
  EXPECT_EQ(stack_complaint(all, {"ply.uper.yarn_angle=30"}),
            "--set ply.uper.yarn_angle: no [[ply]] is called 'uper' or has this index; did you mean 'upper'?");
  EXPECT_EQ(
      stack_complaint(all, {"stack.pair.3.friction=0.75"}),
      "--set stack.pair.3.friction: write stack.pair.NUMBER.KEY=VALUE; the scene has 1 [[stack.pair]], counted from "
      "0");
}

TEST(StackScene, ValuesGoByThePliesNames) {
  bool found = false;
  for (const auto& [key, value] : scene_values(stack_scene(two_plies)))
    found = found || (key == "ply.upper.material" && value == "'twintex-tw'") ||
            (key == "ply.upper.material" && value == "\"twintex-tw\"");
  EXPECT_TRUE(found);
}

TEST(StackScene, WrongKeysTypesAndRangesPointAtTheirPlace) {
  EXPECT_EQ(stack_complaint("[[ply]]\nname = \"a\"\nyarn_angel = 3\n"),
            "s.toml:3:1: unknown key 'yarn_angel' in [[ply]]; did you mean 'yarn_angle'?");
  EXPECT_EQ(stack_complaint("[[ply]]\nname = \"a\"\nsize = 3\n"),
            "s.toml:3:8: 'size' is a whole number; it must be 2 numbers (mm)");
  EXPECT_EQ(stack_complaint("[[ply]]\nname = \"a\"\ncoarsening = 0.01\n"),
            "s.toml:3:14: 'coarsening' is 0.01; it must be >= 0.05 and <= 100");
  EXPECT_EQ(stack_complaint("[[ply]]\nname = \"a\"\nsymmetry = \"none\"\n").substr(0, 45),
            "s.toml:3:1: unknown key 'symmetry' in [[ply]]");
  EXPECT_EQ(stack_complaint("[ply]\nname = \"a\"\n"), "s.toml:1:1: 'ply' is a list of tables; begin each with [[ply]]");
  EXPECT_EQ(stack_complaint("[[ply]]\nyarn_angle = 0\n"),
            "s.toml:1:1: [[ply]] lacks the required key 'name'; add name = text");
  EXPECT_EQ(stack_complaint("[[ply]]\nname = \"a\"\n[[ply]]\nname = \"a\"\n"),
            "s.toml:4:8: two [[ply]] are called 'a'; give each its own name");
  EXPECT_EQ(stack_complaint("[[ply]]\nname = \"a\"\n[stack]\nfrction = 1\n"),
            "s.toml:4:1: unknown key 'frction' in [stack]; did you mean 'friction'?");
  EXPECT_EQ(stack_complaint("[[ply]]\nname = \"a\"\n[stack]\nfriction = -1\n"),
            "s.toml:4:12: 'friction' is -1; it must be >= 0 and <= 10");
  EXPECT_EQ(stack_complaint("[stack]\nfriction = 1\n"),
            "s.toml:1:1: [stack] is of no use without plies; add a [[ply]] for each, or leave it out");
}

TEST(StackScene, NamesOfPliesAreLookedUp) {
  const std::string all = "[[ply]]\nname = \"lower\"\n[[ply]]\nname = \"upper\"\n";
  EXPECT_EQ(stack_complaint(all + "[[grip]]\nname = \"g\"\nedge = \"top\"\nplies = [\"uper\"]\n"),
            "s.toml:8:9: 'plies' names 'uper', and there is no such [[ply]]; did you mean 'upper'?");
  EXPECT_EQ(stack_complaint(all + "[[measure]]\nname = \"m\"\nbox = [0, 0, 1, 1]\nply = \"mid\"\n"),
            "s.toml:8:7: 'ply' names 'mid', and there is no such [[ply]]; valid: lower, upper");
  EXPECT_EQ(stack_complaint(all + "[stack]\n[[stack.pair]]\nplies = [\"lower\"]\n"),
            "s.toml:7:9: 'plies' has 1 names; it must be 2");
  EXPECT_EQ(stack_complaint("[[grip]]\nname = \"g\"\nedge = \"top\"\nplies = [\"a\"]\n"),
            "s.toml:4:9: 'plies' names 'a', and there is no such [[ply]]; the scene has none");
}

TEST(StackScene, AnEdgeOfEachPlyHasOneGrip) {
  const std::string all = "[[ply]]\nname = \"a\"\n[[ply]]\nname = \"b\"\n[[grip]]\nname = \"one\"\nedge = \"top\"\n";
  EXPECT_TRUE(
      stack_complaints(all + "plies = [\"a\"]\n[[grip]]\nname = \"two\"\nedge = \"top\"\nplies = [\"b\"]\n").empty());
  EXPECT_EQ(stack_complaint(all + "[[grip]]\nname = \"two\"\nedge = \"top\"\nplies = [\"b\"]\n"),
            "s.toml:10:8: edge 'top' is already held by grip 'one'; one grip per edge");
}

}  // namespace
}  // namespace weaveform
