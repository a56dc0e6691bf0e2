// What the lattice keeps exactly, whatever the angle and coarsening: area, yarn length, mass; and where its yarns lie.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/error.hpp"
#include "tests/unit/mesher/lattice/lattice_zoo.hpp"

namespace weaveform {
namespace {

using namespace lattice_zoo;

// Rounding only: sums over up to 1e5 terms, each good to a few 1e-16, in units of the total.
constexpr double rounding = 1e-12;

double outline_area(const Animal& a) {
  return a.scene.blank.size[0] * a.scene.blank.size[1];
}

TEST(LatticeTotals, CellsFillTheOutlineExactly) {
  for (const auto& a : zoo()) {
    const Mesh mesh = build_mesh(a.scene, a.card);
    const double area = std::accumulate(mesh.cells.area.begin(), mesh.cells.area.end(), 0.0);
    EXPECT_NEAR(area / outline_area(a), 1.0, rounding) << a.name;
  }
}

TEST(LatticeTotals, YarnLengthIsAreaOverInterval) {
  for (const auto& a : zoo()) {
    const Mesh mesh = build_mesh(a.scene, a.card);
    std::array<double, 2> length{};
    for (int e = 0; e < mesh.yarn_count(); ++e)
      length[static_cast<std::size_t>(mesh.yarns.family[e])] += mesh.yarns.yarns[e] * mesh.yarns.rest_length[e];
    for (std::size_t f = 0; f < 2; ++f)
      EXPECT_NEAR(length[f] * a.card.yarn[f].interval / outline_area(a), 1.0, rounding) << a.name;
  }
}

TEST(LatticeTotals, MassIsAreaTimesAreaDensity) {
  for (const auto& a : zoo()) {
    const Mesh mesh = build_mesh(a.scene, a.card);
    double density = 0.0;  // tonne/mm^2
    for (const auto& yarn : a.card.yarn) density += yarn.linear_density / yarn.interval;
    const double mass = std::accumulate(mesh.nodes.mass.begin(), mesh.nodes.mass.end(), 0.0);
    EXPECT_NEAR(mass / (density * outline_area(a)), 1.0, rounding) << a.name;
  }
}

TEST(LatticeTotals, SectionIsThatOfTheYarnsAndYarnsStayNearTheCoarsening) {
  for (const auto& a : zoo()) {
    const Mesh mesh = build_mesh(a.scene, a.card);
    for (int e = 0; e < mesh.yarn_count(); ++e) {
      const auto f = static_cast<std::size_t>(mesh.yarns.family[e]);
      EXPECT_DOUBLE_EQ(mesh.yarns.section[e], mesh.yarns.yarns[e] * a.card.yarn[f].section) << a.name;
      // Half a strip along an edge, one and a half beside it, a little more where short stubs were dropped.
      const double share = mesh.yarns.yarns[e] / yarns_per_line(mesh, a.card)[f];
      EXPECT_TRUE(share > 0.49 && share < 2.2) << a.name << " element " << e << " share " << share;
    }
  }
}

TEST(LatticeTotals, YarnsRunStraightAlongTheirFamily) {
  for (const auto& a : zoo()) {
    const Mesh mesh = build_mesh(a.scene, a.card);
    const double extent = std::hypot(a.scene.blank.size[0], a.scene.blank.size[1]);
    for (int e = 0; e < mesh.yarn_count(); ++e) {
      const auto& [first, second] = mesh.yarns.node[e];
      const auto p = in_blank(mesh, first);
      const auto q = in_blank(mesh, second);
      const auto along = direction(a.scene, mesh.yarns.family[e]);
      for (std::size_t k = 0; k < 2; ++k)
        EXPECT_NEAR(q[k] - p[k], mesh.yarns.rest_length[e] * along[k], 1e-14 * extent) << a.name << " element " << e;
      EXPECT_GT(mesh.yarns.rest_length[e], 0.0) << a.name;
    }
  }
}

TEST(LatticeTotals, NodesLieInTheBlankAndYarnEndsOnItsOutline) {
  for (const auto& a : zoo()) {
    const Mesh mesh = build_mesh(a.scene, a.card);
    // The net takes places closer than 1e-7 spacings as one.
    const double same = 2e-7 * std::min(mesh.spacing[0], mesh.spacing[1]);
    for (int n = 0; n < mesh.node_count(); ++n) {
      const auto p = in_blank(mesh, n);
      const double inside =
          std::min(0.5 * a.scene.blank.size[0] - std::abs(p[0]), 0.5 * a.scene.blank.size[1] - std::abs(p[1]));
      EXPECT_GE(inside, -same) << a.name << " node " << n;
      EXPECT_TRUE(mesh.nodes.crossing[n][0] >= 0 || inside <= same) << a.name << " node " << n;
    }
  }
}

TEST(LatticeTotals, CrossingsLieOnTheLattice) {
  for (const auto& a : zoo()) {
    const Mesh mesh = build_mesh(a.scene, a.card);
    const auto u = direction(a.scene, Family::warp);
    const auto v = direction(a.scene, Family::weft);
    const double extent = std::hypot(a.scene.blank.size[0], a.scene.blank.size[1]);
    const auto origin = in_blank(mesh, 0);
    const auto first = mesh.nodes.crossing[0];
    for (int n = 0; n < mesh.node_count(); ++n) {
      const auto [i, j] = mesh.nodes.crossing[n];
      if (i < 0) continue;
      ASSERT_TRUE(i < mesh.lattice_size[0] && j >= 0 && j < mesh.lattice_size[1]) << a.name;
      const auto p = in_blank(mesh, n);
      for (std::size_t k = 0; k < 2; ++k) {
        const double expected =
            origin[k] + (i - first[0]) * mesh.spacing[0] * u[k] + (j - first[1]) * mesh.spacing[1] * v[k];
        EXPECT_NEAR(p[k], expected, 1e-14 * extent) << a.name << " node " << n;
      }
    }
  }
}

TEST(LatticeTotals, NoNodeIsLooseOrDoubled) {
  for (const auto& a : zoo()) {
    const Mesh mesh = build_mesh(a.scene, a.card);
    std::vector<int> elements(mesh.node_count(), 0);
    std::vector<int> cells(mesh.node_count(), 0);
    for (const auto& ends : mesh.yarns.node)
      for (const int n : ends) ++elements[n];
    for (const int n : mesh.cells.node) ++cells[n];
    std::vector<std::array<double, 3>> place = mesh.nodes.position;
    std::sort(place.begin(), place.end());
    EXPECT_EQ(std::adjacent_find(place.begin(), place.end()), place.end()) << a.name;
    std::vector<bool> held(mesh.node_count(), false);
    for (const auto& set : mesh.sets)
      for (const int n : set.node) held[n] = held[n] || set.name != "outline";
    for (int n = 0; n < mesh.node_count(); ++n) {
      EXPECT_GE(elements[n], 1) << a.name << " node " << n;
      EXPECT_TRUE(cells[n] > 0 || held[n]) << a.name << " node " << n;
    }
  }
}

TEST(LatticeTotals, AnUnturnedBlankOfWholeCellsIsAPlainGrid) {
  Animal a = animal(plain_weave(), 0.0, {10.0, 6.0}, {1.0, 1.0}, {0.0, 0.0}, false);
  const Mesh mesh = build_mesh(a.scene, a.card);
  EXPECT_EQ(mesh.lattice_size, (std::array<int, 2>{11, 7}));
  EXPECT_EQ(mesh.node_count(), 77);
  EXPECT_EQ(mesh.cells.size(), 60);
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const bool inner = mesh.yarns.yarns[e] > 0.75;
    EXPECT_NEAR(mesh.yarns.yarns[e], inner ? 1.0 : 0.5, 1e-12);  // yarns along the edge stand for half a strip
  }
}

TEST(LatticeTotals, OrientationAndPositionMoveTheMeshRigidly) {
  for (const double angle : {0.0, 37.0, 90.0}) {
    Animal a = animal(twill(), 30.0, {7.3, 9.1}, {1.0, 2.0}, {0.2, 0.4}, true);
    const Mesh still = build_mesh(a.scene, a.card);
    a.scene.blank.orientation = angle;
    a.scene.blank.position = {100.0, -20.0, 7.0};
    const Mesh moved = build_mesh(a.scene, a.card);
    const double c = std::cos(angle * std::numbers::pi / 180.0);
    const double s = std::sin(angle * std::numbers::pi / 180.0);
    ASSERT_EQ(moved.node_count(), still.node_count());
    for (int n = 0; n < still.node_count(); ++n) {
      const auto p = in_blank(still, n);
      EXPECT_NEAR(moved.nodes.position[n][0], 100.0 + c * p[0] - s * p[1], 1e-12);
      EXPECT_NEAR(moved.nodes.position[n][1], -20.0 + s * p[0] + c * p[1], 1e-12);
      EXPECT_EQ(moved.nodes.position[n][2], 7.0);
    }
    EXPECT_EQ(moved.nodes.mass, still.nodes.mass);
    EXPECT_EQ(moved.cells.coefficient, still.cells.coefficient);
  }
}

TEST(LatticeTotals, ABlankTooSmallForItsCellsIsRefused) {
  Animal a = animal(plain_weave(), 45.0, {2.0, 20.0}, {1.0, 1.0}, {0.0, 0.0}, false);
  EXPECT_THROW(static_cast<void>(build_mesh(a.scene, a.card)), InputError);
  Animal coarse = animal(plain_weave(), 45.0, {10.0, 10.0}, {1.0, 1.0}, {0.0, 0.0}, false);
  coarse.scene.blank.coarsening = {1.0, 8.0};  // hardly a weft line left, though the warp lines are many
  EXPECT_THROW(static_cast<void>(build_mesh(coarse.scene, coarse.card)), InputError);
}

}  // namespace
}  // namespace weaveform
