// The fabric's internal forces against what mechanics says of them, on patches that hold every kind of element.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/error.hpp"
#include "core/vector/angle.hpp"
#include "solver/element/half_log.hpp"
#include "tests/support/fabric_patch.hpp"

namespace weaveform {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::FabricPatch;

struct ForcesVariant {
  const char* material;
  double yarn_angle;
  Formulation formulation;
  Thickness thickness;
  Section section;
};

std::ostream& operator<<(std::ostream& stream, const ForcesVariant& v) {
  return stream << v.material << ' ' << v.yarn_angle << ' ' << name_of(v.formulation) << ' ' << name_of(v.thickness)
                << ' ' << name_of(v.section);
}

class FabricVariants : public testing::TestWithParam<ForcesVariant> {
protected:
  [[nodiscard]] static FabricPatch patch() {
    const auto& v = GetParam();
    return FabricPatch(v.material, v.yarn_angle, {50.0, 70.0}, v.formulation, v.thickness, v.section);
  }
};

INSTANTIATE_TEST_SUITE_P(
    All, FabricVariants,
    testing::Values(
        ForcesVariant{"twintex-pw", 45.0, Formulation::energy, Thickness::constant_volume, Section::incompressible},
        ForcesVariant{"twintex-pw", 17.0, Formulation::energy, Thickness::constant, Section::constant},
        ForcesVariant{"twintex-tw", 0.0, Formulation::energy, Thickness::constant_volume, Section::constant},
        ForcesVariant{"twintex-tw", 71.0, Formulation::energy, Thickness::constant, Section::incompressible},
        ForcesVariant{"twintex-pw", 30.0, Formulation::contravariant, Thickness::constant_volume,
                      Section::incompressible},
        ForcesVariant{"twintex-tw", 45.0, Formulation::contravariant, Thickness::constant, Section::constant}));

// Scale of force against which rounding is judged: a yarn at 1 % strain pulls with some newtons, and the strain itself
// carries the rounding of coordinates (1e-16 * 100 mm / 5 mm) times the compression modulus of 200 MPa times 1.25 mm^2.
constexpr double rounding_force = 1e-10;  // N

TEST_P(FabricVariants, RigidMotionGivesNoForce) {
  auto fabric = patch();
  for (int angle = 0; angle <= 180; angle += 20) {
    const Matrix3d turn =
        Eigen::AngleAxisd(angle * degree, Vector3d(0.3 * (angle % 60), 1.0, 2.0).normalized()).toRotationMatrix();
    fabric.move([&](const Vector3d& x) { return Vector3d(turn * x + Vector3d(12.0, -7.0, 31.0)); });
    for (const auto& force : fabric.forces()) EXPECT_LT(force.norm(), rounding_force) << "at " << angle << " deg";
  }
}

// A smooth, wrinkled, sheared and stretched state with out-of-plane displacement.
void deform(FabricPatch& fabric, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  const Matrix3d gradient = Matrix3d::Identity() + 0.15 * Matrix3d::NullaryExpr([&] { return draw(generator); });
  std::vector<Vector3d> noise;
  for (int n = 0; n < fabric.mesh.node_count(); ++n)
    noise.push_back(0.3 * Vector3d::NullaryExpr([&] { return draw(generator); }));
  int n = 0;
  fabric.move([&](const Vector3d& x) {
    return Vector3d(gradient * x + Vector3d(0.0, 0.0, 2.0 * std::sin(0.2 * x[0])) + noise[n++]);
  });
}

TEST_P(FabricVariants, NodalForceIsMinusTheSlopeOfTheStoredEnergy) {
  auto fabric = patch();
  if (fabric.scene.model.formulation != Formulation::energy) GTEST_SKIP() << "has no stored energy";
  deform(fabric, 7);
  const auto forces = fabric.forces();
  double greatest = 0.0;
  for (const auto& force : forces) greatest = std::max(greatest, force.norm());
  for (int n = 0; n < fabric.mesh.node_count(); n += 3) {
    for (int c = 0; c < 3; ++c) {
      double& x = fabric.state.position[c][fabric.packed.packed_of_mesh[n]];
      const double start = x;
      const auto energy_at = [&](double offset) {
        x = start + offset;
        const double energy = fabric.energy();
        x = start;
        return energy;
      };
      // fourth-order central difference. Where a yarn's strain crosses a joint of its law inside the stencil the
      // tangent jumps (up to 2e4 MPa * 2.5 mm^2 / 2.4 mm) and the error is that times h: 2e-5 mm keeps it below the
      // tolerance, while the rounding of the energy (1e5 mJ * 1e-16 / h) stays at 1e-6 N.
      const double h = 2e-5;
      const double slope = (8.0 * (energy_at(h) - energy_at(-h)) - (energy_at(2 * h) - energy_at(-2 * h))) / (12.0 * h);
      EXPECT_NEAR(forces[n][c], -slope, 1e-7 * greatest) << "node " << n << " component " << c;
    }
  }
}

TEST_P(FabricVariants, InternalForcesKeepLinearAndAngularMomentum) {
  auto fabric = patch();
  deform(fabric, 11);
  const auto forces = fabric.forces();
  Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
  double size = 0.0;
  const auto positions = mesh_positions(fabric.packed, fabric.state);
  for (std::size_t n = 0; n < forces.size(); ++n) {
    force += forces[n];
    moment += Vector3d(positions[n][0], positions[n][1], positions[n][2]).cross(forces[n]);
    size += forces[n].norm();
  }
  EXPECT_LT(force.norm(), 1e-13 * size);
  // the stress of both formulations is symmetric, so it has no moment (lever arms up to 50 mm)
  EXPECT_LT(moment.norm(), 1e-13 * 50.0 * size);
}

TEST_P(FabricVariants, ForcesAreTheSameBitsForAnyNumberOfThreads) {
  auto fabric = patch();
  deform(fabric, 3);
  const auto one = fabric.forces(1);
  for (const int threads : {2, 3, 5}) {
    const auto many = fabric.forces(threads);
    for (std::size_t n = 0; n < one.size(); ++n)
      EXPECT_EQ(one[n], many[n]) << "node " << n << ", " << threads << " threads";
  }
}

// A yarn far from its length at rest has its band computed by another loop: in it, and far from it, others keep their bits.
TEST_P(FabricVariants, AYarnFarFromItsLengthAtRestChangesNoOthersBits) {
  auto fabric = patch();
  const auto bent = [](const Vector3d& x) {
    return Vector3d(1.01 * x[0], 0.99 * x[1] + 0.02 * x[0], std::sin(0.1 * x[0]));
  };
  fabric.move(bent);
  const auto before = fabric.forces();
  const int corner =
      static_cast<int>(std::min_element(fabric.mesh.nodes.position.begin(), fabric.mesh.nodes.position.end(),
                                        [](const Vec3& a, const Vec3& b) { return a[0] + a[1] < b[0] + b[1]; }) -
                       fabric.mesh.nodes.position.begin());
  const Vec3& place = fabric.mesh.nodes.position[corner];
  const double reach = 3.0 * (fabric.mesh.spacing[0] + fabric.mesh.spacing[1]);
  fabric.state.position[0][fabric.packed.packed_of_mesh[corner]] -= 0.5 * fabric.mesh.spacing[0];
  const auto after = fabric.forces();
  EXPECT_NE(before[corner], after[corner]);
  int apart = 0;
  for (std::size_t n = 0; n < after.size(); ++n) {
    const Vec3& x = fabric.mesh.nodes.position[n];
    if (std::hypot(x[0] - place[0], x[1] - place[1]) < reach) continue;
    ++apart;
    EXPECT_EQ(before[n], after[n]) << "node " << n;
  }
  EXPECT_GT(apart, fabric.mesh.node_count() / 4);
}

// What elements compute in single precision is off by some roundings of 6e-8; it is judged against the greatest force of
// any element here, and nodes add up to eight of them. Ten metres from the origin no digit more is lost.
TEST_P(FabricVariants, SinglePrecisionIsOffByRoundingsOfTheElementsForcesWhereverTheyLie) {
  auto fabric = patch();
  deform(fabric, 5);
  const auto in_double = fabric.forces();
  double greatest = 0.0;
  for (const auto& force : in_double) greatest = std::max(greatest, force.norm());
  for (const double far : {0.0, 1e4}) {
    for (const int n : fabric.packed.packed_of_mesh) fabric.state.position[0][n] += far;
    const auto in_single = fabric.forces(1, Precision::single_precision);
    double error = 0.0;
    for (std::size_t n = 0; n < in_single.size(); ++n) error = std::max(error, (in_single[n] - in_double[n]).norm());
    EXPECT_LT(error, 2e-6 * greatest) << "at " << far << " mm";
    EXPECT_GT(error, 0.0) << "it is double precision";
  }
}

TEST_P(FabricVariants, SinglePrecisionGivesTheSameBitsForAnyNumberOfThreads) {
  auto fabric = patch();
  deform(fabric, 3);
  const auto one = fabric.forces(1, Precision::single_precision);
  for (const int threads : {2, 5}) {
    const auto many = fabric.forces(threads, Precision::single_precision);
    for (std::size_t n = 0; n < one.size(); ++n)
      EXPECT_EQ(one[n], many[n]) << "node " << n << ", " << threads << " threads";
  }
}

// A fabric at rest feels what is left of its own roundings: 6e-8 of a stiffness over a strain of which nothing is lost.
TEST_P(FabricVariants, InSinglePrecisionRigidMotionGivesNoForceOfAYarn) {
  auto fabric = patch();
  for (int angle = 0; angle <= 180; angle += 45) {
    const Matrix3d turn =
        Eigen::AngleAxisd(angle * degree, Vector3d(0.3 * (angle % 60), 1.0, 2.0).normalized()).toRotationMatrix();
    fabric.move([&](const Vector3d& x) { return Vector3d(turn * x + Vector3d(12.0, -7.0, 31.0)); });
    // cells of 25 mm^2 and 0.4 mm at C_sh of some MPa, sin gamma off by 1e-7: N over a side
    for (const auto& force : fabric.forces(1, Precision::single_precision)) EXPECT_LT(force.norm(), 3e-6) << angle;
  }
}

TEST(SinglePrecision, RefusesCellsWithAHistory) {
  FabricPatch fabric("twintex-pw", 0.0, {60.0, 80.0}, Formulation::incremental);
  EXPECT_THROW((void)fabric.forces(1, Precision::single_precision), InputError);
}

// Homogeneous trellis motion: yarns turn by -gamma/2 and +gamma/2 without stretching.
void shear_trellis(FabricPatch& fabric, double gamma) {
  const auto directions = fabric.yarn_directions();
  const Vector3d &warp = directions[0], &weft = directions[1];
  const double half = 0.5 * gamma;
  const Vector3d turned_warp = std::cos(half) * warp + std::sin(half) * weft;
  const Vector3d turned_weft = std::sin(half) * warp + std::cos(half) * weft;
  fabric.move([&](const Vector3d& x) { return Vector3d(x.dot(warp) * turned_warp + x.dot(weft) * turned_weft); });
}

// Power of the internal forces under a further trellis motion is F_sh * area * d(gamma): with F_sh(gamma) normalised
// per length and area (Eq. 13), W = area * integral F_sh dgamma for inextensible yarns. F_sh = t sigma cos(gamma) at
// constant volume, sigma of Table 3 integrated at gamma_L of Eq. 6 (times another cos(gamma) at constant thickness).
class TrellisAngle : public testing::TestWithParam<std::tuple<const char*, Formulation, double>> {};

INSTANTIATE_TEST_SUITE_P(All, TrellisAngle,
                         testing::Combine(testing::Values("twintex-pw", "twintex-tw"),
                                          testing::Values(Formulation::energy, Formulation::contravariant),
                                          testing::Values(0.0, 23.0, 45.0)));

TEST_P(TrellisAngle, ReturnsTheNormalisedShearForceAtEveryAngle) {
  const char* material = std::get<0>(GetParam());
  Formulation formulation = std::get<1>(GetParam());
  const double yarn_angle = std::get<2>(GetParam());
  for (const Thickness thickness : {Thickness::constant_volume, Thickness::constant}) {
    FabricPatch fabric(material, yarn_angle, {60.0, 90.0}, formulation, thickness);
    for (int degrees = -70; degrees <= 70; degrees += 5) {
      if (degrees == 0) continue;
      const double gamma = degrees * degree;
      // Eq. 6 as printed, not the closed form the code uses
      const double log_strain = -std::log(std::tan(std::numbers::pi / 4.0 - gamma / 2.0));
      double stress = shear_stress(fabric.card.shear, log_strain);
      if (thickness == Thickness::constant) stress *= std::cos(gamma);
      const double expected =
          fabric.card.thickness * stress * std::cos(gamma);  // N/mm, conjugate to gamma per flat area

      // velocity of the trellis motion at this angle: d(turned directions)/d(gamma)
      const auto [warp, weft] = fabric.yarn_directions();
      shear_trellis(fabric, gamma);
      const auto forces = fabric.forces();
      double power = 0.0;
      for (int n = 0; n < fabric.mesh.node_count(); ++n) {
        const auto& p = fabric.mesh.nodes.position[n];
        const Vector3d x(p[0], p[1], p[2]);
        const double c = 0.5 * std::cos(0.5 * gamma), s = -0.5 * std::sin(0.5 * gamma);
        const Vector3d velocity = x.dot(warp) * (s * warp + c * weft) + x.dot(weft) * (c * warp + s * weft);
        power -= forces[n].dot(velocity);
      }
      EXPECT_NEAR(power / (60.0 * 90.0), expected, 1e-9 * std::abs(expected))
          << name_of(thickness) << " at " << degrees << " deg";
    }
  }
}

// Rows, cut cells, any formulation: the patch sheared alike in one part and more in another.
TEST(SharpestCell, IsTheGreatestShearOfAll) {
  for (const Formulation formulation :
       {Formulation::energy, Formulation::contravariant, Formulation::incremental, Formulation::side_frame})
    for (const double border : {-25.0, 0.0, 1e3}) {  // mm; beyond, the greater angle: at the cut edge, half, nowhere
      FabricPatch fabric("twintex-pw", 30.0, {50.0, 70.0}, formulation);
      const auto [warp, weft] = fabric.yarn_directions();
      const auto start = fabric.state;
      fabric.move([&, warp = warp, weft = weft](const Vector3d& x) {
        const double sine = 0.3 + (x[0] < border ? 0.0 : 0.2);
        return Vector3d(x.dot(warp) * warp + x.dot(weft) * (sine * warp + std::sqrt(1.0 - sine * sine) * weft));
      });
      FabricForces forces(fabric.packed, fabric.card, fabric.laws, fabric.scene.model, start, alone());
      forces.compute(fabric.state);
      const Fields fields = compute_fields(fabric.mesh, fabric.card, fabric.scene.model, 0.0,
                                           mesh_positions(fabric.packed, fabric.state));
      const double sine = std::sin(fields.shear_angle[most_sheared_cell(fields)]);
      EXPECT_NEAR(forces.sharpest(), sine * sine, 1e-12) << name_of(formulation) << ", " << border;
    }
}

// Yarn ends, what fills up blocks beside real nodes, and velocities that change lengths.
TEST(YarnStrains, AreTheLeastAndGreatestOfAllYarnsNowAndAhead) {
  constexpr double ahead = 1e-3;  // s
  for (const double yarn_angle : {0.0, 30.0, 45.0}) {
    FabricPatch fabric("twintex-pw", yarn_angle, {50.0, 70.0});
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> draw(-20.0, 20.0);
    for (int n = 0; n < fabric.mesh.node_count(); ++n)
      for (int c = 0; c < 3; ++c) fabric.state.velocity[c][fabric.packed.packed_of_mesh[n]] = draw(generator);
    fabric.move([&](const Vector3d& x) { return Vector3d(1.01 * x[0], 0.995 * x[1], 0.02 * x[0]); });
    FabricForces forces(fabric.packed, fabric.card, fabric.laws, fabric.scene.model, fabric.state, alone());
    forces.set_look_ahead(ahead);
    forces.compute(fabric.state);
    std::array<StrainRange, 2> expected;
    for (int e = 0; e < fabric.mesh.yarn_count(); ++e) {
      if (fabric.mesh.yarns.softening[e] == 0.0) continue;
      const auto [a, b] = fabric.mesh.yarns.node[e];
      double square = 0.0, rate = 0.0;
      for (int c = 0; c < 3; ++c) {
        const auto& x = fabric.state.position[c];
        const auto& v = fabric.state.velocity[c];
        const int na = fabric.packed.packed_of_mesh[a], nb = fabric.packed.packed_of_mesh[b];
        square += (x[nb] - x[na]) * (x[nb] - x[na]);
        rate += (x[nb] - x[na]) * (v[nb] - v[na]);
      }
      const double jaw = fabric.mesh.yarns.jaw[e], rest = fabric.mesh.yarns.rest_length[e] + jaw;
      const double now = (std::sqrt(square) + jaw) / rest;
      const double squared_ahead =
          (square + 2.0 * ahead * rate) / (rest * rest);  // the lattice's; jaws: L + ahead dL/dt
      const bool in_row =
          fabric.packed.is_lattice_yarn(fabric.mesh.yarns.family[e] == Family::warp ? 0 : 1,
                                        fabric.packed.packed_of_mesh[a], fabric.packed.packed_of_mesh[b]);
      const double then = in_row ? std::sqrt(squared_ahead) : now + ahead * rate / std::sqrt(square) / rest;
      auto& range = expected[fabric.mesh.yarns.family[e] == Family::warp ? 0 : 1];
      for (const double stretch : {now, then}) {
        range.least = std::min(range.least, std::log(stretch));
        range.greatest = std::max(range.greatest, std::log(stretch));
      }
    }
    for (int f = 0; f < 2; ++f) {
      EXPECT_NEAR(forces.strains()[f].least, expected[f].least, 1e-14) << yarn_angle;
      EXPECT_NEAR(forces.strains()[f].greatest, expected[f].greatest, 1e-14) << yarn_angle;
    }
  }
}

TEST(HalfLog, AgreesWithTheLibraryToAnUlpOrTwo) {
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> draw(-20.0, 20.0), around(-0.5, 0.5);
  const auto expect_right = [](double a, double b) {
    const long double ratio = static_cast<long double>(a) / b;
    const long double exact =
        0.5L * (std::abs(ratio - 1.0L) < 0.5L ? std::log1p((static_cast<long double>(a) - b) / b) : std::log(ratio));
    const long double error = std::abs(half_log(a, b) - exact);
    EXPECT_LE(error, 4e-16L * std::abs(exact)) << a << " over " << b;
  };
  for (int n = 0; n < 100000; ++n) {
    const double b = std::exp(draw(generator));
    expect_right(std::exp(draw(generator)), b);
    expect_right(b * std::exp(around(generator)), b);
  }
  for (double apart = 1e-1; apart > 1e-17; apart /= 3.0) {
    expect_right(1.0 + apart, 1.0);
    expect_right(1.0 - apart, 1.0);
    expect_right(1.0 + apart, 1.0 - apart);
    expect_right(1.0, apart * apart);
  }
  EXPECT_EQ(half_log(7.0, 7.0), 0.0);
}

}  // namespace
}  // namespace weaveform
