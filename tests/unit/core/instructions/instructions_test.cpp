#include "core/instructions/instructions.hpp"

#include <gtest/gtest.h>

#include <array>
#include <span>
#include <string>

#include "core/error.hpp"

namespace weaveform {
namespace {

constexpr std::array all = {Instructions::sse2, Instructions::avx2, Instructions::avx512};
constexpr std::array widest_alone = {Instructions::avx512};
constexpr std::array native = {Instructions::only};

std::string complaint(const char* asked, Instructions widest, std::span<const Instructions> built = all) {
  try {
    (void)choose_instructions(asked, widest, built);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Instructions, AreTheWidestWhenNoneAreAskedFor) {
  EXPECT_EQ(choose_instructions(nullptr, Instructions::avx512, all), Instructions::avx512);
  EXPECT_EQ(choose_instructions("", Instructions::sse2, all), Instructions::sse2);
  EXPECT_EQ(choose_instructions(nullptr, Instructions::avx512, widest_alone), Instructions::avx512);
  EXPECT_EQ(choose_instructions(nullptr, Instructions::avx512, native), Instructions::only);
}

TEST(Instructions, CanBeNarrowerThanTheProcessors) {
  EXPECT_EQ(choose_instructions("avx2", Instructions::avx512, all), Instructions::avx2);
  EXPECT_EQ(choose_instructions("sse2", Instructions::avx2, all), Instructions::sse2);
}

TEST(Instructions, ThatTheProcessorLacksAreRefused) {
  EXPECT_EQ(complaint("avx512", Instructions::avx2),
            "WEAVEFORM_INSTRUCTIONS=avx512: this processor has no avx512, its widest set is avx2");
}

TEST(Instructions, ThatTheBuildLacksAreRefused) {
  EXPECT_NE(complaint("avx2", Instructions::avx512, native), "");
  EXPECT_EQ(complaint("avx2", Instructions::avx512, widest_alone),
            "WEAVEFORM_INSTRUCTIONS=avx2: this program was built for avx512 alone; unset the variable, or build them "
            "all: `./dev build`, or cmake -DWEAVEFORM_INSTRUCTION_SETS=all build");
}

TEST(Instructions, OfAnotherMachineAreNotRunOnThisOne) {
  EXPECT_EQ(complaint(nullptr, Instructions::avx2, widest_alone),
            "this program was built for avx512 alone, and this processor's widest set is avx2; build them all: "
            "`./dev build`, or cmake -DWEAVEFORM_INSTRUCTION_SETS=all build");
}

TEST(Instructions, WithAnUnknownNameAreRefused) {
  EXPECT_NE(complaint("AVX2", Instructions::avx512), "");
  EXPECT_NE(complaint("avx", Instructions::avx512), "");
}

}  // namespace
}  // namespace weaveform
