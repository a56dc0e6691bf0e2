// `weaveform tool`: what it says of a surface, in whatever unit, and of a script that does more than describe one.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

using weaveform::test::says;

class ToolCommand : public testing::Test {
protected:
  test::CommandResult tool(const std::string& arguments) {
    return test::run_command("weaveform tool " + arguments, folder_.path());
  }
  void write(const std::string& name, const std::string& text) { test::write_text(text, folder_.path() / name); }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }

private:
  test::TemporaryFolder folder_;
};

const std::string box = "SetFactory(\"OpenCASCADE\");\nBox(1) = {-2, 1, 0.5, 4, 3, 2};\n";

TEST_F(ToolCommand, SaysWhereTheSurfaceLies) {
  write("box.geo", box);
  const test::CommandResult mm = tool("box.geo");
  ASSERT_EQ(mm.exit_code, 0) << mm.err;
  EXPECT_TRUE(says(mm.out, "4 x 3 x 2 mm from (-2, 1, 0.5) to (2, 4, 2.5)")) << mm.out;
  const test::CommandResult inch = tool("box.geo --unit inch");
  EXPECT_TRUE(says(inch.out, "from (-50.8, 25.4, 12.7) to (50.8, 101.6, 63.5)")) << inch.out;
  EXPECT_TRUE(says(inch.out, "closed, volume 393290 mm3")) << inch.out;
  EXPECT_EQ(tool("box.geo --unit furlong").exit_code, 2);
}

TEST_F(ToolCommand, WritesInAnyCaseOfEndingsAndRefusesWhatCannotBe) {
  write("box.geo", box);
  for (const char* name : {"copy.Stp", "copy.BREP", "copy.StL"}) {
    ASSERT_EQ(tool(std::string("box.geo -o ") + name).exit_code, 0) << name;
    const test::CommandResult back = tool(name);
    EXPECT_TRUE(says(back.out, "12 triangles in 1 piece, 4 x 3 x 2 mm")) << back.out << back.err;
  }
  EXPECT_EQ(tool("copy.StL -o back.step").exit_code, 2) << "triangles are no CAD";
  EXPECT_EQ(tool("copy.Stp --unit m").exit_code, 2) << "it names its unit";
}

TEST_F(ToolCommand, AScriptThatSavesOrExitsIsRefusedByItsLineAndTouchesNothing) {
  write("part.geo", box + "Mesh 2;\nSave \"kept.msh\";\nExit;\n");
  write("kept.msh", "keep");
  const test::CommandResult result = tool("part.geo");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(says(result.err, "part.geo:4:1: 'Save'")) << result.err;
  EXPECT_TRUE(says(result.err, "part.geo:5:1: 'Exit'")) << result.err;
  EXPECT_EQ(test::read_text(folder() / "kept.msh"), "keep");
}

// A face that the reader lost is no silent hole.
TEST_F(ToolCommand, WhatTheReaderComplainedOfIsAWarning) {
  write("box.geo", box);
  ASSERT_EQ(tool("box.geo -o box.step").exit_code, 0);
  std::string step = test::read_text(folder() / "box.step");
  const std::size_t at = step.find("PLANE('',");
  ASSERT_NE(at, std::string::npos);
  step.replace(at, step.find(';', at) - at, "PLANE('')");
  write("box.step", step);
  const test::CommandResult result = tool("box.step");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(says(result.out, "open, 1 border")) << result.out;
  EXPECT_TRUE(says(result.out, "PLANE: Count of Parameters is not 2")) << result.out;
  write("scene.toml",
        "[fabric]\nmaterial = \"twintex-pw\"\n[blank]\nsize = [40, 40]\nyarn_angle = 0\n[tools.box]\n"
        "shape = \"triangles\"\nfile = \"box.step\"\nposition = [0, 0, -30]\ntravel = 5\ndirection = [0, 0, 1]\n"
        "[analysis]\nduration = 0.01\n");
  const test::CommandResult checked = test::run_command("weaveform check scene.toml", folder());
  EXPECT_TRUE(says(checked.err, "warning: scene.toml: [tools.box] box.step: entity")) << checked.err;
  EXPECT_EQ(test::run_command("weaveform check scene.toml --set tools.box.file=none.igs", folder()).exit_code, 4);
}

}  // namespace
}  // namespace weaveform
