// Node sets: what a grip holds, what it does not, and what is said when it holds nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "tests/unit/mesher/lattice/lattice_zoo.hpp"

namespace weaveform {
namespace {

using namespace lattice_zoo;

const std::vector<int>& set_of(const Mesh& mesh, const std::string& name) {
  for (const auto& set : mesh.sets)
    if (set.name == name) return set.node;
  throw std::runtime_error("no set " + name);
}

// A yarn end off the held edge, or the crossing its stub merged into, beside an end of that edge: its line passes
// within half a spacing, and it lies within a spacing, along the line, of the edge's end (a quarter more for the stub).
bool beside_an_end(const Animal& a, const Mesh& mesh, const std::array<double, 2>& place) {
  for (const Family family : {Family::warp, Family::weft}) {
    const auto f = static_cast<std::size_t>(family);
    const auto along = direction(a.scene, family);
    for (const double side : {-0.5, 0.5}) {
      const double dx = place[0] - side * a.scene.blank.size[0];
      const double dy = place[1] + 0.5 * a.scene.blank.size[1];
      const double across_lines = std::abs(-along[1] * dx + along[0] * dy);
      const double along_line = std::abs(along[0] * dx + along[1] * dy);
      if (across_lines < 0.5 * mesh.spacing[1 - f] && along_line <= 1.25 * mesh.spacing[f] * (1.0 + 1e-6)) return true;
    }
  }
  return false;
}

TEST(LatticeGrips, AnEdgeIsHeldFromEndToEndAndNothingElse) {
  for (const auto& a : zoo()) {
    if (a.scene.grip.empty()) continue;
    const Mesh mesh = build_mesh(a.scene, a.card);
    const double half = 0.5 * a.scene.blank.size[1];
    // A held crossing stands at most a merged stub away from the edge.
    const double near_edge = 0.25 * std::max(mesh.spacing[0], mesh.spacing[1]) * (1.0 + 1e-6);
    double left = 0.0;
    double right = 0.0;
    for (const int n : set_of(mesh, "bottom")) {
      const auto p = in_blank(mesh, n);
      const bool on_edge = p[1] + half <= (mesh.nodes.crossing[n][0] >= 0 ? near_edge : 1e-6 * near_edge);
      EXPECT_TRUE(on_edge || beside_an_end(a, mesh, p)) << a.name << " node " << n;
      left = std::min(left, p[0]);
      right = std::max(right, p[0]);
    }
    // Neighbouring yarns meet the edge no further apart than the lines of the family it meets most often; at a corner
    // the lines that cut off its tip without a crossing have no elements, two at most.
    const auto u = direction(a.scene, Family::warp);
    const double gap = 1.0 / std::max(std::abs(u[0]) / mesh.spacing[0], std::abs(u[1]) / mesh.spacing[1]);
    EXPECT_LE(left, -0.5 * a.scene.blank.size[0] + 2.5 * gap) << a.name;
    EXPECT_GE(right, 0.5 * a.scene.blank.size[0] - 2.5 * gap) << a.name;
  }
}

TEST(LatticeGrips, EveryYarnEndOnAHeldEdgeIsHeld) {
  for (const auto& a : zoo()) {
    if (a.scene.grip.empty()) continue;
    const Mesh mesh = build_mesh(a.scene, a.card);
    const auto& held = set_of(mesh, "top");
    for (int n = 0; n < mesh.node_count(); ++n) {
      const bool on_edge = std::abs(in_blank(mesh, n)[1] - 0.5 * a.scene.blank.size[1]) < 1e-7 * mesh.spacing[0];
      EXPECT_TRUE(!on_edge || std::binary_search(held.begin(), held.end(), n)) << a.name << " node " << n;
    }
  }
}

TEST(LatticeGrips, NoNodeIsHeldTwice) {
  Animal a = animal(plain_weave(), 45.0, {8.0, 9.0}, {1.0, 1.0}, {0.0, 0.0}, false);
  for (const auto* edge : {"bottom", "right", "top", "left"}) a.scene.grip.push_back(grip_on(edge));
  for (const double angle : {0.0, 45.0, 20.0}) {
    a.scene.blank.yarn_angle = angle;
    const Mesh mesh = build_mesh(a.scene, a.card);
    std::vector<int> times(mesh.node_count(), 0);
    for (const auto& set : mesh.sets)
      if (set.name != "outline")
        for (const int n : set.node) ++times[n];
    EXPECT_EQ(*std::max_element(times.begin(), times.end()), 1);
  }
}

TEST(LatticeGrips, ABoxHoldsExactlyTheNodesInside) {
  Animal a = animal(twill(), 30.0, {12.0, 12.0}, {1.0, 1.0}, {0.0, 0.0}, false);
  GripSpec grip;
  grip.name = "pad";
  grip.box = std::array<double, 4>{-12.0, -9.0, 11.0, 13.0};
  a.scene.grip = {grip};
  a.scene.blank.orientation = 50.0;  // the box is in the blank's frame
  const Mesh turned = build_mesh(a.scene, a.card);
  a.scene.blank.orientation = 0.0;
  const Mesh mesh = build_mesh(a.scene, a.card);
  std::vector<int> inside;
  for (int n = 0; n < mesh.node_count(); ++n) {
    const auto p = in_blank(mesh, n);
    if (p[0] >= -12.0 && p[0] <= 11.0 && p[1] >= -9.0 && p[1] <= 13.0) inside.push_back(n);
  }
  EXPECT_EQ(set_of(mesh, "pad"), inside);
  EXPECT_EQ(set_of(turned, "pad"), inside);
}

TEST(LatticeGrips, TheOutlineSetIsTheMeshBoundary) {
  const Animal a = animal(plain_weave(), 0.0, {10.0, 6.0}, {1.0, 1.0}, {0.0, 0.0}, false);
  const Mesh mesh = build_mesh(a.scene, a.card);
  EXPECT_EQ(set_of(mesh, "outline").size(), 2U * (10U + 6U));
}

TEST(LatticeGrips, AGripWithNothingToHoldIsRefusedByName) {
  Animal a = animal(plain_weave(), 45.0, {8.0, 9.0}, {1.0, 1.0}, {0.0, 0.0}, false);
  GripSpec far;
  far.name = "far";
  far.box = std::array<double, 4>{1000.0, 1000.0, 1001.0, 1001.0};
  GripSpec odd;
  odd.name = "odd";
  for (const auto& grip : {far, odd}) {
    a.scene.grip = {grip};
    try {
      static_cast<void>(build_mesh(a.scene, a.card));
      ADD_FAILURE() << grip.name;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("'" + grip.name + "'"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace weaveform
