// Standard streams that are closed, full or read no further, and limits on files and memory: an exit code of ours, a
// message where one can be had, never a signal's.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/command_folder.hpp"

namespace {

namespace fs = std::filesystem;
using weaveform::test::read_text;
using weaveform::test::tiny_scene;
using weaveform::test::write_text;

class StreamsAndLimits : public weaveform::test::CommandFolder {
protected:
  void SetUp() override {
    std::string scene = tiny_scene();
    write_text(scene + "\n[analysis]\nduration = 0.004\n", file("tiny.toml"));
  }
};

TEST_F(StreamsAndLimits, ARunGoesToItsEndWithStandardOutputAndErrorClosed) {
  EXPECT_EQ(run("weaveform run tiny.toml -o out >&- 2>&- <&-").exit_code, 4) << "its table could not be given";
  EXPECT_TRUE(fs::exists(file("out/summary.json")));
  EXPECT_EQ(run("weaveform run tiny.toml -o quiet --quiet >&- 2>&- <&-").exit_code, 0);
  const std::string scene = read_text(file("quiet/scene.toml"));
  EXPECT_TRUE(scene.starts_with("# Written by weaveform")) << "a file took the number of a closed stream: " << scene;
}

TEST_F(StreamsAndLimits, ALogThatCannotBeWrittenStopsNothing) {
  EXPECT_EQ(run("weaveform run tiny.toml -o out 2>/dev/full").exit_code, 0);
  EXPECT_EQ(run("weaveform run tiny.toml -o out 2>&-").exit_code, 0);
}

TEST_F(StreamsAndLimits, ALogReaderThatGoesStopsNothing) {
  const auto result = run("( weaveform run tiny.toml -o out 2>&1 >/dev/null; echo $? >code ) | head -n 1 >/dev/null");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(read_text(file("code")), "0\n");
  EXPECT_TRUE(fs::exists(file("out/summary.json")));
}

TEST_F(StreamsAndLimits, AnAnswerThatCannotBeWrittenIsFileTrouble) {
  for (const std::string to : {">&-", ">/dev/full"})
    for (const std::string command : {"check tiny.toml", "keys", "--help", "--version", "run --help"}) {
      const auto result = run("weaveform " + command + " " + to);
      EXPECT_EQ(result.exit_code, 4) << command << to;
      EXPECT_NE(result.err.find("standard output"), std::string::npos) << command << to << result.err;
    }
}

TEST_F(StreamsAndLimits, EveryErrorKeepsItsCodeWithoutStandardError) {
  EXPECT_EQ(run("weaveform nonsense >&- 2>&-").exit_code, 2);
  EXPECT_EQ(run("weaveform check tiny.toml --set blank.sise=3 2>/dev/full").exit_code, 2);
  EXPECT_EQ(run("weaveform post absent 2>&-").exit_code, 4);
}

TEST_F(StreamsAndLimits, AFileBeyondTheLimitOfItsSizeIsFileTrouble) {
  for (const int blocks : {0, 1, 8, 20}) {
    // the reader of what it says is not limited
    const auto result =
        run("( ulimit -f " + std::to_string(blocks) + "; weaveform run tiny.toml -o out -q 2>&1 ) | cat");
    EXPECT_NE(result.out.find("cannot be written"), std::string::npos) << blocks << result.out;
    EXPECT_EQ(run("ulimit -f " + std::to_string(blocks) + "; weaveform run tiny.toml -o out -q").exit_code, 4);
  }
}

// The mesh alone takes ten times what the limit leaves, and --yes says to try.
#if !defined(__SANITIZE_ADDRESS__)  // which takes terabytes of address space for itself
TEST_F(StreamsAndLimits, NoMemoryLeftIsFileTrouble) {
  const auto result =
      run("ulimit -v 500000; weaveform run tiny.toml -o out -q --set blank.coarsening=0.05 --set blank.size=[900,900] "
          "--yes");
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_NE(result.err.find("no memory left"), std::string::npos) << result.err;
}
#endif

}  // namespace
