#include "solver/result/fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/vector/angle.hpp"
#include "tests/unit/solver/lattice/trellis.hpp"

namespace weaveform {
namespace {

// A turn about an axis that is none of the coordinate axes, and a shift.
std::vector<Vec3> moved_rigidly(std::vector<Vec3> position) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (Vec3& x : position) {
    x = {c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]};
    x = {x[0], c * x[1] - s * x[2], s * x[1] + c * x[2]};
    x = {x[0] + 100.0, x[1] - 50.0, x[2] + 20.0};
  }
  return position;
}

// Axial force of one warp element of unit spacing stretched to `length`, all else as given.
Fields stretched(Mesh mesh, const ModelSpec& model, double length) {
  std::vector<Vec3> position = mesh.nodes.position;
  for (Vec3& x : position) x[0] *= length / mesh.spacing[0];
  return compute_fields(mesh, test::small_card(), model, 0.0, position);
}

TEST(Fields, ARowHasTheAnglesItShowsAndNoOthers) {
  const Mesh mesh = test::lattice(5, 4, 5.0);
  const auto position = moved_rigidly(test::trellis(mesh, 0.4));
  const Fields frame = compute_fields(mesh, test::small_card(), {}, 2.0, position);
  const Fields row = compute_row_fields(mesh, blank_plane(mesh), 2.0, position, {1, 7});
  EXPECT_EQ(row.time, 2.0);
  EXPECT_EQ(row.position, frame.position);
  EXPECT_EQ(row.folded, frame.folded);
  ASSERT_EQ(row.shear_angle.size(), frame.shear_angle.size());
  for (std::size_t c = 0; c < row.shear_angle.size(); ++c)
    if (c == 1 || c == 7)
      EXPECT_EQ(row.shear_angle[c], frame.shear_angle[c]);
    else
      EXPECT_TRUE(std::isnan(row.shear_angle[c])) << c;
}

TEST(Fields, TrellisAngleIsExactAtAllAnglesOfBothSigns) {
  const Mesh mesh = test::lattice(5, 4, 5.0);
  for (int degrees = -89; degrees <= 89; ++degrees) {
    const double angle = degrees * degree;
    const Fields fields = compute_fields(mesh, test::small_card(), {}, 0.0, moved_rigidly(test::trellis(mesh, angle)));
    // Positions near 100 mm carry 1e-14 mm of rounding; over a cell of 5 mm that is some 1e-14 rad.
    for (const double found : fields.shear_angle) EXPECT_NEAR(found, angle, 1e-13) << degrees << " deg";
    for (const double strain : fields.yarn_strain) EXPECT_NEAR(strain, 0.0, 1e-13) << degrees << " deg";
    EXPECT_EQ(std::count(fields.folded.begin(), fields.folded.end(), true), 0) << degrees << " deg";
  }
}

TEST(Fields, DirectionsAreUnitVectorsAlongTheYarns) {
  const Mesh mesh = test::lattice(3, 3, 5.0);
  const Fields fields = compute_fields(mesh, test::small_card(), {}, 0.0, test::trellis(mesh, 0.6));
  for (const Vec3& g : fields.warp) {
    EXPECT_NEAR(g[0], std::cos(0.3), 1e-14);
    EXPECT_NEAR(g[1], std::sin(0.3), 1e-14);
  }
  for (const Vec3& g : fields.weft) {
    EXPECT_NEAR(g[0], std::sin(0.3), 1e-14);
    EXPECT_NEAR(g[1], std::cos(0.3), 1e-14);
  }
}

TEST(Fields, DisplacementIsFromTheInitialPosition) {
  const Mesh mesh = test::lattice(2, 2, 5.0);
  std::vector<Vec3> position = mesh.nodes.position;
  position[3][2] += 2.5;
  const Fields fields = compute_fields(mesh, test::small_card(), {}, 0.25, position);
  EXPECT_EQ(fields.time, 0.25);
  EXPECT_EQ(fields.displacement[3], (Vec3{0.0, 0.0, 2.5}));
  EXPECT_EQ(fields.displacement[0], (Vec3{0.0, 0.0, 0.0}));
}

TEST(Fields, YarnForceFollowsTheTangentLawAndTheSectionRule) {
  const Mesh mesh = test::lattice(2, 2, 5.0);
  const double length = 5.3, strain = std::log(length / 5.0);
  const double stress = 100.0 * strain + 5000.0 * strain * strain;  // integral of small_card's first piece
  const Fields incompressible = stretched(mesh, {}, length);
  EXPECT_NEAR(incompressible.yarn_strain[0], strain, 1e-14);
  EXPECT_NEAR(incompressible.yarn_force[0], stress * 1.25 * 5.0 / length, 1e-12);
  ModelSpec model;
  model.section = Section::constant;
  EXPECT_NEAR(stretched(mesh, model, length).yarn_force[0], stress * 1.25, 1e-12);
}

TEST(Fields, YarnInCompressionHasTheCompressionModulus) {
  const double length = 4.9, strain = std::log(length / 5.0);
  ModelSpec model;
  model.yarn_stiffness_scale = 3.0;
  const Fields fields = stretched(test::lattice(2, 2, 5.0), model, length);
  EXPECT_NEAR(fields.yarn_force[0], 3.0 * 20.0 * strain * 1.25 * 5.0 / length, 1e-12);
}

TEST(Fields, JawLengthensAndSofteningWeakensAShortEnd) {
  Mesh mesh = test::lattice(2, 2, 5.0);
  mesh.yarns.jaw[0] = 5.0;
  mesh.yarns.softening[0] = 0.25;
  const double strain = std::log(10.3 / 10.0);
  const double stress = 100.0 * strain + 5000.0 * strain * strain;
  const Fields fields = stretched(mesh, {}, 5.3);
  EXPECT_NEAR(fields.yarn_strain[0], strain, 1e-14);
  EXPECT_NEAR(fields.yarn_force[0], stress * 1.25 * 0.25 * 10.0 / 10.3, 1e-12);
}

TEST(YarnLaws, LinearLawTakesDecrimpingOutAndScaleMultiplies) {
  const Card card = test::small_card();
  ModelSpec model;
  model.yarn_stiffness_scale = 0.5;
  EXPECT_NEAR(yarn_laws(card, model)[0].stress(0.05), 0.5 * card.yarn[0].tension.stress(0.05), 1e-13);
  model.yarn_law = YarnLaw::linear;
  EXPECT_NEAR(yarn_laws(card, model)[1].stress(0.05), 0.5 * 2000.0 * 0.05, 1e-13);
  EXPECT_NEAR(yarn_laws(card, model)[1].stress(2.0), 0.5 * 2000.0 * 2.0, 1e-10);
}

TEST(FoldedCells, OneTurnedOverCellIsFoundInThePlaneAndOnACurvedSheet) {
  const Mesh mesh = test::lattice(6, 6, 5.0);
  const int corner = test::node_at(0, 0, 6);
  for (const double radius : {0.0, 20.0}) {
    std::vector<Vec3> position = mesh.nodes.position;
    // Pulled across its cell's far corner, the corner node turns its own cell over and no other.
    position[corner] = {14.0, 14.0, 0.0};
    if (radius > 0.0)
      for (Vec3& x : position) x = {radius * std::sin(x[0] / radius), x[1], radius * std::cos(x[0] / radius)};
    const std::vector<bool> folded = folded_cells(mesh, blank_plane(mesh), position);
    EXPECT_TRUE(folded[0]) << "radius " << radius;
    EXPECT_EQ(std::count(folded.begin(), folded.end(), true), 1) << "radius " << radius;
  }
}

TEST(FoldedCells, SheetBentBackOnItselfIsNotFolded) {
  const Mesh mesh = test::lattice(21, 4, 5.0);
  std::vector<Vec3> position = mesh.nodes.position;
  const double radius = 100.0 / (1.5 * std::numbers::pi);  // three quarters of a tube
  for (Vec3& x : position) x = {radius * std::sin(x[0] / radius), x[1], radius * std::cos(x[0] / radius)};
  const std::vector<bool> folded = folded_cells(mesh, blank_plane(mesh), position);
  EXPECT_EQ(std::count(folded.begin(), folded.end(), true), 0);
}

TEST(FoldedCells, PlanarBlankShearedPast90DegIsFoldedAltogether) {
  const Mesh mesh = test::lattice(4, 4, 5.0);
  const std::vector<bool> folded = folded_cells(mesh, blank_plane(mesh), test::trellis(mesh, 91.0 * degree));
  EXPECT_EQ(std::count(folded.begin(), folded.end(), true), mesh.cells.size());
}

}  // namespace
}  // namespace weaveform
