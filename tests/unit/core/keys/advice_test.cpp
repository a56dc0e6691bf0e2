// Bounds printed with few digits, and the line of a bar.
#include "core/keys/advice.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/log/progress.hpp"

namespace {

using weaveform::progress_line;
using weaveform::rounded_down;
using weaveform::rounded_up;

TEST(Advice, ABoundAsPrintedStaysOnItsGoodSide) {
  for (double value = 1.234567890123e-7; value < 1e9; value *= 1.737) {
    for (const double signed_value : {value, -value}) {
      const double up = std::stod(fmt::format("{:.3g}", rounded_up(signed_value, 3)));
      const double down = std::stod(fmt::format("{:.3g}", rounded_down(signed_value, 3)));
      EXPECT_GE(up, signed_value);
      EXPECT_LE(down, signed_value);
      EXPECT_LE(up - down, 0.0101 * value);
    }
  }
}

TEST(Advice, ARoundNumberStaysItself) {
  for (const double value : {0.0, 1.0, 0.1, 0.3, 120.0, 1e-3, 2500.0}) {
    EXPECT_DOUBLE_EQ(rounded_up(value, 2), value);
    EXPECT_DOUBLE_EQ(rounded_down(value, 2), value);
  }
  EXPECT_TRUE(std::isnan(rounded_up(std::nan(""), 2)));
  EXPECT_TRUE(std::isinf(rounded_down(HUGE_VAL, 2)));
}

TEST(ProgressLine, KeepsWhatMattersMostAtAnyWidth) {
  const std::string note = "123.4 M cell-steps/s  step 1234567  kinetic/internal 0.012";
  for (int columns = 0; columns < 200; ++columns) {
    const std::string line = progress_line("solve", 0.37, note, "12:34:56", columns);
    EXPECT_LT(static_cast<int>(line.size()), std::max(columns, 1)) << line;
    if (columns < 30) continue;
    EXPECT_NE(line.find("37 %"), std::string::npos) << line;
    EXPECT_NE(line.find("left 12:34:56"), std::string::npos) << line;
  }
  EXPECT_NE(progress_line("solve", 0.37, note, "0:01", 80).find("cell-steps/s"), std::string::npos);
  EXPECT_NE(progress_line("solve", 0.37, note, "0:01", 120).find("kinetic/internal"), std::string::npos);
}

}  // namespace
