// The contact law of one node, and the culling around it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "solver/contact/contact_kernel.hpp"
#include "tests/support/touching_nodes.hpp"

namespace weaveform {
namespace {

constexpr double mass = 3e-7;  // tonne
const ContactLaw law = {.offset = 0.25, .softening = 0.01, .frequency2 = 5e9, .damping_rate = 1e4, .friction = 0.3};

// One node above the plane z = 0.
struct Node {
  double x[3] = {0, 0, 0}, v[3] = {0, 0, 0}, anchor[3] = {0, 0, 0}, drag[3] = {0, 0, 0}, force[3] = {0, 0, 0};
  double node_mass = mass, area = 20.0;
  ContactTool tool{{0, 0, 0}, {0, 0, 0}};

  ContactSums touch(const ContactLaw& its_law, double time = 1e-6) {
    Distances distances;
    const ContactNodes nodes = view();
    plane_distances({.origin = tool.origin, .axis = {0, 0, 1}}, {nodes.x[0], nodes.x[1], nodes.x[2]}, 1, distances);
    for (double& f : force) f = 0.0;
    return contact_forces(its_law, tool, distances, time, nodes, single_node);
  }
  ContactNodes view() {
    ContactNodes nodes{};
    nodes.count = 1;
    nodes.mass = &node_mass;
    nodes.area = &area;
    for (int c = 0; c < 3; ++c) {
      nodes.x[c] = &x[c];
      nodes.v[c] = &v[c];
      nodes.force[c] = &force[c];
      nodes.anchor[c] = &anchor[c];
      nodes.drag[c] = &drag[c];
    }
    return nodes;
  }
};

TEST(ContactLaw, NormalForceIsTheSlopeOfItsEnergyAndSetsInSmoothly) {
  Node node;
  const double h = 1e-7;  // mm
  for (const double depth : {0.0, 1e-4, 0.005, 0.00999, 0.01001, 0.03, 0.2}) {
    const auto energy = [&](double d) {
      node.x[2] = 0.25 - d;
      return node.touch(law).energy;
    };
    const double slope = (energy(depth + h) - energy(depth - h)) / (2 * h);
    (void)energy(depth);
    // central difference: error h^2 k/d; energies of 1e-2 mJ round at 1e-18, over h
    EXPECT_NEAR(node.force[2], slope, 1e-6 + 1e-6 * slope) << depth;
    EXPECT_GE(node.force[2], 0.0);
  }
  node.x[2] = 0.25 + 1e-12;
  EXPECT_EQ(node.touch(law).area, 0.0);
  EXPECT_EQ(node.force[2], 0.0);
}

TEST(ContactLaw, NodeBelowCoulombsLimitSticksAndAboveItFeelsExactlyIt) {
  Node node;
  node.x[2] = 0.25 - 0.02;
  (void)node.touch(law);
  const double normal = node.force[2], k = law.frequency2 * mass;
  node.x[0] = 0.5 * law.friction * normal / k;  // half the limit
  const ContactSums stuck = node.touch(law);
  EXPECT_NEAR(node.force[0], -0.5 * law.friction * normal, 1e-12 * normal);
  EXPECT_EQ(stuck.friction_work, 0.0);
  EXPECT_NEAR(node.anchor[0], 0.0, 1e-15);
  node.x[0] = 3.0 * law.friction * normal / k;
  (void)node.touch(law);
  EXPECT_NEAR(node.force[0], -law.friction * normal, 1e-12 * normal);
}

TEST(ContactLaw, NeverPullsAndNeverRubsBeyondCoulombsLimit) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> place(-0.05, 0.05), speed(-3000.0, 3000.0);
  for (int n = 0; n < 20000; ++n) {
    Node node;
    for (int c = 0; c < 3; ++c) {
      node.x[c] = place(generator);
      node.v[c] = speed(generator);
      node.anchor[c] = 0.01 * place(generator);
    }
    node.x[2] += 0.25;
    (void)node.touch(law);
    ASSERT_GE(node.force[2], 0.0);
    ASSERT_LE(std::hypot(node.force[0], node.force[1]), law.friction * node.force[2] * (1.0 + 1e-12) + 1e-300);
  }
}

// A node pressed on a plane, in the linear part of the normal law, dances and rubs there, and now and then sticks: what
// leapfrog keeps, m v- v+/2 and the springs' energy, and all that friction and dampers took are the push's work, to
// rounding and at any step; and nothing is ever won back of what was lost.
TEST(ContactLaw, WorksAreCountedAsTheStepDoesThem) {
  for (const double turn : {0.05, 0.3, 0.9}) {  // omega times the step
    Node node;
    const double step = turn / std::sqrt(law.frequency2), k = law.frequency2 * mass;
    const double push[3] = {0.2 * law.friction * k * 0.06, 0.0, -k * 0.055};  // N; at rest 0.06 mm deep
    node.x[2] = 0.25 - 0.06;
    (void)node.touch(law, step);
    double work = 0.0, lost = 0.0, rubbed = 0.0, start = 0.0, greatest = 0.0;
    for (int c = 0; c < 3; ++c) node.v[c] = (c == 2 ? 0.02 : 0.06) * std::sqrt(law.frequency2);
    for (int n = 0; n < 2000; ++n) {
      const double before[3] = {node.v[0], node.v[1], node.v[2]};
      for (int c = 0; c < 3; ++c) node.x[c] += step * node.v[c];
      const ContactSums sums = node.touch(law, step);
      ASSERT_GT(0.25 - node.x[2], law.softening) << "beyond the linear part";
      double kinetic = 0.0;
      for (int c = 0; c < 3; ++c) {
        node.v[c] += step * (node.force[c] + push[c]) / mass;
        kinetic += 0.5 * mass * before[c] * node.v[c];
        work += push[c] * step * before[c];
      }
      lost += sums.friction_work + sums.damping_work;
      rubbed += sums.friction_work;
      const double sum = kinetic + sums.energy + lost - work;
      // the first step's losses had no force before them
      if (n == 0) start = sum;
      greatest = std::max({greatest, kinetic, sums.energy, lost});
      ASSERT_GE(lost, 0.0);
      ASSERT_NEAR(sum, start, 1e-11 * greatest) << "step " << n << " of " << turn;
    }
    EXPECT_GT(rubbed, 0.05 * greatest) << "it should have rubbed";
  }
}

TEST(ContactLaw, DoesNotKnowOfACommonMotionOfToolAndNode) {
  Node still, moved;
  still.x[2] = 0.24;
  still.x[0] = 1e-4;
  still.v[0] = 20.0;
  moved = still;
  for (int c = 0; c < 3; ++c) {
    const double way[3] = {5.0, -3.0, 2.0}, velocity[3] = {100.0, 50.0, -70.0};
    moved.x[c] += way[c];
    moved.v[c] += velocity[c];
    moved.tool.origin[c] += way[c];
    moved.tool.velocity[c] += velocity[c];
  }
  (void)still.touch(law);
  (void)moved.touch(law);
  // k times the rounding of coordinates of 5 mm
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(still.force[c], moved.force[c], 1500.0 * 4e-15);
}

TEST(ContactLaw, NodesThatDoNotExistFeelNothingAndDoNotCount) {
  Node node;
  node.node_mass = 0.0;
  node.x[2] = -5.0;
  node.v[0] = 1e6;
  (void)node.touch(law);
  for (const double f : node.force) EXPECT_EQ(f, 0.0);
  Distances distances;
  plane_distances({}, {&node.x[0], &node.x[1], &node.x[2]}, 1, distances);
  double gap[groups_in_block];
  least_gaps(distances, 0.25, node.view(), single_node, gap);
  EXPECT_GT(gap[0], 1e200);
  EXPECT_EQ(greatest_speed({0, 0, 0}, node.view()), 0.0);
}

// Eight and more nodes in arrays, on a plane that stands as `axis` says.
struct Row : test::TouchingNodes {
  static constexpr int count = 3 * group_nodes + 3;
  std::array<double, 3> axis;

  explicit Row(const std::array<double, 3>& upward) : axis(upward) {
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> place(-0.05, 0.05), speed(-3000.0, 3000.0);
    for (int n = 0; n < count; ++n) {
      for (int c = 0; c < 3; ++c) {
        x[c].push_back(place(generator) + 0.25 * axis[c]);
        v[c].push_back(speed(generator));
        anchor[c].push_back(n % 3 == 0 && c == 0 ? no_anchor : x[c].back() + 0.01 * place(generator));
        drag[c].push_back(n % 3 == 0 ? 0.0 : 1e-6 * speed(generator));
        force[c].push_back(0.0);
      }
      node_mass.push_back(mass * (1.0 + 0.1 * n));
      area.push_back(20.0 + n);
    }
  }
  ContactSums touch(int first, int nodes, ContactGroups groups) {
    Distances distances;
    const ContactNodes seen = view(first, nodes);
    plane_distances({.origin = {}, .axis = axis}, {seen.x[0], seen.x[1], seen.x[2]}, nodes, distances);
    find_upright(distances, nodes, groups);
    for (int g = 0; g < groups.count; ++g)
      EXPECT_EQ(groups.upright[g], nodes - groups.node[g] >= group_nodes && axis[0] == 0.0);
    return contact_forces(law, {{0, 0, 0}, {10, -20, 5}}, distances, 1e-6, seen, groups);
  }
};

// Whole groups on an upright tool go another way than single nodes. Sums of 27 nodes round at some 1e-15 of their parts,
// friction and damping, whose parts have either sign, at more.
TEST(ContactLaw, AGroupOfNodesFeelsWhatEachOfItsNodesWould) {
  for (const std::array<double, 3>& axis : {std::array{0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, {0.6, 0.0, 0.8}}) {
    Row together(axis), alone(axis);
    const ContactSums sums = together.touch(0, Row::count, test::groups_of(Row::count));
    ContactSums sum;
    for (int n = 0; n < Row::count; ++n) {
      const ContactSums one = alone.touch(n, 1, single_node);
      for (int c = 0; c < 3; ++c) sum.force[c] += one.force[c];
      sum.area += one.area;
      sum.energy += one.energy;
      sum.friction_work += one.friction_work;
      sum.damping_work += one.damping_work;
    }
    const double size = std::abs(sum.force[0]) + std::abs(sum.force[1]) + std::abs(sum.force[2]);
    ASSERT_GT(size, 0.0);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(sums.force[c], sum.force[c], 1e-13 * size);
      for (int n = 0; n < Row::count; ++n) {
        EXPECT_NEAR(together.force[c][n], alone.force[c][n], 1e-14 * size);
        EXPECT_NEAR(together.drag[c][n], alone.drag[c][n], 1e-14 * size);
        EXPECT_NEAR(together.anchor[c][n], alone.anchor[c][n], 1e-14 * std::abs(alone.anchor[c][n]));
      }
    }
    EXPECT_NEAR(sums.area, sum.area, 1e-12 * sum.area);
    EXPECT_NEAR(sums.energy, sum.energy, 1e-13 * sum.energy);
    EXPECT_NEAR(sums.friction_work, sum.friction_work, 1e-12 * std::abs(sum.friction_work));
    EXPECT_NEAR(sums.damping_work, sum.damping_work, 1e-12 * std::abs(sum.damping_work));
  }
}

TEST(ContactLaw, WhatDoesNotTouchHasNoAnchorAndNoDrag) {
  Row row({0.0, 0.0, 1.0});
  (void)row.touch(0, Row::count, test::groups_of(Row::count));
  for (int n = 0; n < Row::count; ++n) {
    EXPECT_EQ(row.anchor[0][n] < no_anchor, row.x[2][n] < law.offset);
    if (row.x[2][n] < law.offset) continue;
    for (int c = 0; c < 3; ++c) EXPECT_EQ(row.drag[c][n], 0.0);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(row.force[c][n], 0.0);
  }
}

}  // namespace
}  // namespace weaveform
