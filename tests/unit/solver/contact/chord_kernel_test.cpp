// Kinks of chords at one node: what they lift, and the cone they put friction in.
#include "solver/contact/chord_kernel.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "tests/support/touching_nodes.hpp"

namespace weaveform {
namespace {

using Eigen::Vector3d;

constexpr double h = 5.0, mu = 0.3;  // mm, 1

// A node at the origin with its neighbours, on a tool of normal n.
struct Crossing {
  std::array<Vector3d, 2> before = {Vector3d(-h, 0, 0), Vector3d(0, -h, 0)},
                          after = {Vector3d(h, 0, 0), Vector3d(0, h, 0)};
  Vector3d n = Vector3d::UnitZ();
  std::array<double, 2> length = {h, h};

  [[nodiscard]] ChordTerms terms() const {
    std::array<std::vector<double>, 3> x;
    for (const Vector3d& p : {Vector3d(0, 0, 0), before[0], after[0], before[1], after[1]})
      for (int c = 0; c < 3; ++c) x[c].push_back(p[c]);
    const int b[2] = {1, 3}, a[2] = {2, 4};
    const ChordLattice lattice = {.x = {x[0].data(), x[1].data(), x[2].data()},
                                  .before = {&b[0], &b[1]},
                                  .after = {&a[0], &a[1]},
                                  .even = nullptr,
                                  .stride = 0};
    ChordTurns turns;
    chord_turns(lattice, 0, 1, 1, turns);
    Distances distances{};
    for (int c = 0; c < 3; ++c) distances.normal[c][0] = n[c];
    ChordTerms terms;
    chord_terms(turns, {&length[0], &length[1]}, 1, single_node, mu, 1.0, distances, terms);
    return terms;
  }
};

// Of one family, both chords down by half the kink.
void bend(Crossing& crossing, int family, double kink) {
  const Vector3d along = family == 0 ? Vector3d::UnitX() : Vector3d::UnitY();
  crossing.before[family] = h * (-std::cos(0.5 * kink) * along - std::sin(0.5 * kink) * Vector3d::UnitZ());
  crossing.after[family] = h * (std::cos(0.5 * kink) * along - std::sin(0.5 * kink) * Vector3d::UnitZ());
}

Vector3d shift_of(const ChordTerms& terms) {
  return {terms.shift[0][0], terms.shift[1][0], terms.shift[2][0]};
}

TEST(ChordKernel, AKinkLiftsByATwentyfourthOfItsChordAndFrictionIsTheBelts) {
  for (const double kink : {0.05, 0.3, 0.65, 1.3}) {
    Crossing crossing;
    bend(crossing, 0, kink);
    const ChordTerms terms = crossing.terms();
    EXPECT_NEAR(terms.lift[0], h * kink / 24.0, 0.004 * h * kink / 24.0) << kink;  // the series of the kink
    const double belt = std::tanh(0.5 * mu * kink) / std::tan(0.5 * kink);
    EXPECT_NEAR(terms.friction[0], belt, 0.003 * belt) << kink;
    EXPECT_LT(shift_of(terms).norm(), 1e-12);
  }
}

TEST(ChordKernel, OnASphereBothYarnsAgreeOnASaddleTheyOpposeEachOther) {
  Crossing sphere, saddle;
  bend(sphere, 0, 0.3);
  bend(sphere, 1, 0.3);
  EXPECT_NEAR(sphere.terms().lift[0], h * 0.3 / 24.0, 1e-4 * h);
  bend(saddle, 0, 0.3);
  bend(saddle, 1, -0.3);
  EXPECT_NEAR(saddle.terms().lift[0], 0.0, 1e-12);
  // the yarn that bears on the tool says how: the other hangs over it
  Crossing warp;
  bend(warp, 0, 0.3);
  EXPECT_NEAR(saddle.terms().friction[0], warp.terms().friction[0], 1e-9);
}

TEST(ChordKernel, ALongChordOfTheOtherFamilyDoesNotShakeTheNode) {
  Crossing crossing;
  bend(crossing, 0, 0.6);
  const double still = crossing.terms().lift[0];
  crossing.length[1] = 0.1 * h;  // a hundredth of a radian more or less
  for (const double quiver : {-0.01, 0.01}) {
    bend(crossing, 1, quiver);
    EXPECT_NEAR(crossing.terms().lift[0], still, 1e-3 * still);
  }
}

TEST(ChordKernel, TurnsWithinTheSurfaceAndMissingChordsCountForNothing) {
  Crossing turned;
  turned.after[0] = h * Vector3d(std::cos(0.4), std::sin(0.4), 0.0);
  Crossing cut;
  bend(cut, 0, 0.6);
  cut.length[0] = 0.0;
  for (const Crossing& crossing : {turned, cut}) {
    const ChordTerms terms = crossing.terms();
    EXPECT_NEAR(terms.lift[0], 0.0, 1e-12);
    EXPECT_NEAR(terms.friction[0], mu, 1e-9);
    EXPECT_LT(shift_of(terms).norm(), 1e-9);
  }
}

// Where an arc begins the tool's normal is not the bisector: n + a stands along it.
TEST(ChordKernel, TheConeStandsOnTheBisectorOfTheKink) {
  Crossing crossing;
  crossing.after[0] = h * Vector3d(std::cos(0.5), 0.0, -std::sin(0.5));
  const ChordTerms terms = crossing.terms();
  const Vector3d bisector(std::sin(0.25), 0.0, std::cos(0.25)), cone = crossing.n + shift_of(terms);
  EXPECT_LT(cone.normalized().cross(bisector).norm(), 1e-9);
  EXPECT_NEAR(shift_of(terms).dot(crossing.n), 0.0, 1e-12);
  EXPECT_NEAR(terms.lift[0], h * 0.5 / 24.0, 1e-3 * h);
}

// A node that slides over the kink: its force lies on the cone of the belt about the bisector, whichever way it slides.
TEST(ChordKernel, ASlidingNodesForceLiesOnTheBeltsConeAboutTheBisector) {
  Crossing crossing;
  crossing.after[0] = h * Vector3d(std::cos(0.5), 0.0, -std::sin(0.5));
  const ChordTerms terms = crossing.terms();
  const ContactLaw law{.offset = 0.25, .softening = 0.025, .frequency2 = 1e9, .damping_rate = 0.0, .friction = mu};
  const Vector3d bisector(std::sin(0.25), 0.0, std::cos(0.25));
  for (const double way : {-1.0, 1.0}) {
    double mass = 1e-8, area = 25.0, x[3] = {0, 0, 0}, v[3] = {0, 0, 0}, force[3] = {0, 0, 0}, drag[3] = {0, 0, 0},
           anchor[3] = {-way, 0.0, 0.0}, lift = 0.0, normal = 0.0;
    ContactNodes node{1, &mass, &area, {&x[0], &x[1], &x[2]}, {&v[0], &v[1], &v[2]}, {}, {}, {}};
    for (int c = 0; c < 3; ++c) {
      node.force[c] = &force[c];
      node.anchor[c] = &anchor[c];
      node.drag[c] = &drag[c];
    }
    Distances distances{};
    distances.distance[0] = 0.15;
    distances.normal[2][0] = 1.0;
    (void)chord_forces(law, {{0, 0, 0}, {0, 0, 0}}, distances, terms, 0.0, node, single_node, {&lift, &normal});
    const Vector3d f(force[0], force[1], force[2]);
    const double along = f.dot(bisector), across = (f - along * bisector).norm();
    EXPECT_NEAR(across, terms.friction[0] * along, 1e-9 * along) << way;
    EXPECT_LT((f - along * bisector).dot(Vector3d(way, 0.0, 0.0)), 0.0);  // against the way
    EXPECT_NEAR(f[2], normal, 1e-9 * normal);                             // the normal spring keeps to the normal
  }
}

// Three uneven weft rows of nodes, the middle one of which touches a plane.
struct Rows : test::TouchingNodes {
  static constexpr int count = 27, first = count;  // of the middle row; three of its nodes are no whole group
  std::array<std::vector<int>, 2> before, after;
  std::vector<double> length, lift, normal;
  std::vector<char> even;
  Vector3d axis;

  explicit Rows(const Vector3d& upward) : axis(upward) {
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> draw(-1.0, 1.0);
    for (int n = 0; n < 3 * count; ++n) {
      const int row = n / count;
      const Vector3d flat = h * Vector3d(n % count, row - 1.0, 0.0);
      const Vector3d place = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis) * flat + 0.25 * axis +
                             0.05 * Vector3d(draw(generator), draw(generator), draw(generator));
      for (int c = 0; c < 3; ++c) {
        x[c].push_back(place[c]);
        v[c].push_back(3000.0 * draw(generator));
        anchor[c].push_back(n % 3 == 0 && c == 0 ? no_anchor : place[c] + 1e-3 * draw(generator));
        drag[c].push_back(n % 3 == 0 ? 0.0 : 1e-3 * draw(generator));
        force[c].push_back(0.0);
      }
      const std::array<int, 2> step = {1, count};
      for (int f = 0; f < 2; ++f) {
        before[f].push_back(n - step[f]);
        after[f].push_back(n + step[f]);
      }
      node_mass.push_back(3e-7 * (1.0 + 0.01 * n));
      area.push_back(h * h);
      length.push_back(n == first ? 0.0 : h);
      lift.push_back(1e-3 * draw(generator));
      normal.push_back(0.1 * std::abs(draw(generator)));
    }
    even.assign(3 * count / group_nodes + 1, 1);
  }
  ContactSums touch(int from, int nodes) {
    const ContactNodes seen = view(from, nodes);
    ContactGroups groups = test::groups_of(nodes);
    Distances distances;
    plane_distances({.origin = {}, .axis = {axis[0], axis[1], axis[2]}}, {seen.x[0], seen.x[1], seen.x[2]}, nodes,
                    distances);
    find_upright(distances, nodes, groups);
    const ChordLattice lattice = {.x = {x[0].data(), x[1].data(), x[2].data()},
                                  .before = {before[0].data(), before[1].data()},
                                  .after = {after[0].data(), after[1].data()},
                                  .even = even.data(),
                                  .stride = count};
    ChordTurns turns;
    chord_turns(lattice, from, nodes, (1U << static_cast<unsigned>(groups.count)) - 1U, turns);
    ChordTerms terms;
    chord_terms(turns, {length.data() + from, length.data() + from}, nodes, groups, mu, 0.5, distances, terms);
    const ContactLaw law{.offset = 0.25, .softening = 0.025, .frequency2 = 5e9, .damping_rate = 1e4, .friction = mu};
    return chord_forces(law, {{0, 0, 0}, {10, -20, 5}}, distances, terms, 1e-6, seen, groups,
                        {lift.data() + from, normal.data() + from});
  }
};

// Whole groups on an upright tool, and those whose neighbours stand beside them, go another way than single nodes.
TEST(ChordKernel, AGroupOfNodesFeelsWhatEachOfItsNodesWould) {
  for (const Vector3d& axis : {Vector3d(0.0, 0.0, 1.0), Vector3d(0.0, 0.0, -1.0), Vector3d(0.6, 0.0, 0.8)}) {
    Rows together(axis), alone(axis);
    const ContactSums sums = together.touch(Rows::first, Rows::count);
    ContactSums sum;
    for (int n = Rows::first; n < Rows::first + Rows::count; ++n) {
      const ContactSums one = alone.touch(n, 1);
      sum.area += one.area;
      sum.energy += one.energy;
      sum.friction_work += one.friction_work;
      sum.damping_work += one.damping_work;
    }
    double size = 0.0, apart = 0.0;  // N
    for (int n = Rows::first; n < Rows::first + Rows::count; ++n) {
      for (int c = 0; c < 3; ++c) {
        size = std::max(size, std::abs(alone.force[c][n]));
        apart = std::max({apart, std::abs(together.force[c][n] - alone.force[c][n]),
                          std::abs(together.drag[c][n] - alone.drag[c][n])});
        EXPECT_NEAR(together.anchor[c][n], alone.anchor[c][n], 1e-12 * std::abs(alone.anchor[c][n]));
      }
      EXPECT_NEAR(together.lift[n], alone.lift[n], 1e-12 * h);
      EXPECT_NEAR(together.normal[n], alone.normal[n], 1e-11 * std::abs(alone.normal[n]));
    }
    ASSERT_GT(size, 0.0);
    EXPECT_LT(apart, 1e-12 * size);
    // of parts of either sign
    EXPECT_NEAR(sums.area, sum.area, 1e-12 * sum.area);
    EXPECT_NEAR(sums.energy, sum.energy, 1e-12 * sum.energy);
    EXPECT_NEAR(sums.friction_work, sum.friction_work, 1e-10 * std::abs(sum.friction_work));
    EXPECT_NEAR(sums.damping_work, sum.damping_work, 1e-10 * std::abs(sum.damping_work));
  }
}

}  // namespace
}  // namespace weaveform
