// The exact shear frame: what the closed form makes of a travel, from the card alone.
#include "post/measure/frame_comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "core/vector/angle.hpp"
#include "fabric/trellis/shear_frame.hpp"

namespace weaveform {
namespace {

class FrameComparisonTest : public testing::Test {
protected:
  void SetUp() override {
    scene_.blank.size = {120.0, 120.0};
    scene_.frame.emplace();
    history_.column = {"time_s", scene_.frame->grip + ".displacement_mm", scene_.frame->grip + ".force_N"};
  }
  // A row whose load is `ratio` times that of Eqs. 5, 6 and 13.
  void add_row(double angle, double ratio) {
    const ShearFrame frame{scene_.frame->length, 120.0};
    const double force = card_.thickness * shear_stress(card_.shear, std::atanh(std::sin(angle)));
    history_.row.push_back({0.0, frame_displacement(frame, angle), ratio * frame_load(frame, force, angle)});
  }
  [[nodiscard]] FrameComparison compared() const { return compare_shear_frame(scene_, {&card_}, history_); }

  Scene scene_;
  Card card_ = load_card("twintex-pw", "");
  History history_;
};

TEST_F(FrameComparisonTest, IsExactForTheCardsOwnResponse) {
  for (const double angle : {0.0, 10.0 * degree, 45.0 * degree}) add_row(angle, 1.0);
  EXPECT_NEAR(compared().angle, 45.0 * degree, 1e-12);
  EXPECT_NEAR(compared().load, compared().ideal_load, 1e-12);
  EXPECT_LT(compared().worst_error, 1e-12);
}

TEST_F(FrameComparisonTest, TheWorstErrorCountsFrom5Degrees) {
  add_row(2.0 * degree, 3.0);
  add_row(20.0 * degree, 0.9);
  add_row(45.0 * degree, 1.02);
  EXPECT_NEAR(compared().worst_error, 0.1, 1e-12);
  EXPECT_NEAR(compared().load / compared().ideal_load, 1.02, 1e-12);
}

TEST_F(FrameComparisonTest, WorksInBothSenses) {
  add_row(-30.0 * degree, 0.95);
  EXPECT_NEAR(compared().angle, -30.0 * degree, 1e-12);
  EXPECT_NEAR(compared().worst_error, 0.05, 1e-12);
  history_.row.clear();
  EXPECT_THROW((void)compared(), InputError);
}

}  // namespace
}  // namespace weaveform
