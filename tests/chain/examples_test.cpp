// Every scene of examples/ is accepted and runs to its table, here with every other yarn to save time; under the
// sanitizers, which take thirty times as long, with every fourth.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/run_command.hpp"

namespace {

namespace fs = std::filesystem;
using weaveform::test::run_command;
using weaveform::test::TemporaryFolder;

std::vector<std::string> examples() {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator(fs::path(WEAVEFORM_SOURCE_DIR) / "examples"))
    if (entry.path().extension() == ".toml") found.push_back(entry.path().stem().string());
  return found;
}

std::string coarsened([[maybe_unused]] const std::string& example) {
#ifdef WEAVEFORM_INSTRUMENTED
  if (example != "cantilever_pw") return " --set blank.coarsening=4";  // a strip of few yarns
#endif
  return " --set blank.coarsening=2";
}

class Example : public testing::TestWithParam<std::string> {};

TEST_P(Example, RunsCoarsened) {
  const TemporaryFolder folder;
  const std::string scene = "'" WEAVEFORM_SOURCE_DIR "/examples/" + GetParam() + ".toml'";
  const auto check = run_command("weaveform check " + scene, folder.path());
  EXPECT_EQ(check.exit_code, 0) << check.err;
  const auto run = run_command("weaveform run " + scene + " --output out" + coarsened(GetParam()), folder.path());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out, "") << "the table of results";
}

INSTANTIATE_TEST_SUITE_P(Examples, Example, testing::ValuesIn(examples()),
                         [](const auto& instance) { return instance.param; });

}  // namespace
