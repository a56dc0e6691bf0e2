// Thickness after shear: what it is, where plies touch by it, and the forces that belong to it.
#include "solver/contact/sheared_thickness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/error.hpp"
#include "tests/support/stack.hpp"

namespace weaveform {
namespace {

constexpr double degrees = std::numbers::pi / 180.0;

double card_thickness() {
  static const double t = load_card("twintex-pw").thickness;
  return t;
}

Scene thickening_piece(std::array<double, 2> size, double coarsening, double yarn_angle, double z) {
  Scene scene = test::piece(size, coarsening, yarn_angle, z);
  scene.model.contact_thickness = ContactThickness::sheared;
  return scene;
}

// A trellis of yarns along x and y: those along y turn, none stretches.
Vec3 trellis(const Vec3& x, double angle) {
  return {x[0] + x[1] * std::sin(angle), x[1] * std::cos(angle), x[2]};
}

// Pressed without dampers: feet at rest, and those found that had none.
void rest(test::Stack& stack) {
  for (int n = 0; n < 40; ++n) stack.touch(1.0);
}

TEST(ShearedThickness, IsTheCardsOverTheCosineOfTheShearAngle) {
  test::Stack stack({thickening_piece({60.0, 40.0}, 1.0, 0.0, 0.0), test::piece({60.0, 40.0}, 1.0, 0.0, 50.0)});
  for (const double angle : {0.0, 20.0, -45.0, 60.0, 74.0, 80.0}) {
    stack.place(0, [&](const Vec3& x) { return trellis(x, angle * degrees); });
    stack.touch();
    const double expected = 1.0 / std::cos(std::min(std::abs(angle), 75.0) * degrees);
    for (const int n : stack.ply(0).packed().packed_of_mesh)
      EXPECT_NEAR(stack.sheared(0).swell()[n], expected, 1e-9 * expected) << angle;
  }
}

TEST(ShearedThickness, PliesTouchByHalfOfEachsOwn) {
  const double angle = 40.0, t = card_thickness(), sheared = t / std::cos(angle * degrees), depth = 0.06;
  for (const bool both : {false, true}) {
    Scene upper = thickening_piece({60.0, 60.0}, 1.3, 0.0, 3.0);
    if (!both) upper.model.contact_thickness = ContactThickness::card;
    test::Stack stack({thickening_piece({60.0, 60.0}, 1.0, 0.0, 0.0), upper});
    const double apart = both ? sheared : 0.5 * (sheared + t);
    for (auto& v : stack.ply(1).state().velocity[2]) v = -5.0;  // mm/s: what is clear has to look again
    stack.place(0, [&](const Vec3& x) { return trellis(x, angle * degrees); });
    for (double z = apart + 0.01; z > apart - depth; z -= 0.002) {
      stack.place(1, [&](const Vec3& x) {
        const Vec3 at = both ? trellis(x, angle * degrees) : x;
        return Vec3{at[0], at[1], z};
      });
      stack.touch(1.0);
      EXPECT_NEAR(stack.contact().pairs()[0].depth, std::max(apart - z, 0.0), 1e-6) << both;
    }
    EXPECT_GT(stack.contact().pairs()[0].force, 1.0);
  }
}

// Growing thickness alone brings plies to touch that nobody moves towards each other.
TEST(ShearedThickness, PliesComeToTouchByShearingAlone) {
  const double t = card_thickness();
  test::Stack stack(
      {thickening_piece({60.0, 60.0}, 1.0, 0.0, 0.0), thickening_piece({60.0, 60.0}, 1.0, 0.0, 1.15 * t)});
  double angle = 0.0;
  for (; angle < 35.0; angle += 0.5) {
    for (std::size_t k = 0; k < 2; ++k) stack.place(k, [&](const Vec3& x) { return trellis(x, angle * degrees); });
    stack.touch();
    const double room = 1.15 * t - t / std::cos(angle * degrees);
    if (room > 1e-6) {
      EXPECT_EQ(stack.contact().pairs()[0].force, 0.0) << angle;
    } else {
      EXPECT_NEAR(stack.contact().pairs()[0].depth, -room, 1e-6) << angle;
    }
  }
  EXPECT_GT(stack.contact().pairs()[0].force, 1.0);
}

// A surface that bends and shears from place to place, pressed into another.
void press_uneven(test::Stack& stack) {
  stack.place(0, [](const Vec3& x) -> Vec3 {
    return {x[0] + 8.0 * std::sin(0.05 * x[1]), x[1], x[2] + 0.5 * std::sin(0.05 * x[0])};
  });
  stack.place(1, [](const Vec3& x) -> Vec3 {
    return {x[0], x[1] + 6.0 * std::sin(0.06 * x[0] + 0.4), x[2] - 0.06 + 0.5 * std::sin(0.05 * x[0])};
  });
  rest(stack);
}

TEST(ShearedThickness, ForcesAndMomentsOfAPairSumToZero) {
  PairLaw law;
  law.friction = 0.3;
  for (const double yarn_angle : {0.0, 30.0}) {
    test::Stack stack({thickening_piece({60.0, 50.0}, 1.0, 0.0, 0.0),
                       thickening_piece({50.0, 60.0}, 1.3, yarn_angle, card_thickness())},
                      law);
    press_uneven(stack);
    const Vec3 f0 = stack.force(0), f1 = stack.force(1), m0 = stack.moment(0), m1 = stack.moment(1);
    const double force = stack.contact().pairs()[0].force;
    ASSERT_GT(force, 1.0);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(f0[c] + f1[c], 0.0, 1e-11 * force);
      EXPECT_NEAR(m0[c] + m1[c], 0.0, 1e-11 * force * 60.0);
    }
  }
}

// What is stored falls by what the forces do on the way, whichever way the nodes go: with forces on the plies' faces alone
// it would not.
TEST(ShearedThickness, ForcesAreTheGradientOfWhatIsStored) {
  test::Stack stack(
      {thickening_piece({60.0, 50.0}, 1.0, 0.0, 0.0), thickening_piece({50.0, 60.0}, 1.3, 30.0, card_thickness())});
  press_uneven(stack);
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  for (int way = 0; way < 3; ++way) {
    press_uneven(stack);
    std::array<Components, 2> direction;
    double work = 0.0;
    for (std::size_t k = 0; k < 2; ++k) {
      direction[k] = stack.ply(k).state().force;
      for (auto& component : direction[k]) std::fill(component.begin(), component.end(), 0.0);
      for (const int n : stack.ply(k).packed().packed_of_mesh)
        for (std::size_t c = 0; c < 3; ++c) {
          direction[k][c][n] = draw(generator);
          work += direction[k][c][n] * stack.ply(k).state().force[c][n];
        }
    }
    const double size = 1e-6;
    const auto stored_at = [&](double part) {
      for (std::size_t k = 0; k < 2; ++k)
        for (std::size_t c = 0; c < 3; ++c)
          for (const int n : stack.ply(k).packed().packed_of_mesh)
            stack.ply(k).state().position[c][n] += part * size * direction[k][c][n];
      rest(stack);
      return stack.contact().stored_energy().total;
    };
    const double ahead = stored_at(1.0), behind = stored_at(-2.0);
    EXPECT_NEAR((behind - ahead) / (2.0 * size), work, 1e-5 * std::abs(work)) << way;
  }
}

}  // namespace
}  // namespace weaveform
