// The cells that count in increments (incremental, side-frame): no potential to differentiate, so their forces are held
// against the power of their stress, against rigid motion, and against the homogeneous patch.
#include "solver/element/incremental_cell.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <functional>
#include <tuple>
#include <vector>

#include "core/vector/angle.hpp"
#include "solver/element/kernel_law.hpp"
#include "tests/support/fabric_patch.hpp"

namespace weaveform {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::FabricPatch;
using Directions = std::array<Vector3d, 2>;  // g1, g2
using Path = std::function<Directions(double)>;

constexpr double volume = 12.0;  // mm^3

KernelShear<PaperShearLaw> plain_weave() {
  KernelShear<PaperShearLaw> law;
  if (!pack_law(load_card("twintex-pw").shear.tangent, law.law)) ADD_FAILURE() << "the law does not fit";
  return law;
}

CellHistory flat_history() {
  return {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 0.0, 0.0, 0.0, 0.0, 0.0};
}

template <Frame frame, Thickness thickness>
Directions step(const KernelShear<PaperShearLaw>& law, const Directions& g, CellHistory& history) {
  const double g1[3] = {g[0][0], g[0][1], g[0][2]}, g2[3] = {g[1][0], g[1][1], g[1][2]};
  const CellForce force = incremental_cell_force<frame, thickness>(law, g1, g2, volume, history);
  return {Vector3d(force.warp[0], force.warp[1], force.warp[2]), Vector3d(force.weft[0], force.weft[1], force.weft[2])};
}

template <Frame frame, Thickness thickness>
Directions walk(const Path& path, int increments, CellHistory& history) {
  const auto law = plain_weave();
  Directions force{Vector3d::Zero(), Vector3d::Zero()};
  for (int n = 1; n <= increments; ++n)
    force = step<frame, thickness>(law, path(static_cast<double>(n) / increments), history);
  return force;
}

// Shear, stretch of both yarns, and rotation out of the plane, none in proportion to another.
Directions general_path(double t) {
  const double gamma = 40.0 * degree * t, stretch1 = 1.0 + 0.1 * t, stretch2 = 1.0 - 0.05 * t * t;
  const Matrix3d turn = Eigen::AngleAxisd(1.2 * t * t, Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
  return {stretch1 * (turn * Vector3d(std::cos(0.3 * gamma), std::sin(0.3 * gamma), 0.0)),
          stretch2 * (turn * Vector3d(std::sin(0.7 * gamma), std::cos(0.7 * gamma), 0.0))};
}

template <Frame f, Thickness t>
struct Variant {
  static constexpr Frame frame = f;
  static constexpr Thickness thickness = t;
};

template <class T>
class IncrementalCell : public testing::Test {};
using Variants =
    testing::Types<Variant<Frame::green_naghdi, Thickness::constant_volume>,
                   Variant<Frame::green_naghdi, Thickness::constant>, Variant<Frame::side, Thickness::constant_volume>,
                   Variant<Frame::side, Thickness::constant>>;
TYPED_TEST_SUITE(IncrementalCell, Variants);

TYPED_TEST(IncrementalCell, RigidRotationOfAnUnstressedCellGivesNoStressHoweverCoarse) {
  for (const double angle : {1.0, 30.0, 90.0, 150.0}) {
    const auto path = [&](double t) {
      const Matrix3d turn =
          Eigen::AngleAxisd(t * angle * degree, Vector3d(0.4, -0.3, 1.0).normalized()).toRotationMatrix();
      return Directions{turn.col(0), turn.col(1)};
    };
    CellHistory history = flat_history();
    const auto force = walk<TypeParam::frame, TypeParam::thickness>(path, 1, history);
    // the midpoint increment of a rotation is skew (Hughes & Winget 1980): what is left is rounding of the directions
    // (1e-16) times modulus 0.26 MPa times volume, enlarged by 1/cos(angle/2)^2
    EXPECT_LT(force[0].norm() + force[1].norm(), 1e-13) << angle << " deg";
    EXPECT_LT(std::abs(history.strain), 1e-14) << angle << " deg";
  }
}

TYPED_TEST(IncrementalCell, RigidRotationTurnsTheForcesOfAStressedCellAlong) {
  CellHistory history = flat_history();
  const auto before = walk<TypeParam::frame, TypeParam::thickness>(general_path, 50, history);
  const auto end = general_path(1.0);
  const auto law = plain_weave();
  for (const double angle : {10.0, 70.0, -80.0, 45.0}) {  // single increments of 10 to 150 deg
    const Matrix3d turn = Eigen::AngleAxisd(angle * degree, Vector3d(-0.2, 1.0, 0.6).normalized()).toRotationMatrix();
    const auto force = step<TypeParam::frame, TypeParam::thickness>(law, {turn * end[0], turn * end[1]}, history);
    for (int f = 0; f < 2; ++f)
      EXPECT_LT((force[f] - turn * before[f]).norm(), 1e-13 * volume) << "at " << angle << " deg, family " << f;
  }
}

// Straight through the definitions, with matrices: strain increment, frame, force. One step of general size.
TYPED_TEST(IncrementalCell, OneStepIsWhatTheDefinitionsSay) {
  const auto law = plain_weave();
  const auto from = general_path(0.8), to = general_path(1.0);
  CellHistory history = flat_history();
  walk<TypeParam::frame, TypeParam::thickness>([](double t) { return general_path(0.8 * t); }, 30, history);
  const CellHistory old = history;
  const auto force = step<TypeParam::frame, TypeParam::thickness>(law, to, history);

  using Columns = Eigen::Matrix<double, 3, 2>;
  using Eigen::Matrix2d;
  const auto columns = [](const Directions& g) { return (Columns() << g[0], g[1]).finished(); };
  // U from the eigenvalues of G^T G, not the closed form the code uses
  const auto polar = [](const Columns& g) {
    return Eigen::SelfAdjointEigenSolver<Matrix2d>(g.transpose() * g).operatorSqrt();
  };
  const auto frame = [&](const Columns& g) -> Columns {
    if (TypeParam::frame == Frame::green_naghdi) return g * polar(g).inverse();
    Columns e;
    e.col(0) = g.col(0).normalized();
    e.col(1) = (g.col(1) - g.col(1).dot(e.col(0)) * e.col(0)).normalized();
    return e;
  };
  const Columns middle = 0.5 * (columns(from) + columns(to)), change = columns(to) - columns(from);
  const Columns e = frame(middle);
  const Matrix2d rate = e.transpose() * change * (e.transpose() * middle).inverse();
  const Matrix2d strain = 0.5 * (rate + rate.transpose());
  const double shear = 2.0 * strain(0, 1);
  // angles of Eq. 10 in the Green-Naghdi frame
  const Matrix2d stretch = polar(middle);
  const double a = std::atan2(stretch(1, 0), stretch(0, 0));
  const double theta = std::atan2(stretch(1, 1), stretch(0, 1)) - a;
  const double increment = law.tangent(old.strain + 0.5 * shear) * shear;  // Eq. 8
  Matrix2d stress;
  stress(0, 0) = old.stress1 + 2.0 * std::cos(a) * std::cos(a + theta) * increment;
  stress(1, 1) = old.stress2 + 2.0 * std::sin(a) * std::sin(a + theta) * increment;
  stress(0, 1) = stress(1, 0) = old.stress4 + std::sin(2.0 * a + theta) * increment;
  const Columns g = columns(to);
  const double area = std::sqrt((g.transpose() * g).determinant());
  const double now = TypeParam::thickness == Thickness::constant ? volume * area : volume;
  // power V sigma : D = F : dG/dt with D = sym(E^T dG/dt (E^T G)^-1)
  const Columns expected = now * frame(g) * stress * (frame(g).transpose() * g).inverse().transpose();
  for (int f = 0; f < 2; ++f) EXPECT_LT((force[f] - expected.col(f)).norm(), 1e-13 * volume) << "family " << f;
  EXPECT_NEAR(history.stress4, stress(0, 1), 1e-14);
  EXPECT_NEAR(history.strain, old.strain + shear, 1e-14);
}

// The work kept by the cell is integral V sigma : D dt; the forces' own work along the path, integral F . dg by the
// trapezoid, is the same integral by another rule. Both are of second order, so the difference falls by 4 a halving.
TYPED_TEST(IncrementalCell, WorkOfTheForcesIsTheIntegralOfStressPower) {
  const auto law = plain_weave();
  double last = 0.0;
  for (const int increments : {100, 200, 400, 800}) {
    CellHistory history = flat_history();
    Directions force{Vector3d::Zero(), Vector3d::Zero()}, g = general_path(0.0);
    double work = 0.0;
    for (int n = 1; n <= increments; ++n) {
      const auto next = general_path(static_cast<double>(n) / increments);
      const auto pull = step<TypeParam::frame, TypeParam::thickness>(law, next, history);
      for (int f = 0; f < 2; ++f) work += 0.5 * (force[f] + pull[f]).dot(next[f] - g[f]);
      force = pull;
      g = next;
    }
    const double difference = std::abs(work - history.work);
    EXPECT_GT(history.work, 0.1) << "the path does no work: nothing is tested";
    if (last > 0.0) {
      EXPECT_NEAR(last / difference, 4.0, 0.3) << increments << " increments";
    }
    last = difference;
  }
  EXPECT_LT(last, 1e-5);
}

// Symmetric stress has no moment: g1 x F1 + g2 x F2 = 0.
TYPED_TEST(IncrementalCell, ForcesHaveNoMoment) {
  CellHistory history = flat_history();
  const auto force = walk<TypeParam::frame, TypeParam::thickness>(general_path, 20, history);
  const auto g = general_path(1.0);
  EXPECT_LT((g[0].cross(force[0]) + g[1].cross(force[1])).norm(), 1e-13 * volume);
}

// An increment in the plane of the cell leaves forces in that plane.
TYPED_TEST(IncrementalCell, ForcesLieInThePlaneOfTheCell) {
  CellHistory history = flat_history();
  const auto force = walk<TypeParam::frame, TypeParam::thickness>(general_path, 20, history);
  const auto g = general_path(1.0);
  const Vector3d normal = g[0].cross(g[1]).normalized();
  for (int f = 0; f < 2; ++f) EXPECT_LT(std::abs(force[f].dot(normal)), 1e-13 * volume);
}

class IncrementalPatch : public testing::TestWithParam<std::tuple<Formulation, Thickness, double>> {};
INSTANTIATE_TEST_SUITE_P(All, IncrementalPatch,
                         testing::Combine(testing::Values(Formulation::incremental, Formulation::side_frame),
                                          testing::Values(Thickness::constant_volume, Thickness::constant),
                                          testing::Values(0.0, 30.0)));

// A patch with full quads and cut cells in homogeneous motion: the inner nodes feel nothing, whatever the cells around
// them look like, and the work of all cells is that of one cell scaled by volume.
TEST_P(IncrementalPatch, HomogeneousMotionLeavesTheInsideInBalance) {
  const auto [formulation, thickness, yarn_angle] = GetParam();
  FabricPatch patch("twintex-tw", yarn_angle, {40.0, 50.0}, formulation, thickness);
  FabricForces fabric(patch.packed, patch.card, patch.laws, patch.scene.model, patch.state, alone());
  const auto yarns = patch.yarn_directions();
  const Vector3d &warp = yarns[0], &weft = yarns[1];
  for (int n = 1; n <= 40; ++n) {
    const double gamma = n * degree, spin = 0.8 * n * degree;
    const Matrix3d turn = Eigen::AngleAxisd(spin, Vector3d(0.3, 0.2, 1.0).normalized()).toRotationMatrix();
    const Vector3d g1 = turn * (std::cos(0.5 * gamma) * warp + std::sin(0.5 * gamma) * weft);
    const Vector3d g2 = turn * (std::sin(0.5 * gamma) * warp + std::cos(0.5 * gamma) * weft);
    patch.move([&](const Vector3d& x) { return Vector3d(x.dot(warp) * g1 + x.dot(weft) * g2); });
    fabric.compute(patch.state);
  }
  std::vector<bool> inside(patch.mesh.nodes.mass.size(), true);
  for (const auto& set : patch.mesh.sets)
    if (set.name == "outline")
      for (const int n : set.node) inside[n] = false;
  // Cells that the outline cuts touch crossings next to it too; those that only full quads touch are inside.
  std::vector<int> quads(inside.size(), 0);
  for (int c = 0; c < patch.mesh.cells.size(); ++c)
    for (int a = patch.mesh.cells.offset[c]; a < patch.mesh.cells.offset[c + 1]; ++a)
      if (patch.mesh.cells.area[c] > (1.0 - 1e-9) * patch.mesh.spacing[0] * patch.mesh.spacing[1])
        ++quads[patch.mesh.cells.node[a]];
  double greatest = 0.0, rest = 0.0;
  int count = 0;
  for (std::size_t n = 0; n < inside.size(); ++n) {
    const int at = patch.packed.packed_of_mesh[n];
    const double force = std::hypot(patch.state.force[0][at], patch.state.force[1][at], patch.state.force[2][at]);
    greatest = std::max(greatest, force);
    if (!inside[n] || quads[n] < 4) continue;
    rest = std::max(rest, force);
    ++count;
  }
  EXPECT_GT(count, 20);
  EXPECT_GT(greatest, 0.01);
  EXPECT_LT(rest, 1e-11 * greatest + 1e-10);  // rounding of coordinates times the yarns' compression modulus
  // one cell of the same volume, driven the same way
  double cells = 0.0;
  for (const double area : patch.mesh.cells.area) cells += area;
  EXPECT_NEAR(cells, 40.0 * 50.0, 1e-9 * cells);
  const double work_density = fabric.cell_work() / (cells * patch.card.thickness);
  FabricPatch other("twintex-tw", yarn_angle, {90.0, 30.0}, formulation, thickness);
  FabricForces other_fabric(other.packed, other.card, other.laws, other.scene.model, other.state, alone());
  for (int n = 1; n <= 40; ++n) {
    const double gamma = n * degree;
    const Vector3d g1 = std::cos(0.5 * gamma) * warp + std::sin(0.5 * gamma) * weft;
    const Vector3d g2 = std::sin(0.5 * gamma) * warp + std::cos(0.5 * gamma) * weft;
    other.move([&](const Vector3d& x) { return Vector3d(x.dot(warp) * g1 + x.dot(weft) * g2); });
    other_fabric.compute(other.state);
  }
  // The rotation of the first patch costs of the order of its increments squared: (0.8 deg)^2 = 2e-4.
  EXPECT_NEAR(other_fabric.cell_work() / (90.0 * 30.0 * other.card.thickness), work_density, 2e-4 * work_density);
}

}  // namespace
}  // namespace weaveform
