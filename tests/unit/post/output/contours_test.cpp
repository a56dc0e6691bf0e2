#include "post/output/contours.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>

#include "core/error.hpp"
#include "core/vector/angle.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/solver/lattice/trellis.hpp"

namespace weaveform {
namespace {

// Angle growing along x by 1 deg per mm from -20 deg at x = 0, on cells of 2 mm.
struct Ramp {
  Mesh mesh = test::lattice(26, 11, 2.0);
  Fields fields;
  Ramp() {
    fields.position = mesh.nodes.position;
    for (int cell = 0; cell < mesh.cells.size(); ++cell)
      fields.shear_angle.push_back((2.0 * mesh.cells.lattice[cell][0] + 1.0 - 20.0) * degree);
  }
};

std::set<double> levels_of(const std::vector<Isoline>& isolines) {
  std::set<double> levels;
  for (const Isoline& line : isolines) levels.insert(std::round(line.level * 1e9) / 1e9);
  return levels;
}

TEST(Contours, LinearFieldHasStraightLinesWhereItShould) {
  const Ramp ramp;
  const std::vector<Isoline> isolines = shear_angle_isolines(ramp.mesh, ramp.fields, 7.0);
  EXPECT_EQ(levels_of(isolines), (std::set<double>{-14.0, -7.0, 7.0, 14.0, 21.0, 28.0}));
  EXPECT_EQ(isolines.size(), 6U);  // segments joined to one line per level
  for (const Isoline& line : isolines) {
    double least = 1e9, greatest = -1e9;
    for (const Vec3& p : line.point) {
      EXPECT_NEAR(p[0], line.level + 20.0, 1e-9);  // averaging and interpolation keep a linear field
      least = std::min(least, p[1]);
      greatest = std::max(greatest, p[1]);
    }
    EXPECT_NEAR(least, 0.0, 1e-12);
    EXPECT_NEAR(greatest, 20.0, 1e-12);
  }
}

TEST(Contours, LieOnTheDeformedSurface) {
  Ramp ramp;
  for (Vec3& x : ramp.fields.position) x = {x[0], 3.0 * x[1], 0.5 * x[0]};
  for (const Isoline& line : shear_angle_isolines(ramp.mesh, ramp.fields, 10.0))
    for (const Vec3& p : line.point) EXPECT_NEAR(p[2], 0.5 * (line.level + 20.0), 1e-9);
}

TEST(Contours, HillHasOneClosedLinePerLevel) {
  Mesh mesh = test::lattice(42, 42, 2.0);
  Fields fields;
  fields.position = mesh.nodes.position;
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const double x = 2.0 * mesh.cells.lattice[cell][0] - 40.0, y = 2.0 * mesh.cells.lattice[cell][1] - 40.0;
    fields.shear_angle.push_back((40.3 - std::hypot(x, y)) * degree);
  }
  const std::vector<Isoline> isolines = shear_angle_isolines(mesh, fields, 10.0);
  std::vector<const Isoline*> raised;
  for (const Isoline& line : isolines)
    if (line.level > 0.0) raised.push_back(&line);
  ASSERT_EQ(raised.size(), 3U);  // 10, 20, 30 deg; the top, averaged over four cells, stays below 40
  for (const Isoline* line : raised) {
    EXPECT_EQ(line->point.front(), line->point.back());
    // Chords of a cone on cells of 2 mm: the line strays by less than a tenth of a cell.
    for (const Vec3& p : line->point) EXPECT_NEAR(std::hypot(p[0] - 41.0, p[1] - 41.0), 40.3 - line->level, 0.2);
  }
}

TEST(Contours, ComeBackFromTheFileBitForBit) {
  const test::TemporaryFolder folder;
  const Ramp ramp;
  const std::vector<Isoline> written = shear_angle_isolines(ramp.mesh, ramp.fields, 5.0);
  ASSERT_FALSE(written.empty());
  write_contours(written, folder.path() / "contours.vtp");
  const std::vector<Isoline> read = read_contours(folder.path() / "contours.vtp");
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t k = 0; k < read.size(); ++k) {
    EXPECT_EQ(read[k].level, written[k].level);
    EXPECT_EQ(read[k].point, written[k].point);
  }
}

TEST(Contours, UnshearedFabricHasNoLinesYetAValidFile) {
  const test::TemporaryFolder folder;
  Ramp ramp;
  // Noise about zero, as an unstretched flange has it, must not draw a maze of zero lines.
  for (std::size_t cell = 0; cell < ramp.fields.shear_angle.size(); ++cell)
    ramp.fields.shear_angle[cell] = cell % 2 == 0 ? 1e-6 : -1e-6;
  const std::vector<Isoline> none = shear_angle_isolines(ramp.mesh, ramp.fields, 5.0);
  EXPECT_TRUE(none.empty());
  write_contours(none, folder.path() / "contours.vtp");
  EXPECT_TRUE(read_contours(folder.path() / "contours.vtp").empty());
}

TEST(Contours, TooSmallAStepIsRefused) {
  const Ramp ramp;
  EXPECT_THROW((void)shear_angle_isolines(ramp.mesh, ramp.fields, 1e-6), InputError);
}

TEST(Contours, MissingAndForeignFilesAreNamed) {
  const test::TemporaryFolder folder;
  EXPECT_THROW((void)read_contours(folder.path() / "contours.vtp"), FileError);
  std::ofstream(folder.path() / "contours.vtp") << "not XML";
  EXPECT_THROW((void)read_contours(folder.path() / "contours.vtp"), InputError);
}

}  // namespace
}  // namespace weaveform
