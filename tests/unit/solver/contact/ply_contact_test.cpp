// Contact between plies: what acts between surfaces placed by hand.
#include "solver/contact/ply_contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/error.hpp"
#include "tests/support/stack.hpp"

namespace weaveform {
namespace {

using test::piece;
using test::Stack;

double thickness() {
  static const double t = load_card("twintex-pw").thickness;
  return t;
}

PairLaw rubbing(double friction) {
  PairLaw law;
  law.friction = friction;
  return law;
}

// Two plies of different meshes on a common curved surface, pressed into each other and moved along it, in several
// steps, so that friction has something to hold.
void crumple(Stack& stack, double depth, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> noise(-0.02, 0.02);
  for (int step = 0; step <= 4; ++step) {
    for (std::size_t k = 0; k < stack.size(); ++k)
      stack.place(k, [&](const Vec3& x) -> Vec3 {
        const double way = step * (k == 0 ? 0.01 : -0.02);
        return {x[0] + way, x[1] - 0.5 * way + noise(generator),
                x[2] + 2.0 * std::sin(0.04 * x[0]) * std::cos(0.03 * x[1]) - (k == 0 ? 0.0 : depth * step / 4.0) +
                    noise(generator)};
      });
    stack.touch();
  }
}

TEST(PlyContact, ForcesAndMomentsOfAPairSumToZero) {
  for (const double angle : {0.0, 30.0, 45.0}) {
    Stack stack({piece({60.0, 50.0}, 1.0, 0.0, 0.0), piece({50.0, 60.0}, 1.3, angle, thickness())}, rubbing(0.3));
    crumple(stack, 0.1, 7);
    const Vec3 f0 = stack.force(0), f1 = stack.force(1), m0 = stack.moment(0), m1 = stack.moment(1);
    const auto pair = stack.contact().pairs()[0];
    ASSERT_GT(pair.force, 1.0);
    ASSERT_GT(pair.friction_force, 0.1 * pair.force);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(f0[c] + f1[c], 0.0, 1e-12 * pair.force) << angle;
      EXPECT_NEAR(m0[c] + m1[c], 0.0, 1e-12 * pair.force * 60.0) << angle;
    }
  }
}

TEST(PlyContact, PliesStackedByTheirThicknessDoNotPress) {
  for (const double angle : {0.0, 20.0, 45.0}) {
    std::vector<Scene> scenes;
    for (int k = 0; k < 5; ++k) scenes.push_back(piece({90.0, 70.0}, 1.5, k % 2 == 0 ? 0.0 : angle, k * thickness()));
    Stack stack(scenes, rubbing(0.5));
    stack.touch();
    for (std::size_t k = 0; k < stack.size(); ++k)
      for (int n = 0; n < stack.mesh(k).node_count(); ++n)
        for (const double f : stack.force(k, n)) ASSERT_EQ(f, 0.0);
    EXPECT_FALSE(stack.contact().passes_bound());
  }
}

TEST(PlyContact, PliesThatStartInsideEachOtherAreAnErrorWithPlaceAndDepth) {
  try {
    Stack stack({piece({60.0, 60.0}, 1.0, 0.0, 0.0), piece({30.0, 30.0}, 1.0, 30.0, thickness() - 0.125)});
    FAIL() << "they lie in each other";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("'ply 1' and 'ply 2' start 0.125 mm inside each other"), std::string::npos) << text;
    EXPECT_NE(text.find(" mm"), std::string::npos) << text;
  }
}

// Pressed flat by d, beyond the softening: each face's springs of both plies, k (d - softening/2) per area.
TEST(PlyContact, PressureIsThatOfTheSpringsEvenlyOverUnlikeMeshes) {
  const double depth = 0.08;
  Stack stack({piece({80.0, 80.0}, 1.0, 0.0, 0.0), piece({80.0, 80.0}, 1.0, 45.0, thickness())});
  stack.place(1, [&](const Vec3& x) -> Vec3 { return {x[0], x[1], x[2] - depth}; });
  stack.touch();
  const auto pair = stack.contact().pairs()[0];
  EXPECT_NEAR(pair.depth, depth, 1e-8);
  const double per_area = pair.force / pair.area;
  EXPECT_NEAR(pair.area, 6400.0, 0.02 * 6400.0);
  EXPECT_NEAR(stack.force(1)[2], pair.force, 1e-7 * pair.force);
  // in the middle every node bears its area's part of the pressure, whatever it meets of the other's mesh
  for (std::size_t k = 0; k < 2; ++k) {
    const auto state = stack.contact().state_of(static_cast<int>(k));
    for (int n = 0; n < stack.mesh(k).node_count(); ++n) {
      const auto& x = stack.mesh(k).nodes.position[n];
      if (std::abs(x[0]) > 25.0 || std::abs(x[1]) > 25.0) continue;
      EXPECT_NEAR(state.pressure[n], per_area, 0.02 * per_area);
      EXPECT_EQ(state.other[n], k == 0 ? 1 : 0);
    }
  }
}

// A flat ply drawn over another by many cells: below the limit it sticks, above it the force is mu N, the path is the
// way, and nobody searches.
TEST(PlyContact, StickingHoldsAndSlidingRubsOverManyCells) {
  const double depth = 0.05, friction = 0.25;
  Stack stack({piece({120.0, 60.0}, 1.0, 0.0, 0.0), piece({40.0, 40.0}, 1.2, 30.0, thickness())}, rubbing(friction));
  const auto move = [&](double way) {
    stack.place(1, [&](const Vec3& x) -> Vec3 { return {x[0] + way, x[1], x[2] - depth}; });
    stack.touch(1e-3);  // slow: dampers have no part in it
  };
  move(0.0);
  move(0.0);
  double normal = stack.force(1)[2];
  // the elastic way to the limit
  move(1e-5);
  const double stiffness = -stack.force(1)[0] / 1e-5;
  ASSERT_GT(stiffness, 0.0);
  EXPECT_LT(stack.contact().friction_work(), 1e-5 * 1e-5 * stiffness) << "dampers alone";
  move(0.0);
  EXPECT_NEAR(stack.force(1)[0], 0.0, 1e-6 * normal) << "it sticks: back is back";
  double way = 0.0;
  const double step = 0.05, limit_way = friction * normal / stiffness;
  while (way < 30.0) move(way += step);
  const auto pair = stack.contact().pairs()[0];
  EXPECT_NEAR(stack.force(1)[2], pair.force, 1e-6 * normal);
  EXPECT_NEAR(stack.force(1)[0], -friction * pair.force, 0.02 * normal) << "but for who has just come under it";
  EXPECT_NEAR(pair.greatest_slip, 30.0, 2.0 * limit_way + 1e-3);
  EXPECT_NEAR(pair.friction_work, friction * normal * 30.0, 0.06 * friction * normal * 30.0);
  const auto state = stack.contact().state_of(1);
  for (int n = 0; n < stack.mesh(1).node_count(); ++n) {
    if (state.other[n] < 0) continue;
    EXPECT_EQ(state.friction[n], FrictionState::slip);
    EXPECT_NEAR(state.slip[n][0], 30.0, 1e-6);
    EXPECT_NEAR(state.slip[n][1], 0.0, 1e-6);
  }
}

// What hands put into a flat ply drawn over another one, fast, so that dampers have their share, is stored or lost: on
// whole cells and on those that the outline cuts. Feet at the edges come and go: what they store is not much.
TEST(PlyContact, WhatIsPutInIsStoredOrLost) {
  Stack stack({piece({50.0, 40.0}, 1.0, 45.0, 0.0), piece({48.0, 44.0}, 1.2, 0.0, thickness())}, rubbing(0.3));
  double put_in = 0.0, way = 0.0, before = 0.0;
  const auto move = [&](double by) {
    way += by;
    stack.place(1, [&](const Vec3& x) -> Vec3 { return {x[0] + way, x[1] + 0.3 * way, x[2] - 0.05}; });
    stack.touch(1e-5);
    const Vec3 force = stack.force(1);
    const double along = -(force[0] + 0.3 * force[1]);
    put_in += 0.5 * (before + along) * by;
    before = along;
  };
  move(0.0);
  const double stored = stack.contact().stored_energy().total;
  for (int n = 0; n < 400; ++n) move(0.01);
  const double lost = stack.contact().friction_work() + stack.contact().damping_work();
  ASSERT_GT(put_in, 1.0);
  EXPECT_NEAR(stack.contact().stored_energy().total - stored + lost, put_in, 0.002 * put_in);
}

// mJ; by how much the balance is off when one ply is drawn without friction over a ridge of another, in steps of `step`
// mm, and what hands have put in and taken out. Its border does not touch.
struct OverEdges {
  double missing = 0.0, moved = 0.0;
};
OverEdges drawn_over_edges(double angle, double step) {
  Stack stack({piece({90.0, 70.0}, 1.0, 0.0, 0.0), piece({45.0, 45.0}, 1.2, angle, thickness())}, rubbing(0.0));
  const auto height = [](double x) { return 4.0 - std::sqrt(25.0 + 0.16 * x * x); };
  const auto put = [&](double way, double bent, double gap) {
    stack.place(0, [&](const Vec3& x) -> Vec3 { return {x[0], x[1], bent * height(x[0])}; });
    stack.place(1, [&](const Vec3& x) -> Vec3 {
      const double lifted = 2e-3 * (x[0] * x[0] + x[1] * x[1]);
      return {x[0] + way, x[1] + 0.2 * way, bent * height(x[0] + way) + thickness() + gap + lifted};
    });
    stack.touch(1e-3);  // slow: dampers have no part in it
  };
  constexpr int parts = 400, settling = 40;  // steps; feet that were lost on the way are looked for every so often
  constexpr double start = -10.0, end = 10.0, depth = 0.1;
  for (int k = 0; k <= parts; ++k) put(0.0, static_cast<double>(k) / parts, -depth);
  for (int k = 0; k <= parts; ++k) put(start * k / parts, 1.0, -depth);
  for (int k = 0; k < settling; ++k) put(start, 1.0, -depth);
  OverEdges found;
  const double stored = stack.contact().stored_energy().total, damped = stack.contact().damping_work();
  std::vector<Vec3> at_before, force_before;
  for (int n = 0; n < stack.mesh(1).node_count(); ++n) {
    at_before.push_back(stack.position(1, n));
    force_before.push_back(stack.force(1, n));
  }
  for (int k = 1; k * step <= end - start + 1e-9; ++k) {
    put(start + k * step, 1.0, -depth);
    for (int n = 0; n < stack.mesh(1).node_count(); ++n) {
      const auto i = static_cast<std::size_t>(n);
      const Vec3 x = stack.position(1, n), force = stack.force(1, n);
      const double work = -0.5 * dot(plus(force, force_before[i]), minus(x, at_before[i]));
      found.missing -= work;
      found.moved += std::abs(work);
      at_before[i] = x;
      force_before[i] = force;
    }
  }
  found.missing += stack.contact().stored_energy().total - stored + stack.contact().damping_work() - damped;
  return found;
}

// Forces have a potential at an edge as on a cell. A surface with edges leaves 3e-5 to 5e-5 here, and half of it in half
// the step; what is left of 1e-8 to 2e-7 are edges of less than 0.01 rad.
TEST(PlyContact, WorkOverTheEdgesOfCellsIsStored) {
  for (const double angle : {0.0, 20.0, 45.0}) {
    const OverEdges drawn = drawn_over_edges(angle, 0.01);
    ASSERT_GT(drawn.moved, 1.0);
    EXPECT_LT(std::abs(drawn.missing), 1e-6 * drawn.moved) << angle;
  }
}

// A turned ply's rows begin ever further out, with no node beside them to start a search from, and hundreds of cells away
// from where the row before has ended. A foot that is not where it should be takes the slope there for that here.
TEST(PlyContact, EveryFootOfALargeTurnedPlyIsFound) {
  const double side = 300 * 4.92;
  Stack stack({piece({side, side}, 1.0, 45.0, 0.0), piece({side, side}, 1.0, 45.0, 2.0 * thickness())});
  for (int n = 0; n < 2; ++n) {
    for (std::size_t k = 0; k < 2; ++k)
      stack.place(k, [&](const Vec3& x) -> Vec3 {
        const double phase = 1.0 + 2.0 * static_cast<double>(k);
        return {x[0] + 0.6 * std::sin(0.05 * x[1] + phase), x[1] + 0.6 * std::sin(0.04 * x[0] + phase),
                x[2] + 0.3 * std::sin(0.03 * (x[0] + x[1]))};
      });
    ASSERT_NO_THROW(stack.touch());
    EXPECT_EQ(stack.contact().pairs()[0].force, 0.0) << "they lie a ply apart";
  }
}

TEST(PlyContact, GoingThroughAnotherPlyStopsTheRun) {
  Stack stack({piece({60.0, 40.0}, 1.0, 0.0, 0.0), piece({60.0, 40.0}, 1.0, 30.0, thickness())});
  stack.place(1, [&](const Vec3& x) -> Vec3 { return {x[0], x[1], x[2] - 1.1 * thickness()}; });
  try {
    stack.touch();
    FAIL();
  } catch (const PhysicsError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("into ply"), std::string::npos) << text;
    EXPECT_NE(text.find("t = 1e-06 s"), std::string::npos) << text;
  }
}

// Between a hole's or patch's edge the outer two come to touch where the middle one is not.
TEST(PlyContact, PliesMeetWhereAPlyBetweenThemEnds) {
  const double t = thickness();
  Stack stack(
      {piece({80.0, 80.0}, 1.0, 0.0, 0.0), piece({24.0, 24.0}, 1.0, 0.0, t), piece({80.0, 80.0}, 1.0, 45.0, 2.0 * t)});
  double sunk = 0.0;
  for (; sunk < t + 0.05; sunk += 0.002) {
    stack.place(2, [&](const Vec3& x) -> Vec3 {
      const double r = std::hypot(x[0], x[1]);
      const double part = std::clamp((r - 18.0) / 12.0, 0.0, 1.0);
      return {x[0], x[1], x[2] - sunk * part * part * (3.0 - 2.0 * part)};
    });
    State& state = stack.ply(2).state();
    for (auto& v : state.velocity[2]) v = -0.002 / 1e-5;
    stack.touch(1e-5);
  }
  const auto pairs = stack.contact().pairs();
  EXPECT_EQ(pairs[1].lower, 0);
  EXPECT_EQ(pairs[1].upper, 2);
  EXPECT_GT(pairs[1].force, 1.0);
  EXPECT_NEAR(pairs[1].greatest_depth, sunk - 0.002 - t, 0.01);
  Vec3 sum = plus(stack.force(0), plus(stack.force(1), stack.force(2)));
  for (const double f : sum) EXPECT_NEAR(f, 0.0, 1e-10 * pairs[1].force);
}

// tau(slip) of a table, without pressure: the shear force over the area is the table's to the rounding of its
// resampling, and holds where it was when the way turns.
TEST(PlyContact, TabulatedShearStressComesBack) {
  PairLaw law;
  for (int k = 0; k <= 100; ++k) law.shear_law.push_back({0.05 * k, 0.06 * (1.0 - std::exp(-0.05 * k))});
  Stack stack({piece({120.0, 80.0}, 1.0, 0.0, 0.0), piece({60.0, 60.0}, 1.0, 30.0, thickness())}, law);
  double area = 0.0, way = 0.0;
  for (int n = 0; n < 400; ++n) {
    way = 0.01 * n;
    stack.place(1, [&](const Vec3& x) -> Vec3 { return {x[0] + way, x[1], x[2] - 0.002}; });
    stack.touch(1e-3);
    const auto pair = stack.contact().pairs()[0];
    area = pair.area;
    const double tau = 0.06 * (1.0 - std::exp(-way));
    if (n > 3) {
      EXPECT_NEAR(pair.friction_force / area, tau, 0.01 * tau) << way;
    }
  }
  EXPECT_GT(area, 1500.0);
}

TEST(PlyContact, MeasuredCompactionIsThePressure) {
  PairLaw law;
  law.compaction = {{0.0, 0.0}, {0.05, 0.02}, {0.10, 0.08}, {0.15, 0.25}};
  Stack stack({piece({80.0, 80.0}, 1.0, 0.0, 0.0), piece({80.0, 80.0}, 1.0, 45.0, thickness())}, law);
  for (const double depth : {0.025, 0.05, 0.1, 0.125}) {
    stack.place(1, [&](const Vec3& x) -> Vec3 { return {x[0], x[1], x[2] - depth}; });
    stack.touch(1.0);
    const auto pair = stack.contact().pairs()[0];
    const double wanted = depth < 0.06   ? 0.4 * depth
                          : depth < 0.11 ? 0.02 + 1.2 * (depth - 0.05)
                                         : 0.08 + 3.4 * (depth - 0.1);
    EXPECT_NEAR(pair.force / pair.area, wanted, 1e-3 * wanted);
  }
}

TEST(PlyContact, AnyNumberOfThreadsGivesTheSameBits) {
  std::vector<std::vector<double>> all;
  for (const int threads : {1, 2, 3}) {
    // so large that a ply is cut into parts which threads take one by one
    Stack stack({piece({480.0, 480.0}, 1.0, 0.0, 0.0), piece({480.0, 460.0}, 1.0, 45.0, thickness()),
                 piece({450.0, 480.0}, 1.5, 20.0, 2.0 * thickness())},
                rubbing(0.3), threads);
    crumple(stack, 0.05, 3);
    std::vector<double> bits;
    for (std::size_t k = 0; k < stack.size(); ++k)
      for (const auto& component : stack.ply(k).state().force)
        bits.insert(bits.end(), component.begin(), component.end());
    for (const auto& pair : stack.contact().pairs())
      bits.insert(bits.end(), {pair.stored, pair.friction_work, pair.damping_work});
    all.push_back(bits);
  }
  EXPECT_EQ(all[0], all[1]);
  EXPECT_EQ(all[0], all[2]);
}

TEST(PlyContact, LawsThatAreNoneAreRefused) {
  const auto refused = [](const PairLaw& law) {
    EXPECT_THROW(Stack({piece({60.0, 40.0}, 1.0, 0.0, 0.0), piece({60.0, 40.0}, 1.0, 0.0, thickness())}, law),
                 InputError);
  };
  PairLaw law = rubbing(-0.1);
  refused(law);
  law = {};
  law.shear_law = {{0.0, 0.1}, {0.0, 0.2}};
  refused(law);
  law = {};
  law.compaction = {{0.0, 0.1}, {0.1, 0.05}};
  refused(law);
}

}  // namespace
}  // namespace weaveform
