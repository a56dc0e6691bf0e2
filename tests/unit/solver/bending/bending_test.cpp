// Bending without unknowns: beams and rotation-free cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/error.hpp"
#include "solver/bending/bending_energy.hpp"
#include "solver/bending/lattice_bending.hpp"
#include "solver/bending/moment_law.hpp"
#include "tests/support/fabric_patch.hpp"

namespace weaveform {
namespace {

using Eigen::Vector3d;
using test::FabricPatch;

TangentLaw constant(double stiffness) {
  return TangentLaw({{0.0, std::numeric_limits<double>::infinity(), {stiffness}}});
}

// A law that stiffens and then yields, per yarn.
TangentLaw curved(double scale) {
  return TangentLaw({{0.0, 0.02, {scale, 40.0 * scale}},
                     {0.02, 0.1, {0.4 * scale}},
                     {0.1, std::numeric_limits<double>::infinity(), {0.1 * scale}}});
}

// The same law, cut into pieces of 0.002/mm up to 0.12/mm.
TangentLaw in_many_pieces(const TangentLaw& law) {
  std::vector<TangentPiece> pieces;
  for (int k = 0; k < 60; ++k) {
    const double from = 0.002 * k, to = 0.002 * (k + 1), middle = from + 0.001;
    const auto whole = std::find_if(law.pieces().begin(), law.pieces().end(),
                                    [&](const TangentPiece& piece) { return middle < piece.to; });
    pieces.push_back({from, to, whole->coefficient});
  }
  return TangentLaw(pieces);
}

Flexure flexure(const TangentLaw& in, const BendingLaw& out, double twist) {
  Flexure result;
  result.in_plane = {in, in};
  result.out_of_plane = {out, out};
  result.twist = twist;
  result.bends_yarns = true;
  result.rotation_free = true;
  return result;
}

// The lower edge is clamped; the rest is crumpled.
struct CrumpledPatch {
  FabricPatch patch;
  std::vector<char> held;

  explicit CrumpledPatch(double yarn_angle)
      : patch("twintex-tw", yarn_angle, {40.0, 45.0}), held(patch.mesh.node_count(), 0) {
    for (int n = 0; n < patch.mesh.node_count(); ++n) held[n] = patch.mesh.nodes.position[n][1] < -18.0 ? 1 : 0;
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> draw(-0.4, 0.4);
    for (const int n : patch.packed.packed_of_mesh)
      for (int c = 0; c < 3; ++c) patch.state.position[c][n] += draw(generator);
  }

  [[nodiscard]] std::vector<Vector3d> forces(const Flexure& law, int threads = 1) {
    Team team(threads);
    LatticeBending bending(patch.mesh, patch.packed, law, held, patch.state, team);
    for (auto& component : patch.state.force) std::fill(component.begin(), component.end(), 0.0);
    bending.add_forces(patch.state, 0.0);
    std::vector<Vector3d> result;
    for (const int n : patch.packed.packed_of_mesh)
      result.emplace_back(patch.state.force[0][n], patch.state.force[1][n], patch.state.force[2][n]);
    return result;
  }
};

class BendingOf : public testing::TestWithParam<std::tuple<double, int>> {
protected:
  [[nodiscard]] static Flexure law(int kind) {
    if (kind == 0) return flexure(constant(5.0), constant(5.0), 0.0);   // isotropic
    if (kind == 1) return flexure(constant(30.0), constant(5.0), 0.7);  // with the fabric's normal, and twist
    if (kind == 2) return flexure(curved(20.0), curved(5.0), 0.7);
    if (kind == 3) return flexure(in_many_pieces(curved(20.0)), curved(5.0), 0.7);
    if (kind == 4) return flexure(curved(20.0), {curved(5.0), in_many_pieces(curved(9.0))}, 0.7);  // two senses
    return flexure(constant(5.0), {constant(5.0), constant(9.0)}, 0.7);
  }
};

// Central difference of the energy; h = 1e-5 mm leaves h^2/6 of the third derivative, below 1e-6 of the greatest force
// here, and rounding of 1e-16 E/h, below that.
TEST_P(BendingOf, ForceIsMinusTheGradientOfTheStoredEnergy) {
  const auto [angle, kind] = GetParam();
  CrumpledPatch crumpled(angle);
  auto& patch = crumpled.patch;
  const Flexure chosen = law(kind);
  const auto force = crumpled.forces(chosen);
  LatticeBending bending(patch.mesh, patch.packed, chosen, crumpled.held, patch.state, alone());
  double greatest = 0.0;
  for (const auto& f : force) greatest = std::max(greatest, f.norm());
  ASSERT_GT(greatest, 0.1);
  constexpr double h = 1e-5;
  for (int n = 0; n < patch.mesh.node_count(); ++n) {
    if (crumpled.held[n] != 0)
      continue;  // a clamp's direction does not turn with the node: no gradient is missed, but
                 // the jaws bear what is on it
    for (int c = 0; c < 3; ++c) {
      double& x = patch.state.position[c][patch.packed.packed_of_mesh[n]];
      const double before = x;
      x = before + h;
      const double up = bending.stored_energy().total;
      x = before - h;
      const double down = bending.stored_energy().total;
      x = before;
      EXPECT_NEAR(force[n][c], -(up - down) / (2.0 * h), 2e-6 * greatest) << "node " << n << " component " << c;
    }
  }
}

TEST_P(BendingOf, ForcesBalanceAndAnyNumberOfThreadsGivesTheSameBits) {
  const auto [angle, kind] = GetParam();
  CrumpledPatch crumpled(angle);
  std::fill(crumpled.held.begin(), crumpled.held.end(), 0);
  const auto one = crumpled.forces(law(kind), 1), three = crumpled.forces(law(kind), 3);
  Vector3d sum = Vector3d::Zero(), moment = Vector3d::Zero();
  double size = 0.0;
  for (std::size_t n = 0; n < one.size(); ++n) {
    EXPECT_EQ(one[n], three[n]);
    const int p = crumpled.patch.packed.packed_of_mesh[n];
    const auto& x = crumpled.patch.state.position;
    sum += one[n];
    moment += Vector3d(x[0][p], x[1][p], x[2][p]).cross(one[n]);
    size += one[n].norm();
  }
  EXPECT_LT(sum.norm(), 1e-13 * size);
  EXPECT_LT(moment.norm(), 1e-13 * size * 60.0);
}

// Crossings are pins: a trellis at any angle, turned anywhere, is straight along both families.
TEST_P(BendingOf, TrellisShearAndRigidMotionGiveNoForce) {
  const auto [angle, kind] = GetParam();
  FabricPatch patch("twintex-tw", angle, {40.0, 45.0});
  const auto [g1, g2] = patch.yarn_directions();
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized())).toRotationMatrix();
  for (const double degrees : {0.0, 20.0, 55.0}) {
    const double gamma = degrees * 3.14159265358979 / 180.0;
    const Vector3d to = std::sin(gamma) * g1 + std::cos(gamma) * g2;
    patch.state = initial_state(patch.packed, patch.mesh);
    patch.move([&, g = std::array<Vector3d, 2>{g1, g2}](const Vector3d& x) {
      return Vector3d(turn * (x.dot(g[0]) * g[0] + x.dot(g[1]) * to) + Vector3d(3, 4, 5));
    });
    const std::vector<char> free(patch.mesh.node_count(), 0);
    LatticeBending bending(patch.mesh, patch.packed, law(kind), free, patch.state, alone());
    bending.add_forces(patch.state, 0.0);
    // rounding: 1e-16 of 50 mm over 2 mm elements, times B/l^2 = 30/4
    for (const int n : patch.packed.packed_of_mesh)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(patch.state.force[c][n], 0.0, 1e-12);
    EXPECT_NEAR(bending.stored_energy().total, 0.0, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(AnglesAndLaws, BendingOf,
                         testing::Combine(testing::Values(0.0, 30.0, 45.0), testing::Values(0, 1, 2, 3, 4, 5)));

// Measured curves come in dozens of pieces: what a law is cut into does not matter, but for rounding.
TEST(Bending, ALawInManyPiecesIsTheSameLaw) {
  const auto few = flexure(curved(20.0), curved(5.0), 0.7);
  const auto many = flexure(in_many_pieces(few.in_plane[0]), in_many_pieces(few.out_of_plane[0].face()), 0.7);
  CrumpledPatch crumpled(30.0);
  const auto one = crumpled.forces(few), other = crumpled.forces(many);
  double greatest = 0.0;
  for (const auto& f : one) greatest = std::max(greatest, f.norm());
  ASSERT_GT(greatest, 0.1);
  for (std::size_t n = 0; n < one.size(); ++n) EXPECT_LT((one[n] - other[n]).norm(), 1e-12 * greatest) << n;
}

// z -> -z turns the fabric over: warp x weft goes the other way, and what had one side outwards has the other. To the bit:
// every product and sum has its sign turned, or not.
TEST(Bending, AMirroredSheetWithSwappedHalvesHasMirroredForces) {
  const BendingLaw law(curved(5.0), in_many_pieces(curved(9.0)));
  CrumpledPatch crumpled(30.0);
  std::fill(crumpled.held.begin(), crumpled.held.end(), 0);
  const auto force = crumpled.forces(flexure(curved(20.0), law, 0.7));
  const auto not_swapped = crumpled.forces(flexure(curved(20.0), law.turned_over(), 0.7));
  for (double& z : crumpled.patch.state.position[2]) z = -z;
  const auto mirrored = crumpled.forces(flexure(curved(20.0), law.turned_over(), 0.7));
  double difference = 0.0;
  for (std::size_t n = 0; n < force.size(); ++n) {
    for (int c = 0; c < 3; ++c) EXPECT_EQ(mirrored[n][c], c == 2 ? -force[n][c] : force[n][c]) << n;
    difference = std::max(difference, (force[n] - not_swapped[n]).norm());
  }
  EXPECT_GT(difference, 0.01);
}

TEST(Bending, EqualHalvesGiveTheBitsOfAnOddLaw) {
  CrumpledPatch crumpled(30.0);
  const auto odd = crumpled.forces(flexure(curved(20.0), curved(5.0), 0.7)),
             equal = crumpled.forces(flexure(curved(20.0), {curved(5.0), curved(5.0)}, 0.7));
  for (std::size_t n = 0; n < odd.size(); ++n) EXPECT_EQ(odd[n], equal[n]);
}

// Along a dome the side of the normal is outwards, which is the face of a fabric that lies face up; in a bowl the other.
TEST(Bending, TheSenseIsThatOfTheSideOutwards) {
  constexpr double radius = 50.0;
  const BendingLaw law(constant(5.0), constant(9.0));
  for (const double up : {1.0, -1.0}) {  // a bowl rises to its rim
    FabricPatch patch("twintex-pw", 0.0, {60.0, 60.0});
    patch.move([&](const Vector3d& x) {
      return Vector3d(radius * std::sin(x[0] / radius), x[1], up * radius * (1.0 - std::cos(x[0] / radius)));
    });
    const auto bends = find_bends(patch.mesh, std::vector<char>(patch.mesh.node_count(), 0));
    const auto position = mesh_positions(patch.packed, patch.state);
    const auto energy = [&](const BendingLaw& out) {
      return bending_energy(bends, flexure(constant(20.0), out, 0.0), position);
    };
    EXPECT_DOUBLE_EQ(energy(law), energy(constant(up > 0.0 ? 9.0 : 5.0)));
    EXPECT_GT(energy(law), 0.0);
  }
}

// Whatever bends has the card's two halves, changed about where the fabric lies face down; beams beside cells too.
TEST(Bending, AFabricThatLiesFaceDownHasItsHalvesChangedAbout) {
  const BendingLaw law(curved(5.0), constant(9.0));
  Card card = load_card("twintex-pw");
  for (auto& yarn : card.yarn) yarn.bending_out_of_plane = law;
  card.bending.rigidity.reset();
  Scene scene;
  for (const FabricFace face : {FabricFace::up, FabricFace::down}) {
    scene.fabric.face = face;
    const BendingLaw laid = face == FabricFace::up ? law : law.turned_over();
    scene.model.yarn = YarnElement::truss;
    scene.model.cell = CellElement::rotation_free;
    EXPECT_EQ(choose_flexure(card, scene).out_of_plane[0], laid);
    scene.model.cell = CellElement::shell;
    EXPECT_EQ(choose_flexure(card, scene).shell[1], laid);
    scene.model.yarn = YarnElement::beam;
    scene.model.cell = CellElement::membrane;
    EXPECT_EQ(choose_flexure(card, scene).out_of_plane[1], laid);
    scene.model.cell = CellElement::rotation_free;
    scene.model.cell_bending = {{1.0, 1.0, 0.1}};
    EXPECT_EQ(choose_flexure(card, scene).out_of_plane[0], with_constant(laid, card.yarn[0].interval));
    scene.model.cell_bending.reset();
  }
}

// The stiffer sense bounds the step.
TEST(Bending, TheStepIsThatOfTheStifferSense) {
  FabricPatch patch;
  const std::vector<char> held(patch.mesh.node_count(), 0);
  const auto bound = [&](const BendingLaw& out) {
    const LatticeBending bending(patch.mesh, patch.packed, flexure(constant(1.0), out, 0.7), held, patch.state,
                                 alone());
    std::vector<double> sums(patch.mesh.node_count(), 0.0);
    bending.add_stiffness_bound(patch.mesh.nodes.position, 0.0, sums);
    return sums;
  };
  EXPECT_EQ(bound({constant(5.0), constant(9.0)}), bound(constant(9.0)));
  EXPECT_EQ(bound({constant(9.0), constant(5.0)}), bound(constant(9.0)));
}

TEST(Bending, MomentsOfLawsOfAllShapesAreThoseOfTheCard) {
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<TangentPiece> steps;
  for (int k = 0; k < 255; ++k) steps.push_back({1e-3 * k * k, 1e-3 * (k + 1) * (k + 1), {1.0 + k % 7, -1e-3}});
  const TangentLaw longest(steps), from_minus({{-infinity, 0.01, {3.0}}, {0.01, 0.02, {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}}}),
      late({{0.05, infinity, {2.0, 1.0}}});
  for (const TangentLaw& law : {curved(3.0), in_many_pieces(curved(3.0)), longest, from_minus, late}) {
    const auto packed = long_moment(law);
    for (int k = 0; k < 4000; ++k) {
      const double curvature = 2e-8 * k * k * k;
      EXPECT_NEAR(packed->stress(curvature), law.stress(curvature), 1e-12 * (1e-3 + std::abs(law.stress(curvature))));
    }
  }
  const auto sided = sided_moment({curved(3.0), longest});
  for (int k = 0; k < 4000; ++k) {
    const double curvature = 2e-8 * k * k * k;
    EXPECT_EQ(sided->stress(curvature), long_moment(curved(3.0))->stress(curvature));
    EXPECT_EQ(sided->stress(curvature, SidedLaw::most_pieces), long_moment(longest)->stress(curvature));
  }
  EXPECT_EQ(moment_shape(BendingLaw(constant(2.0), constant(3.0))), MomentShape::sided_law);
  EXPECT_EQ(moment_shape(BendingLaw(curved(2.0), curved(2.0))), MomentShape::short_law);
  EXPECT_EQ(moment_shape(constant(2.0)), MomentShape::constant);
  EXPECT_EQ(moment_shape(TangentLaw()), MomentShape::constant);
  EXPECT_EQ(moment_shape(curved(2.0)), MomentShape::short_law);
  EXPECT_EQ(moment_shape(longest), MomentShape::long_law);
  steps.push_back({1e-3 * 255 * 255, 1e-3 * 256 * 256, {1.0}});
  EXPECT_THROW((void)moment_shape(TangentLaw(steps)), InputError);  // 256, and what goes on beyond the last
  EXPECT_THROW((void)moment_shape(BendingLaw(constant(2.0), TangentLaw(steps))), InputError);
  EXPECT_THROW((void)moment_shape(TangentLaw({{0.0, 1.0, {1, 1, 1, 1, 1, 1, 1}}})), InputError);
}

// A cylinder of radius R along the weft: out-of-plane curvature 1/R along the warp, none in plane or along the weft.
// Chords of length L turn by 2 asin(L/2R); the error of the curvature is L^2/(24 R^2) and the series adds less.
TEST(Bending, CurvaturesOfACylinderAndOfAPlaneArc) {
  FabricPatch patch("twintex-pw", 0.0, {60.0, 60.0});
  constexpr double radius = 50.0;
  const auto bends = find_bends(patch.mesh, std::vector<char>(patch.mesh.node_count(), 0));
  const double tolerance = patch.mesh.spacing[0] * patch.mesh.spacing[0] / (20.0 * radius * radius * radius);
  const auto measure = [&] { return curvatures(bends, mesh_positions(patch.packed, patch.state)); };
  const auto interior = [&](int n) {
    return std::abs(patch.mesh.nodes.position[n][0]) < 20.0 && std::abs(patch.mesh.nodes.position[n][1]) < 20.0;
  };
  patch.move([&](const Vector3d& x) {
    return Vector3d(radius * std::sin(x[0] / radius), x[1], radius * (1.0 - std::cos(x[0] / radius)));
  });
  auto kappa = measure();
  for (std::size_t b = 0; b < bends.size(); ++b) {
    if (!interior(bends[b].node)) continue;
    EXPECT_NEAR(kappa[b][0], 0.0, 1e-9);
    EXPECT_NEAR(kappa[b][1], 1.0 / radius, tolerance);  // towards the normal: positive
    EXPECT_NEAR(kappa[b][3], 0.0, 1e-12);
  }
  patch.move([&](const Vector3d& x) {
    const double r = radius + 30.0 - x[1];
    return Vector3d(r * std::sin(x[0] / radius), -r * std::cos(x[0] / radius), 0.0);
  });
  kappa = measure();
  for (std::size_t b = 0; b < bends.size(); ++b) {
    if (!interior(bends[b].node)) continue;
    const double r = radius + 30.0 - patch.mesh.nodes.position[bends[b].node][1];
    const double length = patch.mesh.spacing[0] * r / radius;  // stretched: the spread stays the flat one
    EXPECT_NEAR(kappa[b][0], length / r / patch.mesh.spacing[0], 2.0 * tolerance);
    EXPECT_NEAR(kappa[b][1], 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace weaveform
