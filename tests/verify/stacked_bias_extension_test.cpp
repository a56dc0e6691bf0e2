// A bias extension of two plies in the same grips, pressed on each other between plates without friction: each shears as
// it would alone, so that the stack takes twice the load of one, whatever the friction between them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "fabric/trellis/bias_rectangle.hpp"
#include "post/measure/zones.hpp"
#include "solver/result/fields.hpp"
#include "tests/support/contact_scene.hpp"
#include "tests/support/stack_world.hpp"

namespace weaveform {
namespace {

using namespace test;

constexpr double specimen_width = 60.0, pulled_by = 14.0, plate_force = 100.0;  // mm, mm, N

// One specimen for each yarn angle, bottom to top.
std::vector<Scene> stacked_specimens(const std::vector<double>& yarn_angle) {
  Scene scene = contact_scene({specimen_width, 2.0 * specimen_width}, 2.0);
  const double t = load_card(scene.fabric.material).thickness;
  ToolSpec lower = make_tool_spec("lower", ToolShape::plane), upper = make_tool_spec("upper", ToolShape::plane);
  lower.position = {0.0, 0.0, -0.5 * t};
  upper.position = {0.0, 0.0, (static_cast<double>(yarn_angle.size()) - 0.5) * t};
  upper.axis = {0.0, 0.0, -1.0};
  upper.force = plate_force;
  scene.tools = {lower, upper};
  for (const BlankEdge edge : {BlankEdge::bottom, BlankEdge::top}) {
    GripSpec grip;
    grip.name = edge == BlankEdge::top ? "top" : "bottom";
    grip.edge = edge;
    grip.travel = edge == BlankEdge::top ? pulled_by : 0.0;
    grip.free = {Component::z};  // the plates have them, and press as much at the grips as elsewhere
    scene.grip.push_back(grip);
  }
  scene.analysis.duration = 0.1;
  std::vector<Scene> scenes(yarn_angle.size(), scene);
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    scenes[k].blank.yarn_angle = yarn_angle[k];
    scenes[k].blank.position = {0.0, 0.0, static_cast<double>(k) * t};
  }
  return scenes;
}

struct PulledStack {
  double load = 0.0;               // N; of all plies, mean over the last tenth of the way
  std::vector<double> angle = {};  // deg; mean of zone A of each ply at the end, without its sign
  double slip = 0.0;               // mm; longest
  double pressed = 0.0;            // N; between the plies
};

PulledStack pull_stack(const std::vector<double>& yarn_angle, double friction) {
  const auto scenes = stacked_specimens(yarn_angle);
  PairLaw law;
  law.friction = friction;
  StackWorld world(scenes, law);
  world.run_to(0.9);
  PulledStack pulled;
  int steps = 0;
  world.run_to(1.0, [&] {
    for (std::size_t k = 0; k < scenes.size(); ++k) pulled.load += world->ply(k).holds().whole_forces()[1];
    ++steps;
  });
  pulled.load /= steps;
  const Card card = load_card(scenes[0].fabric.material);
  const BiasSpecimen specimen = *find_bias_extension(scenes[0]);
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    const Mesh& mesh = world.mesh(k);
    const Fields end = compute_fields(mesh, card, scenes[k].model, 1.0, world->ply(k).positions());
    const auto zones = angles_by_zone(mesh.cells, zones_of_cells(mesh, scenes[k].blank, specimen), end.shear_angle);
    pulled.angle.push_back(std::abs(zones[0].mean) * 180.0 / std::numbers::pi);
  }
  if (scenes.size() > 1) {
    pulled.slip = world->ply_contact()->pairs()[0].greatest_slip;
    pulled.pressed = world->ply_contact()->pairs()[0].force;
  }
  EXPECT_LT(world.energy_error(), 0.01);
  return pulled;
}

TEST(StackedBiasExtension, TwoPliesTakeTwiceTheLoadOfOneWhateverTheFrictionBetweenThem) {
  const PulledStack alone = pull_stack({45.0}, 0.0);
  const double ideal = bias_shear_angle({specimen_width, 2.0 * specimen_width}, pulled_by) * 180.0 / std::numbers::pi;
  EXPECT_LT(alone.angle[0], ideal);
  // Measured: loads within 1e-5 of twice the one's, angles within 0.0003 deg. The plates' 100 N would let friction take 30 N,
  // four times the load, if it had anything to do.
  for (const std::vector<double>& angles : {std::vector{45.0, 45.0}, {45.0, -45.0}})
    for (const double friction : {0.0, 0.3}) {
      const PulledStack both = pull_stack(angles, friction);
      const auto where = testing::Message() << angles[1] << " deg on 45, friction " << friction;
      EXPECT_NEAR(both.pressed, plate_force, 0.05 * plate_force) << where;
      EXPECT_NEAR(both.load / (2.0 * alone.load), 1.0, 1e-3) << where;
      for (const double angle : both.angle) EXPECT_NEAR(angle, alone.angle[0], 0.01) << where;
      // without friction nodes quiver, by 0.1 mm of way in all
      EXPECT_LT(both.slip, friction > 0.0 ? 1e-3 : 0.3) << where;
    }
}

}  // namespace
}  // namespace weaveform
