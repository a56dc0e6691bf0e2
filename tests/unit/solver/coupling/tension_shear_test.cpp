// The coupling of tension and shear: forces are the derivatives of its energy, rigid motion gives none, and an evenly
// sheared patch has the closed form's stress and tension.
#include "solver/coupling/tension_shear.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.hpp"
#include "core/vector/angle.hpp"
#include "fabric/trellis/tension_shear.hpp"
#include "tests/support/fabric_patch.hpp"

namespace weaveform {
namespace {

using Eigen::Vector3d;
using test::FabricPatch;

// Another fabric than the built-in ones: unequal yarns and intervals, a start of the shear law.
Card coupled_card() {
  return read_card_text(R"(
name = "coupled"
thickness = 0.8
[yarn]
linear_density = 1200
crimp = 1
[yarn.warp]
section = 0.9
interval = 4.4
tension = [{ from = 0.0, to = 0.013, coefficients = [200, 0, 0, 8.0e9] }, { from = 0.013, coefficients = [18000] }]
[yarn.weft]
section = 0.6
interval = 6.1
tension = [{ from = 0.0, coefficients = [9000] }]
[shear]
tangent = [{ from = 0.0, coefficients = [0.1, -0.1, 0.4] }]
start = { plateau = 0.03, rise = 0.05 }
tension_coupling = 0.2
)",
                        "coupled");
}

// A patch of it with rows, cut cells and yarn ends.
struct CoupledPatch : FabricPatch {
  explicit CoupledPatch(double yarn_angle = 30.0) : FabricPatch("twintex-pw", yarn_angle) {
    card = coupled_card();
    mesh = build_mesh(scene, card);
    packed = pack_mesh(mesh);
    state = initial_state(packed, mesh);
    laws = yarn_laws(card, scene.model);
  }
  // At the present positions; forces on the mesh's nodes (N) and energy (mJ) of the coupling alone.
  struct Answer {
    std::vector<Vector3d> force;
    double energy = 0.0;
  };
  Answer answer(TensionShear& coupling) {
    for (auto& component : state.force) std::fill(component.begin(), component.end(), 0.0);
    coupling.add_forces(state, 0.0);
    Answer answer;
    for (const int n : packed.packed_of_mesh)
      answer.force.emplace_back(state.force[0][n], state.force[1][n], state.force[2][n]);
    answer.energy = coupling.stored_energy().total;
    return answer;
  }
  // Stretched, sheared, curved, and every node somewhere else by up to 0.05 mm.
  void deform(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> away(-0.05, 0.05);
    move([&](const Vector3d& x) {
      const Vector3d even(1.01 * x[0] + 0.4 * x[1], 1.02 * x[1] - 0.1 * x[0], 0.002 * x[0] * x[1]);
      return Vector3d(even + Vector3d(away(random), away(random), away(random)));
    });
  }
};

TEST(TensionShear, ForcesAreTheDerivativesOfTheEnergy) {
  for (const double yarn_angle : {0.0, 30.0, 45.0}) {
    CoupledPatch patch(yarn_angle);
    TensionShear coupling(patch.mesh, patch.packed, patch.card, patch.laws);
    patch.deform(1);
    const auto forces = patch.answer(coupling).force;
    double greatest = 0.0;
    for (const auto& force : forces) greatest = std::max(greatest, force.norm());
    ASSERT_GT(greatest, 0.01);
    constexpr double step =
        1e-5;  // mm; central differences err by step^2 of the third derivative, and by rounding/step
    for (int n = 0; n < patch.mesh.node_count(); n += 3) {
      for (int k = 0; k < 3; ++k) {
        double& x = patch.state.position[k][patch.packed.packed_of_mesh[n]];
        const double at = x;
        x = at + step;
        const double above = patch.answer(coupling).energy;
        x = at - step;
        const double below = patch.answer(coupling).energy;
        x = at;
        EXPECT_NEAR(forces[n][k], -(above - below) / (2.0 * step), 2e-6 * greatest) << "node " << n;
      }
    }
  }
}

TEST(TensionShear, RigidMotionGivesNoForceAndTurnsThoseThereAre) {
  CoupledPatch patch;
  TensionShear coupling(patch.mesh, patch.packed, patch.card, patch.laws);
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(0.7, Vector3d::UnitX()) * Eigen::AngleAxisd(-1.1, Vector3d::UnitZ())).toRotationMatrix();
  patch.move([&](const Vector3d& x) { return Vector3d(turn * x + Vector3d(3.0, -7.0, 1.0)); });
  for (const auto& force : patch.answer(coupling).force) EXPECT_LT(force.norm(), 1e-9);

  patch.deform(2);
  const auto before = patch.answer(coupling);
  const auto positions = mesh_positions(patch.packed, patch.state);
  Vector3d sum = Vector3d::Zero(), moment = Vector3d::Zero();
  double greatest = 0.0;
  for (std::size_t n = 0; n < before.force.size(); ++n) {
    sum += before.force[n];
    moment += Vector3d(positions[n][0], positions[n][1], positions[n][2]).cross(before.force[n]);
    greatest = std::max(greatest, before.force[n].norm());
    const Vector3d to = turn * Vector3d(positions[n][0], positions[n][1], positions[n][2]);
    for (int k = 0; k < 3; ++k) patch.state.position[k][patch.packed.packed_of_mesh[n]] = to[k];
  }
  EXPECT_LT(sum.norm(), 1e-10 * greatest);
  EXPECT_LT(moment.norm(), 1e-8 * greatest);
  const auto after = patch.answer(coupling);
  EXPECT_NEAR(after.energy, before.energy, 1e-10 * before.energy);
  for (std::size_t n = 0; n < before.force.size(); ++n)
    EXPECT_LT((after.force[n] - turn * before.force[n]).norm(), 1e-8 * greatest);
}

TEST(TensionShear, SlackOrPressedYarnsCoupleNothing) {
  CoupledPatch patch;
  TensionShear coupling(patch.mesh, patch.packed, patch.card, patch.laws);
  patch.move([&](const Vector3d& x) { return Vector3d(0.9 * x[0] + 0.2 * x[1], 0.8 * x[1], 0.0); });
  for (const auto& force : patch.answer(coupling).force) EXPECT_EQ(force.norm(), 0.0);
}

// Yarns along x and y of a patch, warp turned by `angle` towards the weft, at even strains: the work of shearing it by a
// little more is that of the closed form's stress. The patch's outline has cells without all four yarns, so that a
// patch and a smaller one are compared: the difference is inside.
TEST(TensionShear, EvenShearUnderTensionHasTheClosedFormsStress) {
  const Card card = coupled_card();
  const std::array<double, 2> strain = {0.009, 0.004};
  // mJ; of the coupling and of the net, at a shear angle
  const auto energy_at = [&](const std::array<double, 2>& size, double angle) {
    CoupledPatch patch(0.0);
    patch.scene.blank.size = size;
    patch.scene.blank.fit = LineFit::none;
    patch.mesh = build_mesh(patch.scene, patch.card);
    patch.packed = pack_mesh(patch.mesh);
    patch.state = initial_state(patch.packed, patch.mesh);
    TensionShear coupling(patch.mesh, patch.packed, patch.card, patch.laws);
    patch.move([&](const Vector3d& x) {
      return Vector3d(x[0] * std::exp(strain[0]) + x[1] * std::exp(strain[1]) * std::sin(angle),
                      x[1] * std::exp(strain[1]) * std::cos(angle), 0.0);
    });
    return patch.answer(coupling).energy + patch.energy();
  };
  // three intervals of either more each way
  const std::array<double, 2> small = {6 * 6.1, 6 * 4.4}, large = {12 * 6.1, 12 * 4.4};
  const std::array<double, 2> mixed = {12 * 6.1, 6 * 4.4}, other = {6 * 6.1, 12 * 4.4};
  const double area = 36 * 6.1 * 4.4;
  for (const double degrees : {10.0, 35.0, 52.0}) {
    constexpr double step = 1e-4;  // rad
    const auto slope = [&](const std::array<double, 2>& size) {
      return (energy_at(size, degrees * degree + step) - energy_at(size, degrees * degree - step)) / (2.0 * step);
    };
    // edges and corners cancel
    const double inside = (slope(large) - slope(mixed) - slope(other) + slope(small)) / area;
    const double closed =
        card.thickness * shear_at_strain(card, degrees * degree, strain).stress * std::cos(degrees * degree);
    EXPECT_NEAR(inside, closed, 1e-5 * closed) << degrees << " deg";
    const double uncoupled =
        card.thickness * shear_stress(card.shear, log_shear_strain(degrees * degree)) * std::cos(degrees * degree);
    EXPECT_GT(closed, 1.5 * uncoupled);
  }
}

// Each is the other's reaction: d stress/d strain at a shear is d tension/d (t sin gamma) at a strain.
TEST(TensionShear, TheClosedFormIsReciprocal) {
  const Card card = coupled_card();
  const std::array<double, 2> strain = {0.009, 0.004};
  constexpr double step = 1e-6;
  for (const double angle : {0.2, 0.6, 1.0}) {
    for (std::size_t f = 0; f < 2; ++f) {
      auto more = strain, less = strain;
      more[f] += step;
      less[f] -= step;
      const double stress = (shear_at_strain(card, angle, more).stress - shear_at_strain(card, angle, less).stress) /
                            (2.0 * step) * card.thickness;
      const double tension = (shear_at_strain(card, std::asin(std::sin(angle) + step), strain).tension[f] -
                              shear_at_strain(card, std::asin(std::sin(angle) - step), strain).tension[f]) /
                             (2.0 * step);
      EXPECT_NEAR(stress, tension, 1e-5 * std::abs(tension) + 1e-9);
    }
  }
}

TEST(TensionShear, WhatHasNoSuchEnergyIsRefusedInWords) {
  const Card card = coupled_card();
  ModelSpec model;
  EXPECT_NO_THROW(require_coupling(card, model));
  const auto complaint = [&](const ModelSpec& wrong) -> std::string {
    try {
      require_coupling(card, wrong);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  for (const Formulation formulation :
       {Formulation::contravariant, Formulation::incremental, Formulation::side_frame}) {
    ModelSpec wrong;
    wrong.formulation = formulation;
    EXPECT_NE(complaint(wrong).find("formulation"), std::string::npos);
    EXPECT_NO_THROW(require_coupling(load_card("twintex-pw"), wrong));
  }
  ModelSpec thick, constant;
  thick.thickness = Thickness::constant;
  constant.section = Section::constant;
  EXPECT_NE(complaint(thick).find("thickness"), std::string::npos);
  EXPECT_NE(complaint(constant).find("section"), std::string::npos);
}

}  // namespace
}  // namespace weaveform
