// Outline geometry on polygons beyond the rectangle: concave, with a hole, with lines along edges.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "mesher/lattice/outline.hpp"

namespace weaveform::lattice {
namespace {

Outline polygon(const std::vector<std::vector<Vec2>>& rings) {
  Outline outline;
  for (const auto& ring : rings)
    for (std::size_t k = 0; k < ring.size(); ++k) outline.edge.push_back({ring[k], ring[(k + 1) % ring.size()], {}});
  return outline;
}

// An L of 10 x 10 without its upper right quarter, and a square with a square hole.
Outline letter_l() {
  return polygon({{{0, 0}, {10, 0}, {10, 5}, {5, 5}, {5, 10}, {0, 10}}});
}
Outline frame() {
  return polygon({{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{3, 3}, {3, 7}, {7, 7}, {7, 3}}});
}
Outline star() {
  std::vector<Vec2> ring;
  for (int k = 0; k < 14; ++k) {
    const double r = k % 2 == 0 ? 10.0 : 4.0;
    ring.push_back({r * std::cos(k * std::numbers::pi / 7.0 + 0.1), r * std::sin(k * std::numbers::pi / 7.0 + 0.1)});
  }
  return polygon({ring});
}

TEST(LatticeOutline, BoxesShareOutTheAreaWithoutAGap) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> cut(-9.0, 9.0);
  for (const auto& outline : {letter_l(), frame(), star()}) {
    const Box all{{-11.0, -11.0}, {11.0, 11.0}};
    const double total = moments_in_box(outline, all).area;
    for (int trial = 0; trial < 50; ++trial) {
      const double u = cut(random);
      const double v = cut(random);
      double sum = 0.0;
      for (const auto& [u0, u1] : {std::pair{-11.0, u}, std::pair{u, 11.0}})
        for (const auto& [v0, v1] : {std::pair{-11.0, v}, std::pair{v, 11.0}})
          sum += moments_in_box(outline, {{u0, v0}, {u1, v1}}).area;
      EXPECT_NEAR(sum, total, 1e-12 * total);
    }
  }
  EXPECT_NEAR(moments_in_box(letter_l(), {{-1, -1}, {11, 11}}).area, 75.0, 1e-12);
  EXPECT_NEAR(moments_in_box(frame(), {{-1, -1}, {11, 11}}).area, 84.0, 1e-12);
}

TEST(LatticeOutline, MomentsGiveTheCentroid) {
  const Moments m = moments_in_box(letter_l(), {{4.0, 4.0}, {6.0, 6.0}});  // 2 x 2 without its upper right quarter
  EXPECT_NEAR(m.area, 3.0, 1e-13);
  EXPECT_NEAR(m.first[0] / m.area, (4.5 * 2.0 + 5.5) / 3.0, 1e-13);
  EXPECT_NEAR(m.first[1] / m.area, (4.5 * 2.0 + 5.5) / 3.0, 1e-13);
}

TEST(LatticeOutline, ALineMayCrossSeveralTimes) {
  const auto across_hole = chords(frame(), 0, 5.0, 1e-7);
  ASSERT_EQ(across_hole.size(), 2U);
  EXPECT_NEAR(across_hole[0].to, 3.0, 1e-12);
  EXPECT_NEAR(across_hole[1].from, 7.0, 1e-12);
  EXPECT_EQ(chords(frame(), 1, 1.0, 1e-7).size(), 1U);
}

TEST(LatticeOutline, ALineAlongAnEdgeIsInsideToWithinRounding) {
  for (const double slip : {-1e-13, 0.0, 1e-13}) {
    const auto along = chords(letter_l(), 0, 10.0 + slip, 1e-7);
    ASSERT_EQ(along.size(), 1U) << slip;
    EXPECT_NEAR(along[0].to - along[0].from, 5.0, 1e-6);
    EXPECT_NEAR(chords(letter_l(), 1, 0.0 + slip, 1e-7).front().to, 10.0, 1e-6) << slip;
    EXPECT_NEAR(chords(letter_l(), 0, 5.0 + slip, 1e-7).front().to, 10.0, 1e-6) << slip;  // the longer of both sides
  }
  EXPECT_TRUE(chords(letter_l(), 0, 10.1, 1e-7).empty());
}

TEST(LatticeOutline, TurnsByQuartersAndEighthsAreExact) {
  EXPECT_EQ(turn_by_degrees(90.0).cosine, 0.0);
  EXPECT_EQ(turn_by_degrees(-90.0).sine, -1.0);
  EXPECT_EQ(turn_by_degrees(180.0).cosine, -1.0);
  EXPECT_EQ(turn_by_degrees(45.0).cosine, turn_by_degrees(45.0).sine);
  EXPECT_EQ(turn_by_degrees(-135.0).cosine, turn_by_degrees(-135.0).sine);
  EXPECT_NEAR(turn_by_degrees(200.0).sine, std::sin(200.0 * std::numbers::pi / 180.0), 1e-15);
}

}  // namespace
}  // namespace weaveform::lattice
