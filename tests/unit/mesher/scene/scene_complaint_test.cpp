// What a scene reader says about wrong scenes: the exact place, the nearest name, everything at once.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/keys/nearest_name.hpp"
#include "mesher/scene/reader.hpp"

namespace weaveform {
namespace {

using Lines = std::vector<std::string>;

Lines complaints_of(const std::string& text, const Lines& overrides = {}) {
  try {
    (void)read_scene_text(text, "s.toml", overrides);
  } catch (const InputError& error) {
    return error.complaints();
  }
  return {};
}

// The one complaint of a scene with one mistake.
std::string complaint_of(const std::string& text, const Lines& overrides = {}) {
  const auto lines = complaints_of(text, overrides);
  return lines.size() == 1 ? lines[0] : std::to_string(lines.size()) + " complaints";
}

const std::string grip = "[[grip]]\nname = \"top\"\nedge = \"top\"\n";

TEST(NearestName, CountsSwapsAsOneEdit) {
  EXPECT_EQ(edit_distance("travle", "travel"), 1U);
  EXPECT_EQ(edit_distance("size", "size"), 0U);
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
}

TEST(NearestName, ShowsEverythingWhenNothingIsNear) {
  EXPECT_EQ(did_you_mean("Szie", {"shape", "size"}), "; did you mean 'size'?");
  EXPECT_EQ(did_you_mean("qqqqqqqq", {"shape", "size"}), "; valid: shape, size");
}

TEST(SceneComplaint, UnknownKeyAndTableNameTheNearest) {
  EXPECT_EQ(complaint_of("[blank]\n  siez = [1, 2]\n"),
            "s.toml:2:3: unknown key 'siez' in [blank]; did you mean 'size'?");
  EXPECT_EQ(complaint_of("\n[blnk]\nsize = [1, 2]\n"), "s.toml:2:2: unknown table 'blnk'; did you mean 'blank'?");
  EXPECT_EQ(complaint_of("outptu = 3\n"),
            "s.toml:1:1: no key belongs outside a table: 'outptu'; did you mean 'output'?");
}

TEST(SceneComplaint, AToolFromCadIsToldItsShape) {
  EXPECT_EQ(complaint_of("[tools.die]\nshape = \"cad\"\nfile = \"die.step\"\n"),
            "s.toml:2:9: 'shape' is 'cad'; it must be one of 'plane', 'sphere', 'cylinder', 'ring', 'revolved', "
            "'triangles'; a CAD file (STEP, IGES, BREP, .geo) or an STL file is shape 'triangles'");
}

TEST(SceneComplaint, WrongTypesPointAtTheValue) {
  EXPECT_EQ(complaint_of("[blank]\nsize = 3\n"), "s.toml:2:8: 'size' is a whole number; it must be 2 numbers (mm)");
  EXPECT_EQ(complaint_of("[blank]\nsize = [1, 2, 3]\n"), "s.toml:2:8: 'size' has 3 values; it must be 2 numbers");
  EXPECT_EQ(complaint_of("[blank]\nsize = [1, \"a\"]\n"), "s.toml:2:12: 'size' is text; it must be a number (mm)");
  EXPECT_EQ(complaint_of("[output]\nframes = 2.5\n"),
            "s.toml:2:10: 'frames' is a number with a fraction; it must be a whole number");
  EXPECT_EQ(complaint_of("[analysis]\nstep_check = 1\n"),
            "s.toml:2:14: 'step_check' is a whole number; it must be true or false");
  EXPECT_EQ(complaint_of("[analysis]\nduration = \"never\"\n"),
            "s.toml:2:12: 'duration' is text; it must be a number or \"auto\" (s)");
  EXPECT_EQ(complaint_of("[blank]\ncoarsening = \"autoo\"\n"),
            "s.toml:2:14: 'coarsening' is text; it must be 1 or 2 numbers or \"auto\"");
  EXPECT_EQ(complaint_of("[model]\nyarn = 2020-01-01\n"), "s.toml:2:8: 'yarn' is a date or time; it must be text");
}

TEST(SceneComplaint, ValuesOutOfRangeShowTheRange) {
  EXPECT_EQ(complaint_of("[analysis]\nstep_factor = 5\n"),
            "s.toml:2:15: 'step_factor' is 5; it must be >= 0.0001 and <= 4");
  EXPECT_EQ(complaint_of("[analysis]\nstep_factor = 0\n"),
            "s.toml:2:15: 'step_factor' is 0; it must be >= 0.0001 and <= 4");
  EXPECT_EQ(complaint_of("[blank]\nsize = [1, -2]\n"), "s.toml:2:12: 'size' is -2; it must be > 0 and <= 100000 mm");
  EXPECT_EQ(complaint_of("[blank]\ncoarsening = 0.01\n"),
            "s.toml:2:14: 'coarsening' is 0.01; it must be >= 0.05 and <= 100");
  EXPECT_EQ(complaint_of("[blank]\nyarn_angle = nan\n"),
            "s.toml:2:14: 'yarn_angle' is nan; it must be a finite number");
  EXPECT_EQ(complaint_of("[output]\nframes = 99999999999\n"),
            "s.toml:2:10: 'frames' is 99999999999; it must be >= 0 and <= 10000");
}

TEST(SceneComplaint, WordsMustBeAmongTheAllowed) {
  EXPECT_EQ(complaint_of("[model]\nformulation = \"enrgy\"\n"),
            "s.toml:2:15: 'formulation' is 'enrgy'; it must be one of 'energy', 'contravariant', 'incremental', "
            "'side-frame'; did you mean 'energy'?");
  EXPECT_EQ(complaint_of(grip + "free = [\"x\", \"q\"]\n"),
            "s.toml:4:14: 'free' is 'q'; it must be one of 'x', 'y', 'z'"
            "; did you mean 'x'?");
  EXPECT_EQ(complaint_of(grip + "free = [\"x\", \"x\"]\n"), "s.toml:4:14: 'free' names 'x' twice; name it once");
  EXPECT_EQ(
      complaint_of("[fabric]\nmaterial = \"twintex-wp\"\n"),
      "s.toml:2:12: no built-in card is called 'twintex-wp', and a path needs a '/' or ends in .toml; did you mean "
      "'twintex-pw'?");
}

TEST(SceneComplaint, FormOfTables) {
  EXPECT_EQ(complaint_of("[grip]\nname = \"top\"\n"),
            "s.toml:1:1: 'grip' is a list of tables; begin each with [[grip]]");
  EXPECT_EQ(complaint_of("[[blank]]\nsize = [1, 2]\n"), "s.toml:1:1: 'blank' is one table; begin it with [blank]");
}

TEST(SceneComplaint, RequiredKeysPointAtTheirTable) {
  EXPECT_EQ(complaint_of("\n[[grip]]\nedge = \"top\"\n"),
            "s.toml:2:1: [[grip]] lacks the required key 'name'; add name = text");
}

TEST(SceneComplaint, ConflictingKeysPointAtTheSecond) {
  EXPECT_EQ(complaint_of(grip + "box = [0, 0, 1, 1]\n"), "s.toml:4:7: [[grip]] has both 'edge' and 'box'; keep one");
  EXPECT_EQ(complaint_of("[[grip]]\nname = \"a\"\n"), "s.toml:1:1: [[grip]] has neither 'edge' nor 'box'; add one");
  EXPECT_EQ(complaint_of("[[measure]]\nname = \"m\"\nbox = [0, 0, 1, 1]\nrelative_box = [0, 0, 1, 1]\n"),
            "s.toml:4:16: [[measure]] has both 'box' and 'relative_box'; keep one");
  EXPECT_EQ(complaint_of("[analysis]\nduration = 1\nloading_speed = 2\n"),
            "s.toml:3:17: [analysis] has both 'duration' and 'loading_speed'; keep one, each follows from the other");
  EXPECT_TRUE(complaints_of("[analysis]\nduration = \"auto\"\nloading_speed = 2\n").empty());
}

TEST(SceneComplaint, KeysWithoutMeaningPointAtWhatGivesThemOne) {
  EXPECT_EQ(complaint_of("[model]\npartner = \"compression\"\n"),
            "s.toml:2:11: 'partner' is 'compression', but yarn = 'truss' carries compression itself; set yarn = "
            "\"seatbelt\" or leave 'partner' out");
  EXPECT_EQ(complaint_of("[model]\nyarn_law = \"linear\"\nslack = 0.02\n"),
            "s.toml:3:9: 'slack' is 0.02, but yarn_law = 'linear' has none; set yarn_law = \"slack\" or leave 'slack' "
            "out");
  EXPECT_TRUE(complaints_of("[model]\nyarn = \"seatbelt\"\npartner = \"compression\"\n").empty());
  EXPECT_EQ(complaint_of("[model]\nyarn = \"seatbelt\"\ncompression_modulus = 20\n"),
            "s.toml:3:23: 'compression_modulus' is of no use here; it needs partner = \"compression\"");
  EXPECT_TRUE(complaints_of("[model]\ncompression_modulus = 20\n").empty());
  EXPECT_TRUE(complaints_of("[model]\nyarn_law = \"slack\"\nslack = 0.02\n").empty());
  EXPECT_TRUE(complaints_of("[model]\npartner = \"none\"\nslack = \"auto\"\n").empty());
}

TEST(SceneComplaint, NamesAndEdgesServeOnce) {
  EXPECT_EQ(complaint_of(grip + "[[grip]]\nname = \"top\"\nedge = \"bottom\"\n"),
            "s.toml:5:8: two [[grip]] are called 'top'; give each its own name");
  EXPECT_EQ(complaint_of(grip + "[[grip]]\nname = \"other\"\nedge = \"top\"\n"),
            "s.toml:6:8: edge 'top' is already held by grip 'top'; one grip per edge");
  EXPECT_EQ(complaint_of("[[grip]]\nname = \"1,a\"\nedge = \"top\"\n"),
            "s.toml:2:8: 'name' is '1,a'; it must begin with a letter and hold only letters, digits, '_' and '-'");
}

TEST(SceneComplaint, BoxesAndDirectionsMustHaveASize) {
  EXPECT_EQ(complaint_of("[[measure]]\nname = \"m\"\nbox = [0, 0, 0, 1]\n"),
            "s.toml:3:7: 'box' is [0, 0, 0, 1]; it must be xmin < xmax and ymin < ymax");
  EXPECT_EQ(complaint_of(grip + "direction = [0, 0, 0]\n"), "s.toml:4:13: 'direction' is zero; give it a length");
}

TEST(SceneComplaint, SyntaxErrorsHaveAPlace) {
  const auto complaint = complaint_of("[blank]\nsize = [1, 2\nshape = 3\n");
  EXPECT_TRUE(complaint.starts_with("s.toml:3:")) << complaint;
  EXPECT_TRUE(complaint_of("[blank]\nsize = [1, 2]\nsize = [1, 2]\n").starts_with("s.toml:3:"));
}

TEST(SceneComplaint, AllOfAFileAtOnceInItsOrder) {
  const Lines lines = complaints_of(
      "[output]\nframes = -1\n[blank]\nsize = 1\nsiez = 2\n[[grip]]\nedge = \"topp\"\n[modle]\n", {"blank.shape=oval"});
  ASSERT_EQ(lines.size(), 7U);
  EXPECT_TRUE(lines[0].starts_with("--set blank.shape: 'shape' is 'oval'")) << lines[0];
  EXPECT_TRUE(lines[1].starts_with("s.toml:2:10: ")) << lines[1];
  EXPECT_TRUE(lines[2].starts_with("s.toml:4:8: ")) << lines[2];
  EXPECT_TRUE(lines[3].starts_with("s.toml:5:1: ")) << lines[3];
  EXPECT_TRUE(lines[4].starts_with("s.toml:6:1: ")) << lines[4];
  EXPECT_TRUE(lines[5].starts_with("s.toml:7:8: ")) << lines[5];
  EXPECT_TRUE(lines[6].starts_with("s.toml:8:2: ")) << lines[6];
}

TEST(OverrideComplaint, NamesTheKey) {
  EXPECT_EQ(complaint_of("", {"blank.size=[1,true]"}),
            "--set blank.size: 'size' is true or false; it must be a number (mm)");
  EXPECT_EQ(complaint_of("", {"blank.siez=3"}),
            "--set blank.siez: unknown key 'siez' in [blank]; did you mean 'size'?");
  EXPECT_EQ(complaint_of("", {"blnk.size=3"}), "--set blnk.size: unknown table 'blnk'; did you mean 'blank'?");
  EXPECT_EQ(complaint_of("", {"output.frames=many"}),
            "--set output.frames: 'frames' is text; it must be a whole number");
  EXPECT_EQ(complaint_of("", {"blank=3"}), "--set blank: write blank.KEY=VALUE");
  EXPECT_EQ(complaint_of(grip, {"grip.travel=3"}), "--set grip.travel: write grip.NAME.KEY=VALUE");
  EXPECT_EQ(complaint_of("", {"blank.size"}),
            "--set blank.size: write --set KEY=VALUE, for example --set blank.size=[100,200]");
}

TEST(OverrideComplaint, ElementsMustExist) {
  EXPECT_EQ(complaint_of(grip, {"grip.tpo.travel=3"}),
            "--set grip.tpo.travel: no [[grip]] is called 'tpo' or has this index; did you mean 'top'?");
  EXPECT_EQ(complaint_of(grip, {"grip.1.travel=3"}).substr(0, 52),
            "--set grip.1.travel: no [[grip]] is called '1' or ha");
  EXPECT_EQ(complaint_of("", {"grip.0.travel=3"}),
            "--set grip.0.travel: no [[grip]] is called '0' or has this index; the scene has none");
}

TEST(OverrideComplaint, ValuesMustParse) {
  EXPECT_TRUE(complaint_of("", {"blank.size=[1,"}).starts_with("--set blank.size: '[1,' is not a value (")) << "no end";
  EXPECT_TRUE(complaint_of("", {"blank.size="}).starts_with("--set blank.size: '' is not a value (")) << "empty";
  EXPECT_TRUE(complaint_of("", {"blank.yarn_angle=1\nshape=2"}).starts_with("--set blank.yarn_angle: ")) << "two lines";
  EXPECT_TRUE(complaint_of("", {"fabric.material=a\x01"}).starts_with("--set fabric.material: "))
      << "control character";
}

}  // namespace
}  // namespace weaveform
