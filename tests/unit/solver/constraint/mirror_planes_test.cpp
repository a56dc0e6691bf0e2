// A half or quarter in any symmetric shape feels the forces of the whole and has its stable step.
#include "solver/constraint/mirror_planes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesher/symmetry/cut_part.hpp"
#include "solver/bending/flexure.hpp"
#include "solver/bending/lattice_bending.hpp"
#include "solver/constraint/ties.hpp"
#include "solver/ply/critical_step.hpp"
#include "tests/support/contact_scene.hpp"
#include "tests/support/fabric_patch.hpp"

namespace weaveform {
namespace {

using Eigen::Vector3d;

struct Case {
  double yarn_angle;
  std::array<double, 2> phase;
  const char* formulation;
  const char* symmetry;
  bool bending = false;
  const char* yarn = "truss";
};

// Mirrored at x = 0 and y = 0: stretched, sheared out of shape and bent out of the plane.
Vec3 shaped(const Vec3& x) {
  const double a = x[0] / 60.0, b = x[1] / 80.0;
  return {x[0] * (1.01 + 0.05 * b * b), x[1] * (1.0 + 0.08 * a * a), 3.0 * a * a + 2.0 * b * b};
}

struct Moved {
  PackedMesh packed;
  std::unique_ptr<MirrorPlanes> mirrors;
  std::unique_ptr<Ties> ties;
  State state;
  std::unique_ptr<LatticeBending> bending;
  std::vector<double> bound;

  Moved(const Mesh& mesh, const Scene& scene, const Card& card) : packed(pack_mesh(mesh)) {
    ties = std::make_unique<Ties>(mesh, packed);
    if (!mesh.symmetry.plane.empty()) mirrors = std::make_unique<MirrorPlanes>(mesh, packed);
    state = initial_state(packed, mesh);
    FabricForces fabric(packed, card, yarn_laws(card, scene.model), scene.model, state, alone());
    for (int n = 0; n < mesh.node_count(); ++n) {
      const Vec3 x = shaped(mesh.nodes.position[n]);
      for (int c = 0; c < 3; ++c) state.position[c][packed.packed_of_mesh[n]] = x[c];
    }
    if (mirrors) mirrors->follow(state);
    ties->follow(state);
    if (mirrors) mirrors->follow(state);
    fabric.compute(state);
    const Flexure flexure = choose_flexure(card, scene.model);
    if (flexure.bends_yarns || flexure.rotation_free) {
      const std::vector<char> held(mesh.node_count(), 0);
      bending = std::make_unique<LatticeBending>(mesh, packed, flexure, held, state, alone());
      bending->add_forces(state, 0.0);
      bound.assign(mesh.node_count(), 0.0);
      bending->add_stiffness_bound(mesh_positions(packed, state), 0.0, bound);
    }
    if (mirrors) mirrors->give_forces(state);
    ties->give_forces(state);
    if (mirrors) mirrors->give_forces(state);
    if (mirrors) mirrors->hold(state);
  }
  [[nodiscard]] Vector3d force(int n) const {
    const int p = packed.packed_of_mesh[n];
    return {state.force[0][p], state.force[1][p], state.force[2][p]};
  }
  [[nodiscard]] double mass(int n) const { return packed.mass[packed.packed_of_mesh[n]]; }
};

TEST(MirrorPlanes, AccelerationsAndStepAreThoseOfTheWhole) {
  const std::vector<Case> cases = {{0.0, {0.0, 0.0}, "energy", "quarter"},
                                   {0.0, {0.5, 0.5}, "energy", "quarter"},
                                   {90.0, {0.5, 0.0}, "energy", "quarter"},
                                   {45.0, {0.0, 0.0}, "energy", "quarter"},
                                   {45.0, {0.5, 0.5}, "energy", "quarter"},
                                   {45.0, {0.0, 0.0}, "incremental", "half"},
                                   {0.0, {0.0, 0.0}, "side-frame", "quarter"},
                                   {0.0, {0.5, 0.0}, "contravariant", "half"},
                                   {0.0, {0.0, 0.0}, "energy", "quarter", true},
                                   {0.0, {0.5, 0.5}, "energy", "quarter", true},
                                   {45.0, {0.0, 0.0}, "energy", "quarter", true},
                                   {45.0, {0.5, 0.5}, "energy", "half", true},
                                   {0.0, {0.0, 0.5}, "energy", "quarter", false, "seatbelt"}};
  for (const auto& c : cases) {
    Scene scene = test::FabricPatch::make_scene("twintex-pw", c.yarn_angle, {60.0, 80.0}, c.formulation,
                                                "constant-volume", "incompressible");
    scene.blank.phase = c.phase;
    scene.model.symmetry = c.symmetry;
    scene.model.yarn = c.yarn;
    if (scene.model.yarn == "seatbelt") scene.model.partner = "compression";
    if (c.bending) {
      // stiff enough that bending makes a good part of the force
      scene.model.yarn = "beam";
      scene.model.yarn_bending = {{3e3, 2e3}};
      scene.model.cell = "rotation-free";
      scene.model.cell_bending = {{300.0, c.yarn_angle == 45.0 ? 300.0 : 400.0, 200.0}};
    }
    const Card card = load_card(scene.fabric.material);
    const Mesh whole = build_mesh(scene, card);
    const SymmetricPart part = cut_part(whole, find_symmetry(scene, card, whole, make_tools(scene, whole)), c.bending);
    const std::string name = std::to_string(c.yarn_angle) + " deg, phase " + std::to_string(c.phase[0]);
    const Moved all(whole, scene, card), some(part.mesh, scene, card);

    double greatest = 0.0;
    for (int n = 0; n < whole.node_count(); ++n) greatest = std::max(greatest, all.force(n).norm());
    std::vector<char> is_image(part.mesh.node_count(), 0);
    for (const auto& image : part.mesh.symmetry.image) is_image[image.node] = 1;
    for (int n = 0; n < part.mesh.node_count(); ++n) {
      if (is_image[n] != 0) {
        EXPECT_EQ(some.force(n).norm(), 0.0);
        EXPECT_EQ(some.mass(n), 0.0);
        continue;
      }
      const int w = part.mesh.symmetry.whole_node[n];
      if (all.mass(w) == 0.0) continue;  // tied
      const double share = some.mass(n) / all.mass(w);
      // 1, 1/2 in a plane, 1/4 in both
      EXPECT_NEAR(4.0 * share, std::round(4.0 * share), 1e-12) << name << ", node " << w;
      // rounding of sums in another order
      EXPECT_LT((some.force(n) - share * all.force(w)).norm(), 1e-11 * greatest) << name << ", node " << w;
    }

    const auto step = [&](const Mesh& mesh, const Moved& moved) {
      const CriticalStep critical(mesh, card, yarn_laws(card, scene.model), scene.model,
                                  std::vector<char>(mesh.node_count(), 0));
      return critical(mesh_positions(moved.packed, moved.state), critical.stiffest(every_strain), moved.bound).step;
    };
    if (c.bending) {
      const double energy = all.bending->stored_energy();
      EXPECT_GT(energy, 0.0);
      EXPECT_NEAR(part.mesh.symmetry.parts() * some.bending->stored_energy(), energy, 1e-12 * energy) << name;
    }
    const double of_whole = step(whole, all);
    EXPECT_NEAR(step(part.mesh, some), of_whole, 1e-10 * of_whole) << name;
  }
}

}  // namespace
}  // namespace weaveform
