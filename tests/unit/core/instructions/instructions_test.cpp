#include "core/instructions/instructions.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"

namespace weaveform {
namespace {

std::string complaint(const char* asked, Instructions best) {
  try {
    (void)choose_instructions(asked, best);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Instructions, AreTheWidestWhenNoneAreAskedFor) {
  EXPECT_EQ(choose_instructions(nullptr, Instructions::avx512), Instructions::avx512);
  EXPECT_EQ(choose_instructions("", Instructions::sse2), Instructions::sse2);
}

TEST(Instructions, CanBeNarrowerThanTheProcessors) {
  EXPECT_EQ(choose_instructions("avx2", Instructions::avx512), Instructions::avx2);
  EXPECT_EQ(choose_instructions("sse2", Instructions::avx2), Instructions::sse2);
}

TEST(Instructions, ThatTheProcessorLacksAreRefused) {
  EXPECT_EQ(complaint("avx512", Instructions::avx2),
            "WEAVEFORM_INSTRUCTIONS=avx512: this processor has no avx512, its widest set is avx2");
  EXPECT_NE(complaint("avx2", Instructions::only), "");
}

TEST(Instructions, WithAnUnknownNameAreRefused) {
  EXPECT_NE(complaint("AVX2", Instructions::avx512), "");
  EXPECT_NE(complaint("avx", Instructions::avx512), "");
}

}  // namespace
}  // namespace weaveform
