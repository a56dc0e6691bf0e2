// Every source is as the formatter leaves it (./dev format), with the one version that all machines use.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/run_command.hpp"

namespace {

using weaveform::test::run_command;

TEST(Formatting, IsTheFormatters) {
  const auto has = run_command("command -v clang-format-14", WEAVEFORM_SOURCE_DIR);
  if (has.exit_code != 0) GTEST_SKIP() << "clang-format-14 is not installed";
  const auto result = run_command(
      "find core fabric mesher solver post app tests bench \\( -name '*.hpp' -o -name '*.cpp' \\) -print0 | "
      "xargs -0 clang-format-14 --style=file --dry-run --Werror 2>&1 | grep -c ' error: ' || true",
      WEAVEFORM_SOURCE_DIR);
  EXPECT_EQ(result.out, "0\n") << "./dev format, and look at what it changed";
}

}  // namespace
