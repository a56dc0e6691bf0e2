// Shear cells: well-formed polygons whose coefficients return the deformation gradient exactly.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <set>

#include "tests/unit/mesher/lattice/lattice_zoo.hpp"

namespace weaveform {
namespace {

using namespace lattice_zoo;

TEST(LatticeCells, AreCounterClockwisePolygonsOfThreeToSixNodes) {
  for (const auto& a : zoo()) {
    const Mesh mesh = build_mesh(a.scene, a.card);
    ASSERT_GT(mesh.cells.size(), 0) << a.name;
    for (int c = 0; c < mesh.cells.size(); ++c) {
      const int first = mesh.cells.offset[c];
      const int count = mesh.cells.offset[c + 1] - first;
      EXPECT_TRUE(count >= 3 && count <= 6) << a.name << " cell " << c;
      EXPECT_GT(mesh.cells.area[c], 0.0) << a.name << " cell " << c;
      double doubled = 0.0;
      for (int k = 0; k < count; ++k) {
        const auto p = in_blank(mesh, mesh.cells.node[first + k]);
        const auto q = in_blank(mesh, mesh.cells.node[first + (k + 1) % count]);
        const auto r = in_blank(mesh, mesh.cells.node[first + (k + 2) % count]);
        doubled += p[0] * q[1] - p[1] * q[0];
        const double corner = (q[0] - p[0]) * (r[1] - q[1]) - (q[1] - p[1]) * (r[0] - q[0]);
        EXPECT_GE(corner, -1e-7 * mesh.spacing[0] * mesh.spacing[1]) << a.name << " cell " << c;  // convex
      }
      // The thinnest polygon that may stand alone: a triangle 0.1 spacings high.
      EXPECT_GT(0.5 * doubled, 0.005 * mesh.spacing[0] * mesh.spacing[1]) << a.name << " cell " << c;
    }
  }
}

TEST(LatticeCells, CoefficientsReturnEveryHomogeneousDeformation) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> entry(-2.0, 2.0);
  for (const auto& a : zoo()) {
    const Mesh mesh = build_mesh(a.scene, a.card);
    double f[3][2];
    for (auto& row : f)
      for (double& value : row) value = entry(random);
    const double extent = std::hypot(a.scene.blank.size[0], a.scene.blank.size[1]);
    for (int c = 0; c < mesh.cells.size(); ++c) {
      for (const Family family : {Family::warp, Family::weft}) {
        const auto along = direction(a.scene, family);
        for (const auto& row : f) {
          double g = 0.0;
          double greatest = 0.0;
          for (int k = mesh.cells.offset[c]; k < mesh.cells.offset[c + 1]; ++k) {
            const auto p = in_blank(mesh, mesh.cells.node[k]);
            const double weight = mesh.cells.coefficient[k][static_cast<std::size_t>(family)];
            g += weight * (row[0] * p[0] + row[1] * p[1] + 11.0);  // the shift must drop out
            greatest = std::max(greatest, std::abs(weight));
          }
          // Rounding of positions of the blank's extent, differenced over a cell.
          EXPECT_NEAR(g, row[0] * along[0] + row[1] * along[1], 1e-14 * greatest * (extent + 11.0))
              << a.name << " cell " << c;
        }
      }
    }
  }
}

TEST(LatticeCells, WholeQuadsHaveTheBilinearGradientAtTheirCentre) {
  for (const auto& a : zoo()) {
    const Mesh mesh = build_mesh(a.scene, a.card);
    const std::array<std::array<double, 2>, 4> sign = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    for (int c = 0; c < mesh.cells.size(); ++c) {
      const int first = mesh.cells.offset[c];
      if (mesh.cells.offset[c + 1] - first != 4) continue;
      const std::array<int, 2> lowest = mesh.cells.lattice[c];
      const auto is_crossing = [&](int k, int di, int dj) {
        return mesh.nodes.crossing[mesh.cells.node[first + k]] == std::array<int, 2>{lowest[0] + di, lowest[1] + dj};
      };
      if (!is_crossing(0, 0, 0) || !is_crossing(1, 1, 0) || !is_crossing(2, 1, 1) || !is_crossing(3, 0, 1)) continue;
      for (int k = 0; k < 4; ++k)
        for (std::size_t f = 0; f < 2; ++f)
          EXPECT_DOUBLE_EQ(mesh.cells.coefficient[first + k][f], sign[k][f] * 0.5 / mesh.spacing[f]) << a.name;
    }
  }
}

TEST(LatticeCells, EveryLatticeCellAppearsOnce) {
  for (const auto& a : zoo()) {
    const Mesh mesh = build_mesh(a.scene, a.card);
    const std::set<std::array<int, 2>> distinct(mesh.cells.lattice.begin(), mesh.cells.lattice.end());
    EXPECT_EQ(static_cast<int>(distinct.size()), mesh.cells.size()) << a.name;
  }
}

}  // namespace
}  // namespace weaveform
