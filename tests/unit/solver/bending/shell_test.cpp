// Shell cells: directors on the lattice.
#include "solver/bending/shell.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "solver/bending/bending_energy.hpp"
#include "solver/bending/shell_energy.hpp"
#include "tests/support/fabric_patch.hpp"

namespace weaveform {
namespace {

using Eigen::Vector3d;
using test::FabricPatch;

// A constant stiffness, a curved one, one of 20 steps that fall, and one that is another in each sense.
enum class Moment { constant, curved, steps, sided };

BendingLaw moment_law(Moment moment) {
  const double infinity = std::numeric_limits<double>::infinity();
  if (moment == Moment::constant) return TangentLaw({{0.0, infinity, {8.0}}});
  if (moment == Moment::curved) return TangentLaw({{0.0, 0.05, {8.0, 60.0}}, {0.05, infinity, {2.0}}});
  if (moment == Moment::sided) return {moment_law(Moment::curved).face(), TangentLaw({{0.0, infinity, {14.0}}})};
  std::vector<TangentPiece> steps;
  for (int k = 0; k < 20; ++k) steps.push_back({0.01 * k, 0.01 * (k + 1), {12.0 - 0.5 * k, -2.0}});
  return TangentLaw(steps);
}

Flexure shell_flexure(Moment moment) {
  const BendingLaw law = moment_law(moment);
  Flexure flexure;
  flexure.shell = {law, law};
  flexure.twist = 0.9;
  flexure.transverse_shear = 1.3;
  flexure.has_shell = true;
  return flexure;
}

struct ShellPatch {
  FabricPatch patch;
  std::mt19937 generator{11};
  ShellPatch(double yarn_angle, double crumple) : patch("twintex-tw", yarn_angle, {40.0, 45.0}) {
    std::uniform_real_distribution<double> draw(-crumple, crumple);
    for (const int n : patch.packed.packed_of_mesh)
      for (int c = 0; c < 3; ++c) patch.state.position[c][n] += draw(generator);
  }
  [[nodiscard]] std::unique_ptr<Shell> shell(const Flexure& flexure, Team& team = alone(), double damping = 0.0) {
    return std::make_unique<Shell>(patch.mesh, patch.packed, patch.card, flexure,
                                   std::vector<char>(patch.mesh.node_count(), 0), patch.state,
                                   Shell::Setup{1e-6, damping, team});
  }
  std::vector<Vec3> crumpled_directors() {
    std::normal_distribution<double> draw(0.0, 0.25);
    std::vector<Vec3> result;
    for (int n = 0; n < patch.mesh.node_count(); ++n) {
      const Vector3d d = Vector3d(draw(generator), draw(generator), 1.0).normalized();
      result.push_back({d[0], d[1], d[2]});
    }
    return result;
  }
  std::vector<Vector3d> add_forces(Shell& shell) {
    for (auto& component : patch.state.force) std::fill(component.begin(), component.end(), 0.0);
    shell.add_forces(patch.state, 0.0);
    std::vector<Vector3d> result;
    for (const int n : patch.packed.packed_of_mesh)
      result.emplace_back(patch.state.force[0][n], patch.state.force[1][n], patch.state.force[2][n]);
    return result;
  }
};

class ShellOf : public testing::TestWithParam<std::tuple<double, Moment>> {};

// Central differences as in bending_test.cpp. Directors are moved as free vectors: the energy is a function of all
// three components, and the motion projects.
TEST_P(ShellOf, ForcesAreMinusTheGradientsOfTheStoredEnergy) {
  const auto [angle, law] = GetParam();
  ShellPatch p(angle, 0.3);
  const auto shell = p.shell(shell_flexure(law));
  auto directors = p.crumpled_directors();
  shell->set_directors(directors);
  const auto force = p.add_forces(*shell);
  const auto director_force = shell->director_forces();
  double greatest = 0.0, greatest_director = 0.0;
  for (std::size_t n = 0; n < force.size(); ++n) {
    greatest = std::max(greatest, force[n].norm());
    greatest_director = std::max(greatest_director, std::abs(director_force[n][2]));
  }
  ASSERT_GT(greatest, 0.1);
  ASSERT_GT(greatest_director, 0.1);
  constexpr double h = 1e-5;
  for (int n = 0; n < p.patch.mesh.node_count(); ++n)
    for (int c = 0; c < 3; ++c) {
      double& x = p.patch.state.position[c][p.patch.packed.packed_of_mesh[n]];
      const double x0 = x;
      x = x0 + h;
      double up = shell->stored_energy().total;
      x = x0 - h;
      double down = shell->stored_energy().total;
      x = x0;
      EXPECT_NEAR(force[n][c], -(up - down) / (2.0 * h), 2e-6 * greatest);
      auto moved = directors;
      moved[n][c] += h;
      shell->set_directors(moved);
      up = shell->stored_energy().total;
      moved[n][c] -= 2.0 * h;
      shell->set_directors(moved);
      down = shell->stored_energy().total;
      shell->set_directors(directors);
      EXPECT_NEAR(director_force[n][c], -(up - down) / (2.0 * h), 2e-6 * greatest_director);
    }
}

TEST_P(ShellOf, ForcesBalanceAndAnyNumberOfThreadsGivesTheSameBits) {
  const auto [angle, law] = GetParam();
  ShellPatch p(angle, 0.3);
  const auto directors = p.crumpled_directors();
  Team team(3);
  const auto one = p.shell(shell_flexure(law)), three = p.shell(shell_flexure(law), team);
  one->set_directors(directors);
  three->set_directors(directors);
  const auto force = p.add_forces(*one), again = p.add_forces(*three);
  const auto director_force = one->director_forces();
  EXPECT_EQ(director_force, three->director_forces());
  Vector3d sum = Vector3d::Zero(), moment = Vector3d::Zero();
  double size = 0.0;
  for (std::size_t n = 0; n < force.size(); ++n) {
    EXPECT_EQ(force[n], again[n]);
    const int at = p.patch.packed.packed_of_mesh[n];
    const auto& x = p.patch.state.position;
    sum += force[n];
    moment += Vector3d(x[0][at], x[1][at], x[2][at]).cross(force[n]);
    moment += Vector3d(directors[n].data()).cross(Vector3d(director_force[n].data()));
    size += force[n].norm();
  }
  EXPECT_LT(sum.norm(), 1e-13 * size);
  EXPECT_LT(moment.norm(), 1e-13 * size * 60.0);
}

// The directors of a flat trellis stay its normals; turned with it, they give nothing.
TEST_P(ShellOf, TrellisShearAndRigidMotionGiveNoForce) {
  const auto [angle, law] = GetParam();
  ShellPatch p(angle, 0.0);
  const auto shell = p.shell(shell_flexure(law));
  const auto [g1, g2] = p.patch.yarn_directions();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Vector3d to = std::sin(0.6) * g1 + std::cos(0.6) * g2, normal = turn * Vector3d::UnitZ();
  p.patch.move([&, g = std::array<Vector3d, 2>{g1, g2}](const Vector3d& x) {
    return Vector3d(turn * (x.dot(g[0]) * g[0] + x.dot(g[1]) * to));
  });
  shell->set_directors(std::vector<Vec3>(p.patch.mesh.node_count(), {normal[0], normal[1], normal[2]}));
  const auto force = p.add_forces(*shell);
  const auto director_force = shell->director_forces();
  for (std::size_t n = 0; n < force.size(); ++n) {
    EXPECT_LT(force[n].norm(), 1e-12);
    EXPECT_LT(Vector3d(director_force[n].data()).norm(), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(AnglesAndLaws, ShellOf,
                         testing::Combine(testing::Values(0.0, 30.0, 45.0),
                                          testing::Values(Moment::constant, Moment::curved, Moment::steps,
                                                          Moment::sided)));

// As in bending_test.cpp: directors, which are the fabric's normals, turn over as well.
TEST(Shell, AMirroredSheetWithSwappedHalvesHasMirroredForces) {
  ShellPatch p(30.0, 0.3);
  Flexure flexure = shell_flexure(Moment::sided);
  auto directors = p.crumpled_directors();
  const auto shell = p.shell(flexure);
  shell->set_directors(directors);
  const auto force = p.add_forces(*shell);
  const auto director_force = shell->director_forces();
  for (auto& law : flexure.shell) law = law.turned_over();
  for (double& z : p.patch.state.position[2]) z = -z;
  for (auto& d : directors) d = {-d[0], -d[1], d[2]};
  const auto mirror = p.shell(flexure);
  mirror->set_directors(directors);
  const auto mirrored = p.add_forces(*mirror);
  const auto mirrored_director = mirror->director_forces();
  double greatest = 0.0;
  for (std::size_t n = 0; n < force.size(); ++n) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(mirrored[n][c], c == 2 ? -force[n][c] : force[n][c]) << n;
      EXPECT_EQ(mirrored_director[n][c], c == 2 ? director_force[n][c] : -director_force[n][c]) << n;
    }
    greatest = std::max(greatest, force[n].norm());
  }
  EXPECT_GT(greatest, 0.1);
}

// Along a dome the side of the normal, which is up, is outwards.
TEST(Shell, TheSenseIsThatOfTheSideOutwards) {
  constexpr double radius = 50.0;
  const BendingLaw law = moment_law(Moment::sided);
  for (const double up : {1.0, -1.0}) {
    FabricPatch patch("twintex-pw", 0.0, {60.0, 60.0});
    std::vector<Vec3> position, director;
    for (const auto& x : patch.mesh.nodes.position) {
      const double turn = x[0] / radius;
      position.push_back({radius * std::sin(turn), x[1], up * radius * (1.0 - std::cos(turn))});
      director.push_back({-up * std::sin(turn), 0.0, std::cos(turn)});
    }
    const auto edges = find_shell_edges(patch.mesh, patch.card, 0.0);
    const auto energy = [&](const BendingLaw& of) {
      Flexure flexure;
      flexure.shell = {of, of};
      return shell_energy(edges, {}, flexure, patch.mesh.spacing, position, director);
    };
    EXPECT_DOUBLE_EQ(energy(law), energy(up > 0.0 ? law.back() : law.face()));
    EXPECT_GT(energy(law), 0.0);
  }
}

// Alternating directors are the mode that one point at a cell's centre does not see.
TEST(Shell, AlternatingDirectorsCostEnergyAndAreCountedAsHourglass) {
  ShellPatch p(0.0, 0.0);
  const auto shell = p.shell(shell_flexure(Moment::constant));
  std::vector<Vec3> directors;
  constexpr double tilt = 0.01;
  for (int n = 0; n < p.patch.mesh.node_count(); ++n) {
    const auto [i, j] = p.patch.mesh.nodes.crossing[n];
    directors.push_back({(i + j) % 2 == 0 ? tilt : -tilt, 0.0, std::sqrt(1.0 - tilt * tilt)});
  }
  shell->set_directors(directors);
  EXPECT_GT(shell->stored_energy().hourglass, 0.0);
  // every warp edge turns by 2 tilt: curvature 2 tilt/h over the area, and all of it alternates from row to row
  double area = 0.0;
  for (const auto& cell : find_twist_cells(p.patch.mesh)) area += cell.area;
  const double curvature = 2.0 * tilt / p.patch.mesh.spacing[0];
  EXPECT_NEAR(shell->stored_energy().hourglass,
              0.5 * 8.0 / p.patch.card.yarn[0].interval * curvature * curvature * area,
              1e-3 * shell->stored_energy().hourglass);  // tilt^2/3 of the series
}

// A free director with a speed turns uniformly along a great circle for ever.
TEST(Shell, AFreeDirectorTurnsUniformly) {
  ShellPatch p(0.0, 0.0);
  Flexure none = shell_flexure(Moment::constant);
  for (auto& law : none.shell) law = TangentLaw({{0.0, std::numeric_limits<double>::infinity(), {0.0}}});
  none.twist = none.transverse_shear = 0.0;
  const auto shell = p.shell(none);
  constexpr double rate = 3.0, step = 0.01;
  shell->set_director_velocities(std::vector<Vec3>(p.patch.mesh.node_count(), {rate, 0.0, 0.0}));
  for (int n = 0; n <= 1000; ++n) shell->add_forces(p.patch.state, step);
  int crossing = 0;
  while (p.patch.mesh.nodes.crossing[crossing][0] < 2 || p.patch.mesh.nodes.crossing[crossing][1] < 2) ++crossing;
  const Vec3 d = shell->directors()[crossing];
  // the polynomials of sine and cosine are exact to theta^10/10! = 1e-22 per step, rounding adds 1e-16
  EXPECT_NEAR(d[0], std::sin(30.0), 1e-12);
  EXPECT_NEAR(d[2], std::cos(30.0), 1e-12);
}

}  // namespace
}  // namespace weaveform
