// Friction in bending: forces that work against the curvatures, branches that are exponentials, loops of their width and
// loss, bits that neither threads nor a checkpoint changes.
#include "solver/bending/bend_friction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "core/error.hpp"
#include "solver/bending/bends.hpp"
#include "solver/bending/lattice_bending.hpp"
#include "solver/bending/shell.hpp"
#include "tests/support/fabric_patch.hpp"

namespace weaveform {
namespace {

using Eigen::Vector3d;
using test::FabricPatch;

constexpr double sharp = 1e-9;  // 1/mm; a rise so short that friction slides wherever anything moves

Team& one_thread() {
  static Team team(1);
  return team;
}

Flexure with_friction(double out, double in, double rise) {
  Flexure flexure;
  flexure.friction_out_of_plane = {BendingFriction{out, rise}, BendingFriction{1.5 * out, rise}};
  flexure.friction_in_plane = {BendingFriction{in, rise}, BendingFriction{0.5 * in, rise}};
  flexure.friction_shell = flexure.friction_out_of_plane;
  flexure.bends_yarns = true;
  return flexure;
}

std::vector<Vector3d> of_mesh(const FabricPatch& patch, const Components& field) {
  std::vector<Vector3d> result;
  for (const int n : patch.packed.packed_of_mesh) result.emplace_back(field[0][n], field[1][n], field[2][n]);
  return result;
}

template <class Bending>
std::vector<Vector3d> forces_of(FabricPatch& patch, Bending& bending) {
  for (auto& component : patch.state.force) std::fill(component.begin(), component.end(), 0.0);
  bending.add_forces(patch.state, 0.0);
  return of_mesh(patch, patch.state.force);
}

void crumple(FabricPatch& patch, double size, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> draw(-size, size);
  for (const int n : patch.packed.packed_of_mesh)
    for (int c = 0; c < 3; ++c) patch.state.position[c][n] += draw(generator);
}

// kappa_out, kappa_in of one family, from the formulas in bend_friction.hpp.
std::array<double, 2> signed_curvatures(const Bend& bend, int f, const std::vector<Vector3d>& x) {
  const auto span = [&](const YarnBend& yarn) {
    const Vector3d fixed(yarn.fixed[0], yarn.fixed[1], yarn.fixed[2]);
    return Vector3d(x[yarn.after] - x[yarn.before] + 2.0 * yarn.spread * fixed);
  };
  const YarnBend& yarn = bend.yarn[f];
  if (yarn.yarns == 0.0) return {0.0, 0.0};
  const Vector3d n = span(bend.yarn[0]).cross(span(bend.yarn[1])).normalized();
  const Vector3d fixed(yarn.fixed[0], yarn.fixed[1], yarn.fixed[2]);
  const Vector3d before = yarn.fixed_before ? fixed : Vector3d((x[bend.node] - x[yarn.before]).normalized());
  const Vector3d after = yarn.fixed_after ? fixed : Vector3d((x[yarn.after] - x[bend.node]).normalized());
  const Vector3d c = after - before;
  const double u = c.squaredNorm();
  const double scale = std::sqrt(1.0 + u / 12 + u * u / 90 + u * u * u / 560) / yarn.spread;
  return {scale * c.dot(n), scale * c.dot(n.cross((after + before).normalized()))};
}

TEST(BendFriction, ItsExponentialIsOne) {
  for (const double x : {1e-12, 1e-6, 0.01, 0.3, 1.0, 3.0, 10.0, 60.0, 500.0})
    EXPECT_NEAR(one_less_exp(x) / -std::expm1(-x), 1.0, 1e-5) << x;
}

class FrictionOf : public testing::TestWithParam<double> {};

// Sliding everywhere, friction is the gradient of sum M l |kappa|; central differences as in bending_test.cpp.
TEST_P(FrictionOf, ForceWorksAgainstTheCurvatures) {
  FabricPatch patch("twintex-tw", GetParam(), {40.0, 45.0});
  std::vector<char> held(patch.mesh.node_count(), 0);
  for (int n = 0; n < patch.mesh.node_count(); ++n) held[n] = patch.mesh.nodes.position[n][1] < -18.0 ? 1 : 0;
  const Flexure flexure = with_friction(5.0, 30.0, sharp);
  LatticeBending bending(patch.mesh, patch.packed, flexure, held, patch.state, one_thread());
  (void)forces_of(patch, bending);  // flat: from here on
  crumple(patch, 0.4, 7);
  const auto force = forces_of(patch, bending);
  const auto bends = find_bends(patch.mesh, held);
  auto x = of_mesh(patch, patch.state.position);
  const auto slid = [&] {
    double sum = 0.0;
    for (const auto& bend : bends)
      for (int f = 0; f < 2; ++f) {
        const auto [out, in] = signed_curvatures(bend, f, x);
        sum += bend.yarn[f].yarns * bend.yarn[f].spread *
               (flexure.friction_out_of_plane[f].moment * std::abs(out) +
                flexure.friction_in_plane[f].moment * std::abs(in));
      }
    return sum;
  };
  // one step from no friction to all of it: the trapezium, as the step's own work is
  EXPECT_NEAR(bending.energy_flow().lost, 0.5 * slid(), 1e-6 * slid());
  double greatest = 0.0;
  for (const auto& f : force) greatest = std::max(greatest, f.norm());
  ASSERT_GT(greatest, 0.1);
  constexpr double h = 1e-5;
  for (int n = 0; n < patch.mesh.node_count(); ++n) {
    if (held[n] != 0) continue;
    for (int c = 0; c < 3; ++c) {
      const double before = x[n][c];
      x[n][c] = before + h;
      const double up = slid();
      x[n][c] = before - h;
      const double down = slid();
      x[n][c] = before;
      EXPECT_NEAR(force[n][c], -(up - down) / (2.0 * h), 1e-5 * greatest) << "node " << n << " component " << c;
    }
  }
}

TEST_P(FrictionOf, ForcesBalanceAndAnyNumberOfThreadsGivesTheSameBits) {
  FabricPatch patch("twintex-tw", GetParam(), {40.0, 45.0}), again("twintex-tw", GetParam(), {40.0, 45.0});
  const std::vector<char> free(patch.mesh.node_count(), 0);
  const Flexure flexure = with_friction(5.0, 30.0, 0.01);
  Team three(3);
  LatticeBending one(patch.mesh, patch.packed, flexure, free, patch.state, one_thread());
  LatticeBending many(again.mesh, again.packed, flexure, free, again.state, three);
  std::vector<Vector3d> force;
  for (unsigned step = 0; step < 4; ++step) {
    force = forces_of(patch, one);
    ASSERT_EQ(force, forces_of(again, many));
    if (step == 3) break;
    crumple(patch, 0.2, step);
    crumple(again, 0.2, step);
  }
  EXPECT_EQ(one.energy_flow().lost, many.energy_flow().lost);
  EXPECT_GT(one.energy_flow().lost, 0.0);
  Vector3d sum = Vector3d::Zero(), moment = Vector3d::Zero();
  double size = 0.0;
  const auto x = of_mesh(patch, patch.state.position);
  for (std::size_t n = 0; n < force.size(); ++n) {
    sum += force[n];
    moment += x[n].cross(force[n]);
    size += force[n].norm();
  }
  EXPECT_LT(sum.norm(), 1e-13 * size);
  EXPECT_LT(moment.norm(), 1e-13 * size * 60.0);
}

// The state goes into a checkpoint: whoever reads it goes on with the same bits.
TEST_P(FrictionOf, AReadStateGoesOnWithTheSameBits) {
  FabricPatch patch("twintex-tw", GetParam(), {40.0, 45.0});
  const std::vector<char> free(patch.mesh.node_count(), 0);
  const Flexure flexure = with_friction(5.0, 30.0, 0.01);
  LatticeBending bending(patch.mesh, patch.packed, flexure, free, patch.state, one_thread());
  (void)forces_of(patch, bending);
  crumple(patch, 0.3, 1);
  (void)forces_of(patch, bending);
  const std::string kept = state_bytes(bending);
  LatticeBending read(patch.mesh, patch.packed, flexure, free, patch.state, one_thread());
  StateReader reader(kept);
  read.archive(reader);
  EXPECT_EQ(reader.left(), 0U);
  crumple(patch, 0.1, 2);
  EXPECT_EQ(forces_of(patch, bending), forces_of(patch, read));
  EXPECT_EQ(state_bytes(bending), state_bytes(read));
  EXPECT_EQ(bending.stored_energy().total, read.stored_energy().total);
}

INSTANTIATE_TEST_SUITE_P(Angles, FrictionOf, testing::Values(0.0, 30.0));

TEST(BendFriction, ImpulsesAreRefused) {
  FabricPatch patch("twintex-pw", 0.0, {40.0, 45.0});
  const std::vector<char> free(patch.mesh.node_count(), 0);
  EXPECT_THROW(
      LatticeBending(patch.mesh, patch.packed, with_friction(1.0, 1.0, 0.1), free, patch.state, one_thread(), 4),
      InputError);
}

TEST(BendFriction, WithoutFrictionThereIsNoState) {
  FabricPatch patch("twintex-pw", 0.0, {40.0, 45.0});
  const std::vector<char> free(patch.mesh.node_count(), 0);
  Flexure flexure = with_friction(0.0, 0.0, 1.0);
  LatticeBending bending(patch.mesh, patch.packed, flexure, free, patch.state, one_thread());
  EXPECT_EQ(state_bytes(bending), "");
}

// Of a sheet bent to a cylinder along the warp, what its friction does is the share phi of every bend's moment: asked of
// the work of its forces. `Bending` is the lattice's or the shell's.
struct Loop {
  FabricPatch patch{"twintex-pw", 0.0, {60.0, 40.0}};
  std::vector<char> free = std::vector<char>(patch.mesh.node_count(), 0);
  double moment = 4.0, rise = 2e-3, kappa_max = 0.012;  // N mm of a yarn, 1/mm
  Flexure flexure;
  std::unique_ptr<LatticeBending> lattice;
  std::unique_ptr<Shell> shell;
  double yarn_length = 0.0;  // mm; sum over the bends (edges) of yarns times length

  explicit Loop(bool of_shell) {
    BendingFriction friction{moment, rise};
    flexure.friction_out_of_plane = flexure.friction_shell = {friction, friction};
    flexure.bends_yarns = true;
    if (!of_shell) {
      lattice = std::make_unique<LatticeBending>(patch.mesh, patch.packed, flexure, free, patch.state, one_thread());
      for (const auto& bend : find_bends(patch.mesh, free)) yarn_length += bend.yarn[0].yarns * bend.yarn[0].spread;
    } else {
      flexure.shell = {TangentLaw({{0.0, 1.0, {1e-6}}}), TangentLaw({{0.0, 1.0, {1e-6}}})};
      flexure.transverse_shear = 1e-9;
      flexure.has_shell = true;
      shell = std::make_unique<Shell>(patch.mesh, patch.packed, patch.card, flexure, free, patch.state,
                                      Shell::Setup{1e-9, 0.0, one_thread()});
    }
  }
  // Chords of equal turns: the curvature of a bend is that of the circle they close into.
  void bend_to(double kappa) {
    const double h = patch.mesh.spacing[0], radius = 0.5 * h / std::sin(0.5 * h * std::abs(kappa) + 1e-300);
    std::vector<Vec3> director;
    patch.move([&](const Vector3d& x) {
      const double angle = x[0] * std::abs(kappa), sign = std::copysign(1.0, kappa);
      director.push_back({-std::sin(angle) * sign, 0.0, std::cos(angle)});
      if (std::abs(kappa) < 1e-12) return x;
      return Vector3d(radius * std::sin(angle), x[1], sign * radius * (1.0 - std::cos(angle)));
    });
    if (shell) shell->set_directors(director);
  }
  [[nodiscard]] double lost() const { return lattice ? lattice->energy_flow().lost : shell->energy_flow().lost; }
  [[nodiscard]] double stored() const {
    return lattice ? lattice->stored_energy().total : shell->stored_energy().total;
  }
  void step() {
    if (lattice) (void)forces_of(patch, *lattice);
    if (shell) (void)forces_of(patch, *shell);
  }
};

// The generalised force on the curvature, per bent length of yarn, is friction's moment: M (1 - 2 exp(-way/rise)) on the
// branch after a reversal, 2 M apart from the way there. (The patch's loose bends at its edges are as bent as the rows.)
TEST(BendFriction, BranchesAreExponentialsAndTheLoopIsTwiceTheMomentWide) {
  Loop loop(false);
  const auto moment_at = [&](double kappa) {
    constexpr double h = 1e-7;
    loop.bend_to(kappa + h);
    const auto up = of_mesh(loop.patch, loop.patch.state.position);
    loop.bend_to(kappa - h);
    const auto down = of_mesh(loop.patch, loop.patch.state.position);
    loop.bend_to(kappa);
    loop.step();
    const auto force = of_mesh(loop.patch, loop.patch.state.force);
    double power = 0.0;
    for (std::size_t n = 0; n < force.size(); ++n) power -= force[n].dot(up[n] - down[n]) / (2.0 * h);
    return power / loop.yarn_length;
  };
  loop.bend_to(0.0);
  loop.step();
  const int steps = 60;
  for (int i = 1; i <= steps; ++i) {
    const double kappa = loop.kappa_max * i / steps;
    EXPECT_NEAR(moment_at(kappa), loop.moment * (1.0 - std::exp(-kappa / loop.rise)), 2e-3 * loop.moment) << kappa;
  }
  double widest = 0.0;
  for (int i = 1; i <= 2 * steps; ++i) {
    const double way = loop.kappa_max * i / steps, there = loop.moment;
    const double now = moment_at(loop.kappa_max - way);
    const double start = 1.0 - std::exp(-loop.kappa_max / loop.rise);
    EXPECT_NEAR(now, loop.moment * (-1.0 + (1.0 + start) * std::exp(-way / loop.rise)), 2e-3 * loop.moment) << way;
    widest = std::max(widest, there - now);
  }
  EXPECT_NEAR(widest, 2.0 * loop.moment, 2e-3 * loop.moment);
}

// A closed loop loses 4 M (kappa_max - rise tanh(kappa_max/rise)) per bent length, which tends to 4 M kappa_max; what is
// stored comes back.
TEST(BendFriction, ACycleLosesFourTimesTheMomentTimesTheCurvature) {
  for (const bool of_shell : {false, true}) {
    Loop loop(of_shell);
    loop.bend_to(0.0);
    loop.step();
    const int steps = 400;
    const auto go = [&](double from, double to) {
      for (int i = 1; i <= steps; ++i) {
        loop.bend_to(from + (to - from) * i / steps);
        loop.step();
      }
    };
    go(0.0, loop.kappa_max);
    go(loop.kappa_max, -loop.kappa_max);
    go(-loop.kappa_max, loop.kappa_max);
    const double before = loop.lost(), stored = loop.stored();
    go(loop.kappa_max, -loop.kappa_max);
    go(-loop.kappa_max, loop.kappa_max);
    const double cycle = loop.lost() - before;
    if (of_shell)
      for (int e = 0; e < loop.patch.mesh.yarn_count(); ++e)
        loop.yarn_length += loop.patch.mesh.yarns.family[e] == Family::warp
                                ? loop.patch.mesh.yarns.yarns[e] * loop.patch.mesh.yarns.rest_length[e]
                                : 0.0;
    const double exact =
        4.0 * loop.moment * (loop.kappa_max - loop.rise * std::tanh(loop.kappa_max / loop.rise)) * loop.yarn_length;
    EXPECT_NEAR(cycle / exact, 1.0, 5e-3) << of_shell;
    EXPECT_NEAR(loop.stored(), stored, 1e-6 * cycle);
    EXPECT_GT(cycle / (4.0 * loop.moment * loop.kappa_max * loop.yarn_length), 0.8);
  }
}

// Shells: threads and checkpoints.
TEST(BendFriction, AShellsFrictionKeepsItsBitsOverThreadsAndCheckpoints) {
  FabricPatch patch("twintex-tw", 30.0, {40.0, 45.0});
  const std::vector<char> free(patch.mesh.node_count(), 0);
  Flexure flexure = with_friction(5.0, 0.0, 0.01);
  const TangentLaw law({{0.0, 1.0, {8.0}}});
  flexure.shell = {law, law};
  flexure.transverse_shear = 1.3;
  flexure.has_shell = true;
  Team three(3);
  const auto made = [&](Team& team) {
    return std::make_unique<Shell>(patch.mesh, patch.packed, patch.card, flexure, free, patch.state,
                                   Shell::Setup{1e-6, 0.0, team});
  };
  const auto one = made(one_thread()), many = made(three);
  (void)forces_of(patch, *one);
  (void)forces_of(patch, *many);
  std::mt19937 generator(5);
  std::normal_distribution<double> draw(0.0, 0.2);
  std::vector<Vec3> director;
  for (int n = 0; n < patch.mesh.node_count(); ++n) {
    const Vector3d d = Vector3d(draw(generator), draw(generator), 1.0).normalized();
    director.push_back({d[0], d[1], d[2]});
  }
  for (const auto& shell : {one.get(), many.get()}) shell->set_directors(director);
  crumple(patch, 0.3, 1);
  EXPECT_EQ(forces_of(patch, *one), forces_of(patch, *many));
  const auto read = made(one_thread());
  const std::string kept = state_bytes(*one);
  StateReader reader(kept);
  read->archive(reader);
  crumple(patch, 0.1, 2);
  EXPECT_EQ(forces_of(patch, *one), forces_of(patch, *read));
  EXPECT_EQ(one->energy_flow().lost, read->energy_flow().lost);
  EXPECT_GT(one->energy_flow().lost, 0.0);
}

}  // namespace
}  // namespace weaveform
