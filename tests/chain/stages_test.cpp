// `run` is mesh, solve and post through the same files, so one by one they give the same bits.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/command_folder.hpp"

namespace {

namespace fs = std::filesystem;
using weaveform::test::read_text;
using weaveform::test::tiny_scene;
using weaveform::test::write_text;

// Files that hold neither wall-clock times nor thread counts.
const std::vector<std::string> reproducible = {"scene.toml",   "mesh.vtu",   "history.csv",
                                               "contours.vtp", "result.pvd", "frames/frame_0004.vtu"};

void expect_same_files(const fs::path& one, const fs::path& other) {
  for (const auto& name : reproducible) EXPECT_EQ(read_text(one / name), read_text(other / name)) << name;
}

class Stages : public weaveform::test::CommandFolder {
protected:
  void SetUp() override {
    write_text(tiny_scene(), file("tiny.toml"));
    ASSERT_EQ(run("weaveform run tiny.toml --output whole --quiet").exit_code, 0);
  }
};

TEST_F(Stages, OneByOneGiveTheSameFilesAsRun) {
  ASSERT_EQ(run("weaveform mesh tiny.toml --output parts --quiet").exit_code, 0);
  ASSERT_EQ(run("weaveform solve parts --quiet").exit_code, 0);
  ASSERT_EQ(run("weaveform post parts --quiet").exit_code, 0);
  expect_same_files(file("whole"), file("parts"));
}

TEST_F(Stages, GiveTheSameFilesWithAnyNumberOfThreads) {
  ASSERT_EQ(run("weaveform run tiny.toml --output threads --quiet --threads 3").exit_code, 0);
  expect_same_files(file("whole"), file("threads"));
}

}  // namespace
