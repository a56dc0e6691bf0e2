// Sheared fabric is thicker: between rigid plates it carries the binder, and where one part is sheared more than the rest
// that part alone.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "solver/contact/contact.hpp"
#include "solver/contact/fabric_stiffness.hpp"
#include "tests/support/contact_scene.hpp"
#include "tests/support/stack_world.hpp"

namespace weaveform {
namespace {

using namespace test;

constexpr double degree = std::numbers::pi / 180.0;

double flat_thickness() {
  static const double t = load_card("twintex-pw").thickness;
  return t;
}

// Fabric between two plates, held in its plane as it starts and free across it; the upper plate is pushed down onto it.
std::vector<Scene> pressed_plies(std::size_t plies, double thickness, double force) {
  Scene scene = contact_scene({60.0, 60.0}, 1.0);
  scene.model.contact_thickness = ContactThickness::sheared;
  scene.model.cell = CellElement::rotation_free;  // sheared cells that are held would fold between the plates
  scene.model.cell_bending = {300.0, 300.0, 100.0};
  ToolSpec lower = make_tool_spec("lower", ToolShape::plane), upper = make_tool_spec("upper", ToolShape::plane);
  lower.position = {0.0, 0.0, -0.5 * thickness - 0.01};
  upper.position = {0.0, 0.0, (static_cast<double>(plies) - 0.5) * thickness + 0.01};
  upper.axis = {0.0, 0.0, -1.0};
  upper.force = force;
  upper.damping = 1e4;
  scene.tools = {lower, upper};
  GripSpec all;
  all.name = "plane";
  all.box = {-200.0, -200.0, 200.0, 200.0};
  all.free = {Component::z};
  scene.grip = {all};
  scene.analysis.duration = 0.05;
  scene.analysis.damping = 200.0;
  std::vector<Scene> scenes(plies, scene);
  for (std::size_t k = 0; k < plies; ++k) scenes[k].blank.position = {0.0, 0.0, static_cast<double>(k) * thickness};
  return scenes;
}

// A net of straight yarns that turn by `turn` beyond the middle, warp and weft alike: none stretches, and the quarters are
// sheared by 0, `turn`, `turn` and twice that.
Vec3 corner_sheared(const Vec3& x, double turn) {
  const double u = x[0], v = x[1], along = std::max(u, 0.0), across = std::max(v, 0.0);
  return {std::min(u, 0.0) + along * std::cos(turn) + across * std::sin(turn),
          std::min(v, 0.0) + across * std::cos(turn) + along * std::sin(turn), x[2]};
}

SmallWorld::Shape shaped_by(const std::function<Vec3(const Vec3&)>& map) {
  return [map](std::size_t, Mesh& mesh) {
    mesh.nodes.flat_position = mesh.nodes.position;
    for (auto& x : mesh.nodes.position) x = map(x);
  };
}

PairLaw smooth() {
  return {};
}

// mm; between the plates' faces.
double gap_of(const std::vector<Scene>& scenes, StackWorld& world) {
  const auto& readings = world->tools()->readings();
  return (*scenes[0].tools[1].position)[2] - readings[1].displacement - (*scenes[0].tools[0].position)[2];
}

// mm; how far springs of `stiffness` (N/mm) that set in over the depth d give way: N = k p^2/(2 d), k (p - d/2) beyond.
double given_way(double force, double stiffness, double d) {
  const double soft = std::sqrt(2.0 * d * force / stiffness);
  return soft < d ? soft : force / stiffness + 0.5 * d;
}

TEST(ShearedThickness, PliesBetweenPlatesCarryTheBinderAtThicknessOverCosine) {
  const double angle = 40.0 * degree, force = 20.0, t = flat_thickness(), softening = contact_softening * t;
  for (const std::size_t plies : {1U, 2U}) {
    const auto scenes = pressed_plies(plies, t / std::cos(angle), force);
    StackWorld world(scenes, smooth(), 1, shaped_by([&](const Vec3& x) -> Vec3 {
                       return {x[0] + x[1] * std::sin(angle), x[1] * std::cos(angle), x[2]};
                     }));
    world.run_to(1.0);
    const auto& readings = world->tools()->readings();
    EXPECT_NEAR(readings[1].force, force, 0.01 * force);
    EXPECT_NEAR(readings[0].force, force, 0.02 * force) << "force in is force out";
    EXPECT_NEAR(readings[1].area, 3600.0, 0.03 * 3600.0) << "everywhere";
    // the two plates' springs, omega^2 of all nodes, and those between plies, half as stiff as the step allows a plate's
    const double step = world->ply(0).fabric_step(), mass = world->ply(0).mass();
    const double frequency = contact_frequency(scenes[0].analysis, step), spring = frequency * frequency * mass;
    const double at_tool = tool_contact_frequency(scenes[0].analysis, load_card(scenes[0].fabric.material), step);
    const double sunk = 2.0 * given_way(force, at_tool * at_tool * mass, softening) +
                        static_cast<double>(plies - 1) * given_way(force, 0.5 * spring, softening);
    const double carried = static_cast<double>(plies) * t / std::cos(angle);
    EXPECT_NEAR(gap_of(scenes, world), carried - sunk, 0.05 * sunk + 1e-4) << plies;
    EXPECT_GT(gap_of(scenes, world), static_cast<double>(plies) * t * 1.2) << "well above what flat fabric has";
  }
}

TEST(ShearedThickness, WhereOneCornerIsShearedItAloneCarriesTheBinder) {
  const double turn = 20.0 * degree, force = 10.0, t = flat_thickness(), most = t / std::cos(2.0 * turn);
  for (const std::size_t plies : {1U, 2U}) {
    const auto scenes = pressed_plies(plies, most, force);
    StackWorld world(scenes, smooth(), 1, shaped_by([&](const Vec3& x) { return corner_sheared(x, turn); }));
    world.run_to(1.0);
    EXPECT_NEAR(world->tools()->readings()[1].force, force, 0.01 * force);
    // a quarter, without the nodes in the middle, which see both sides
    const double side = 30.0 - 0.5 * world.mesh(0).spacing[0];
    EXPECT_NEAR(world->tools()->readings()[1].area, side * side, 0.01 * side * side);
    EXPECT_NEAR(gap_of(scenes, world), static_cast<double>(plies) * most, 0.12 * t);
    const std::size_t top = plies - 1;
    const ContactState state = world->contact(top)->contact_state(world->ply(top).state());
    for (int n = 0; n < world.mesh(top).node_count(); ++n) {
      const auto& flat = world.mesh(top).nodes.flat_position[n];
      const bool inside = flat[0] > 6.0 && flat[1] > 6.0, outside = flat[0] < -1.0 || flat[1] < -1.0;
      if (inside) {
        EXPECT_GT(state.force[n], 0.0) << flat[0] << ", " << flat[1];
      }
      if (outside) {
        EXPECT_EQ(state.tool[n] == 2, false) << flat[0] << ", " << flat[1];
      }
    }
  }
}

// A bias extension between resting plates that leave hardly more room than the flat fabric: it swells against them, they
// press back on the shear, and the balance knows of it.
TEST(ShearedThickness, FabricShearedBetweenPlatesPressesThemAndTheBalanceCloses) {
  const double t = flat_thickness();
  Scene scene = contact_scene({60.0, 120.0}, 2.0);
  scene.blank.yarn_angle = 45.0;
  scene.model.contact_thickness = ContactThickness::sheared;
  ToolSpec lower = make_tool_spec("lower", ToolShape::plane), upper = make_tool_spec("upper", ToolShape::plane);
  upper.axis = {0.0, 0.0, -1.0};
  lower.friction = upper.friction = 0.1;
  scene.analysis.duration = 0.1;
  std::vector<double> pull;
  for (const std::size_t plies : {1U, 2U}) {
    const double top = static_cast<double>(plies - 1) * t;
    lower.position = {0.0, 0.0, -0.51 * t};
    upper.position = {0.0, 0.0, top + 0.51 * t};
    scene.tools = {lower, upper};
    scene.grip.clear();
    for (const BlankEdge edge : {BlankEdge::bottom, BlankEdge::top}) {
      GripSpec grip;
      grip.name = edge == BlankEdge::top ? "pull" : "held";
      grip.edge = edge;
      grip.travel = edge == BlankEdge::top ? 14.0 : 0.0;
      scene.grip.push_back(grip);
    }
    std::vector<Scene> scenes(plies, scene);
    for (std::size_t k = 0; k < plies; ++k) scenes[k].blank.position = {0.0, 0.0, static_cast<double>(k) * t};
    PairLaw law;
    law.friction = 0.2;
    StackWorld world(scenes, law);
    world.run_to(1.0);
    const auto& readings = world->tools()->readings();
    EXPECT_GT(std::abs(readings[0].force), 20.0);
    EXPECT_NEAR(readings[0].force, readings[1].force, 0.01 * std::abs(readings[0].force));
    world->look_at_stored_energy();
    EXPECT_LT(world.energy_error(), 0.005) << plies;
    EXPECT_LT(world->balance().error(), 0.005) << plies;
  }
}

}  // namespace
}  // namespace weaveform
