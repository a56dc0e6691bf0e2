// What the fuzzer found worth keeping, read again by the ordinary build: seeds, and inputs that once broke a reader.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "core/files/files.hpp"
#include "solver/analysis/checkpoint.hpp"
#include "tests/fuzz/targets.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

const fs::path corpus = fs::path(WEAVEFORM_SOURCE_DIR) / "tests" / "fuzz" / "corpus";

class FuzzCorpus : public testing::TestWithParam<fuzz::Target> {};

TEST_P(FuzzCorpus, EveryInputGetsAnAnswer) {
  const auto& target = GetParam();
  int inputs = 0;
  for (const auto& entry : fs::directory_iterator(corpus / target.name)) {
    SCOPED_TRACE(entry.path().string());
    EXPECT_NO_THROW(target.read(read_text_file(entry.path())));
    ++inputs;
  }
  EXPECT_GT(inputs, 0);
  EXPECT_NO_THROW(target.read(""));
}

INSTANTIATE_TEST_SUITE_P(Readers, FuzzCorpus, testing::ValuesIn(fuzz::targets()),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(FuzzCorpusFolders, AreThoseOfTheTargets) {
  std::set<std::string> folders, names;
  for (const auto& entry : fs::directory_iterator(corpus)) folders.insert(entry.path().filename());
  for (const auto& target : fuzz::targets()) names.insert(target.name);
  EXPECT_EQ(folders, names);
}

// Those of another format are turned away by their first line, and try nothing.
TEST(FuzzCorpusFolders, HoldCheckpointsOfTodaysFormat) {
  const std::string today = checkpoint_bytes({}, [](Archive&) {}),
                    seed = read_text_file(corpus / "checkpoint" / "whole");
  EXPECT_EQ(seed.substr(0, seed.find('\n')), today.substr(0, today.find('\n')));
}

}  // namespace
}  // namespace weaveform
