// A drape handed to the solver: its shear energy is that of its angles, it stays where it is held or where nothing
// pulls, and formulations with a history start with the stress of their angle.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/fabric_patch.hpp"
#include "tests/support/scene_run.hpp"

namespace weaveform {
namespace {

using namespace weaveform::test;

Scene on_tool(const std::string& tool, const std::string& more) {
  return read_scene_text(
      "[blank]\nsize = [80, 80]\nyarn_angle = 0\ncoarsening = 2\n[drape]\ntool = \"t\"\n[tools.t]\n" + tool +
          "\n[analysis]\nduration = 0.01\n[output]\nframes = 0\nhistory = 20\n" + more,
      "s.toml");
}
const std::string sphere = "shape = \"sphere\"\nradius = 60\naxis = [0, 0, -1]\nposition = [0, 0, -60]";

// V * integral of sigma d(sin gamma), by Simpson's rule; the angle goes with the cube of the rule's variable, for the
// law rises steeply at the start.
double energy_of_angles(const Mesh& mesh, const Card& card, const std::vector<Vec3>& position) {
  const Fields fields = compute_fields(mesh, card, {}, 0.0, position);
  double sum = 0.0;
  for (int c = 0; c < mesh.cells.size(); ++c) {
    const double angle = std::abs(fields.shear_angle[c]);
    constexpr int intervals = 4000;
    double integral = 0.0;
    for (int n = 0; n <= intervals; ++n) {
      const double t = static_cast<double>(n) / intervals, g = angle * t * t * t;
      const double weight = n == 0 || n == intervals ? 1.0 : (n % 2 == 1 ? 4.0 : 2.0);
      integral += weight * shear_stress(card.shear, std::atanh(std::sin(g))) * std::cos(g) * 3.0 * t * t;
    }
    sum += mesh.cells.area[c] * mesh.thickness * integral * angle / (3.0 * intervals);
  }
  return sum;
}

TEST(DrapedStart, HeldOnTheToolItStaysPutWithTheShearEnergyOfItsAngles) {
  const Solved s(on_tool(sphere, "[[grip]]\nname = \"all\"\nbox = [-41, -41, 41, 41]\n"));
  const double expected = energy_of_angles(s.mesh, s.card, s.mesh.nodes.position);
  EXPECT_GT(expected, 0.1);  // mJ
  for (const double energy : s.result.history.values("internal_energy_mJ"))
    EXPECT_NEAR(energy, expected, 1e-12 * expected);
  for (int n = 0; n < s.mesh.node_count(); ++n)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(s.result.position[n][c], s.mesh.nodes.position[n][c], 1e-12);
  EXPECT_LT(s.result.statistics.max_yarn_strain, 1e-9);
  EXPECT_GT(s.result.statistics.max_shear_angle_deg, 15.0);
}

TEST(DrapedStart, FreeOnACylinderWithoutShearItStaysPut) {
  const Solved s(on_tool("shape = \"cylinder\"\nradius = 60\naxis = [1, 0, 0]\nposition = [0, 0, -60]", ""));
  double farthest = 0.0;
  for (int n = 0; n < s.mesh.node_count(); ++n)
    for (int c = 0; c < 3; ++c)
      farthest = std::max(farthest, std::abs(s.result.position[n][c] - s.mesh.nodes.position[n][c]));
  EXPECT_LT(farthest, 1e-9);
  EXPECT_LT(s.last("internal_energy_mJ"), 1e-9);
  double lowest = 0.0;  // it does hang over the cylinder
  for (const auto& x : s.mesh.nodes.position) lowest = std::min(lowest, x[2]);
  EXPECT_LT(lowest, -10.0);
}

// Shear has stiffness, so the same fabric left to itself on the sphere springs back: what "stays put" must not mean.
TEST(DrapedStart, FreeOnASphereItSpringsBackAndTheEnergyBalanceHolds) {
  const Solved s(on_tool(sphere, ""));
  const auto& energy = s.result.history.values("internal_energy_mJ");
  EXPECT_NEAR(energy.front(), energy_of_angles(s.mesh, s.card, s.mesh.nodes.position), 1e-12 * energy.front());
  EXPECT_LT(energy.back(), 0.9 * energy.front());
  EXPECT_LT(s.result.statistics.energy_error, 0.01);
}

class ShearedHistory : public testing::TestWithParam<std::tuple<Formulation, Thickness>> {};

// Started sheared, or sheared from flat in many small steps: the same forces and the same work.
TEST_P(ShearedHistory, StartsWithTheStressOfItsAngle) {
  const auto [formulation, thickness] = GetParam();
  FabricPatch walked("twintex-pw", 30.0, {60.0, 80.0}, formulation, thickness);
  const double full = 40.0 * std::numbers::pi / 180.0;
  const auto [d1, d2] = walked.yarn_directions();
  const Eigen::Matrix3d tilt = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 0.5).normalized()).toRotationMatrix();
  const auto trellis = [&, a = d1, b = d2](double angle) {
    return [=](const Eigen::Vector3d& x) -> Eigen::Vector3d {
      const Eigen::Vector3d e1 = std::cos(angle / 2) * a + std::sin(angle / 2) * b;
      const Eigen::Vector3d e2 = std::sin(angle / 2) * a + std::cos(angle / 2) * b;
      return tilt * (a.dot(x) * e1 + b.dot(x) * e2);
    };
  };
  walked.move(trellis(0.0));
  FabricForces from_flat(walked.packed, walked.card, walked.laws, walked.scene.model, walked.state, alone());
  constexpr int steps = 2000;
  for (int n = 1; n <= steps; ++n) {
    walked.move(trellis(full * n / steps));
    from_flat.compute(walked.state);
  }
  State there = walked.state;
  FabricForces sheared(walked.packed, walked.card, walked.laws, walked.scene.model, there, alone());
  const double start_work = sheared.cell_work();
  sheared.compute(there);
  double greatest = 0.0, off = 0.0;
  for (const int n : walked.packed.packed_of_mesh)
    for (int c = 0; c < 3; ++c) {
      greatest = std::max(greatest, std::abs(walked.state.force[c][n]));
      off = std::max(off, std::abs(walked.state.force[c][n] - there.force[c][n]));
    }
  EXPECT_GT(greatest, 0.1);         // N
  EXPECT_LT(off, 1e-4 * greatest);  // second order in the start's increment of a quarter of a degree
  EXPECT_NEAR(start_work, from_flat.cell_work(), 1e-4 * start_work);
  EXPECT_GT(start_work, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Formulations, ShearedHistory,
                         testing::Combine(testing::Values(Formulation::incremental, Formulation::side_frame),
                                          testing::Values(Thickness::constant_volume, Thickness::constant)));

}  // namespace
}  // namespace weaveform
