// Libraries that only geometry needs are loaded when it is read: they cost each start more than all others together.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/run_command.hpp"

namespace {

using weaveform::test::CommandResult;
using weaveform::test::run_command;
using weaveform::test::says;
using weaveform::test::TemporaryFolder;
using weaveform::test::tiny_scene;
using weaveform::test::write_text;

const std::string block = "'" WEAVEFORM_SOURCE_DIR "/tests/data/cad/block_mm.igs'";

TEST(LateLibraries, AreLoadedForGeometryAlone) {
  const TemporaryFolder folder;
  write_text(tiny_scene(), folder.path() / "scene.toml");
  const CommandResult run = run_command("LD_DEBUG=files weaveform run scene.toml --quiet --output out", folder.path());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(says(run, "libvtkIOXML"));  // the loader does tell
  EXPECT_FALSE(says(run, "libTKernel"));
  EXPECT_FALSE(says(run, "libgmsh"));
  const CommandResult tool =
      run_command("LD_DEBUG=files weaveform tool " + block + " --output block.stl", folder.path());
  EXPECT_EQ(tool.exit_code, 0) << tool.err;
  EXPECT_TRUE(says(tool, "libTKernel"));
  EXPECT_FALSE(says(tool, "libgmsh"));
}

TEST(LateLibraries, ThatAreMissingAreAnErrorOfCadAlone) {
  const TemporaryFolder folder;
  write_text(tiny_scene(), folder.path() / "scene.toml");
  const CommandResult mesh =
      run_command("cp '" WEAVEFORM_BINARY "' alone && ./alone mesh scene.toml --quiet --output out", folder.path());
  EXPECT_EQ(mesh.exit_code, 0) << mesh.err;
  const CommandResult tool = run_command("./alone tool " + block + " --output block.stl", folder.path());
  EXPECT_EQ(tool.exit_code, 4);
  EXPECT_TRUE(says(tool, "weaveform-opencascade.so")) << tool.err;
  EXPECT_TRUE(says(tool, "install weaveform again")) << tool.err;
}

}  // namespace
