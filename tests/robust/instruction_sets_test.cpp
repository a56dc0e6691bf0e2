// One build runs on every processor of the architecture, and with the widest vectors of each (core/instructions).
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "tests/support/run_command.hpp"

namespace {

using weaveform::test::CommandResult;
using weaveform::test::read_text;
using weaveform::test::run_command;
using weaveform::test::TemporaryFolder;

const std::string tiny = std::string(WEAVEFORM_SOURCE_DIR) + "/tests/faults/tiny.toml";

// False for builds of another architecture or for one processor, and for instrumented ones, which hold more than ours.
bool has_several_sets() {
#ifdef WEAVEFORM_INSTRUMENTED
  return false;
#else
  const TemporaryFolder folder;
  return run_command("WEAVEFORM_INSTRUCTIONS=sse2 weaveform --version", folder.path()).exit_code == 0;
#endif
}

bool has(const std::string& program) {
  const TemporaryFolder folder;
  return run_command("command -v " + program, folder.path()).exit_code == 0;
}

TEST(InstructionSets, NothingButTheInnerLoopsNeedsMoreThanTheOldestProcessor) {
  if (!has_several_sets() || !has("objdump")) GTEST_SKIP() << "one instruction set, or no objdump";
  const TemporaryFolder folder;
  // functions with wide registers, or with an instruction of AVX, FMA or BMI, once each
  const CommandResult listed = run_command("objdump -d -C --no-show-raw-insn '" WEAVEFORM_BINARY
                                           "' | awk '/^[0-9a-f]+ <.*>:$/ { name = $0 } "
                                           "/%[yz]mm[0-9]|\\t(v[a-z]|(andn|bextr|bls(i|r|msk)|bzhi|mulx|pdep|pext|rorx|"
                                           "sarx|shlx|shrx)[ql]? )/ { print name }' | uniq",
                                           folder.path());
  ASSERT_EQ(listed.exit_code, 0) << listed.err;
  std::istringstream functions(listed.out);
  int inner = 0;
  for (std::string name; std::getline(functions, name);) {
    const bool is_inner =
        name.find("weaveform::avx2::") != std::string::npos || name.find("weaveform::avx512::") != std::string::npos;
    EXPECT_TRUE(is_inner) << name;
    inner += is_inner ? 1 : 0;
  }
  EXPECT_GT(inner, 100) << "the search itself is broken";
}

TEST(InstructionSets, ARunOnAnOldProcessorGivesTheBitsOfItsSet) {
  if (!has_several_sets() || !has("qemu-x86_64")) GTEST_SKIP() << "one instruction set, or no emulator (qemu-user)";
  const TemporaryFolder folder;
  const CommandResult version =
      run_command("qemu-x86_64 -cpu core2duo '" WEAVEFORM_BINARY "' --version", folder.path());
  EXPECT_EQ(version.exit_code, 0) << version.err;
  EXPECT_NE(version.out.find(", sse2)"), std::string::npos) << version.out;
  const CommandResult old = run_command(
      "qemu-x86_64 -cpu Nehalem '" WEAVEFORM_BINARY "' run '" + tiny + "' --quiet --output old", folder.path());
  EXPECT_EQ(old.exit_code, 0) << old.err;
  const CommandResult here =
      run_command("WEAVEFORM_INSTRUCTIONS=sse2 weaveform run '" + tiny + "' --quiet --output here", folder.path());
  EXPECT_EQ(here.exit_code, 0) << here.err;
  EXPECT_EQ(read_text(folder.path() / "old/history.csv"), read_text(folder.path() / "here/history.csv"));
}

// With tools the order in which contact forces are added up is that of the vectors' width.
TEST(InstructionSets, WithoutToolsBothWideSetsGiveTheSameBits) {
  const TemporaryFolder folder;
  const std::string run = " weaveform run '" + tiny + "' --quiet --output ";
  for (const std::string set : {"avx2", "avx512"})
    if (run_command("WEAVEFORM_INSTRUCTIONS=" + set + " weaveform --version", folder.path()).exit_code != 0)
      GTEST_SKIP() << "this processor or this build has no " << set;
  EXPECT_EQ(run_command("WEAVEFORM_INSTRUCTIONS=avx2" + run + "avx2", folder.path()).exit_code, 0);
  EXPECT_EQ(run_command("WEAVEFORM_INSTRUCTIONS=avx512" + run + "avx512", folder.path()).exit_code, 0);
  EXPECT_EQ(read_text(folder.path() / "avx2/history.csv"), read_text(folder.path() / "avx512/history.csv"));
}

TEST(InstructionSets, AnUnknownOneIsAnErrorThatNamesThem) {
  const TemporaryFolder folder;
  const CommandResult result = run_command("WEAVEFORM_INSTRUCTIONS=avx3 weaveform run '" + tiny + "'", folder.path());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("WEAVEFORM_INSTRUCTIONS=avx3: no such instruction set; known are sse2, avx2, avx512"),
            std::string::npos)
      << result.err;
}

}  // namespace
