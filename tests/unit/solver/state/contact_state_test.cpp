// What frames say of contact and thickness.
#include "solver/state/contact_state.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/result/result.hpp"
#include "tests/support/contact_scene.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/solver/lattice/trellis.hpp"

namespace weaveform {
namespace {

struct LastFrame {
  test::TemporaryFolder folder;
  Scene scene;
  Mesh mesh;
  SolveResult result;

  explicit LastFrame(Scene the_scene) : scene(std::move(the_scene)) {
    const Card card = load_card(scene.fabric.material);
    mesh = build_mesh(scene, card);
    scene.output.frames = 1;
    result = solve(mesh, scene, card, folder.path(), {.threads = 1, .resume = false, .quiet = true});
  }
  [[nodiscard]] std::vector<double> array(const std::string& name) const {
    return read_frame_array(folder.path() / "frames/frame_0001.vtu", name);
  }
};

// A strip pressed on a plate by another with 50 N.
Scene pressed() {
  Scene scene = test::contact_scene({60.0, 60.0}, 2.0);
  ToolSpec below = test::make_tool_spec("a_base", ToolShape::plane),
           above = test::make_tool_spec("b_press", ToolShape::plane);
  below.friction = above.friction = 0.3;
  above.axis = {0.0, 0.0, -1.0};
  above.force = 50.0;
  scene.tools = {below, above};
  scene.analysis.duration = 0.05;
  return scene;
}

TEST(ContactState, NodeForcesBetweenPlatesAddUpToThePressingForce) {
  const LastFrame frame(pressed());
  const auto force = frame.array("contact_force_N"), count = frame.array("contact_count"),
             tool = frame.array("contact_tool"), gap = frame.array("contact_gap_mm");
  double sum = 0.0;
  for (std::size_t n = 0; n < force.size(); ++n) {
    sum += force[n];
    if (force[n] == 0.0) continue;
    EXPECT_EQ(count[n], 2.0);
    EXPECT_GT(tool[n], 0.0);
    EXPECT_LT(gap[n], 0.0);
  }
  // The two faces of each node differ by what little is left of its vibration.
  EXPECT_NEAR(sum, 50.0, 0.5);
  for (const double share : frame.array("contact_share")) EXPECT_TRUE(share >= 0.0 && share <= 1.0);
  double weighted = 0.0;
  const auto pressure = frame.array("contact_pressure_MPa");
  for (int c = 0; c < frame.mesh.cells.size(); ++c)
    weighted += pressure[frame.mesh.yarn_count() + c] * frame.mesh.cells.area[c];
  EXPECT_NEAR(weighted, sum, 0.1 * sum) << "edge nodes touch with less than their area";
}

// On a plate below the friction angle a blank sticks, above it slides.
TEST(ContactState, TellsStickFromSlip) {
  for (const double slope : {10.0, 30.0}) {
    Scene scene = test::contact_scene({60.0, 60.0}, 4.0);
    ToolSpec plate = test::make_tool_spec("plate", ToolShape::plane);
    plate.friction = 0.3;  // 16.7 deg
    scene.tools = {plate};
    scene.analysis.duration = 0.05;
    const double angle = slope * 3.14159265358979 / 180.0;
    scene.analysis.gravity = {test::gravity * std::sin(angle), 0.0, -test::gravity * std::cos(angle)};
    const LastFrame frame(scene);
    int touching = 0;
    const auto state = frame.array("friction_state"), force = frame.array("contact_force_N");
    for (std::size_t n = 0; n < state.size(); ++n) {
      if (force[n] <= 0.0) {
        EXPECT_EQ(state[n], 0.0);
        continue;
      }
      ++touching;
      EXPECT_EQ(state[n], slope < 16.0 ? 1.0 : 2.0) << "node " << n << " at " << slope << " deg";
    }
    EXPECT_GT(touching, 4);
  }
}

TEST(ContactState, SceneWithoutToolsHasNoContactInItsFrames) {
  const test::TemporaryFolder folder;
  const Mesh mesh = test::lattice(3, 3, 5.0);
  FrameWriter writer(folder.path(), mesh);
  writer.write(compute_fields(mesh, test::small_card(), {}, 0.0, mesh.nodes.position));
  writer.settle();
  EXPECT_ANY_THROW((void)read_frame_array(folder.path() / "frames/frame_0000.vtu", "contact_tool"));
}

TEST(ContactState, WholeTakesThePartsNodesWithTheirFactors) {
  const ContactState part{{1, 2},     {1, 2},         {3.0, 5.0},
                          {0.1, 0.2}, {-0.01, -0.02}, {FrictionState::stick, FrictionState::slip}};
  const ContactState whole = unfolded(part, {1, 0, 1}, {1.0, 2.0, 1.0});
  EXPECT_EQ(whole.tool, (std::vector<int>{2, 1, 2}));
  EXPECT_EQ(whole.force, (std::vector<double>{5.0, 6.0, 5.0}));
  EXPECT_EQ(whole.pressure, (std::vector<double>{0.2, 0.1, 0.2}));
  EXPECT_EQ(whole.friction[1], FrictionState::stick);
}

// l1 l2 cos gamma of a stretched trellis, in closed form.
TEST(Thickness, FollowsTheAreaAtConstantVolumeAndStaysOtherwise) {
  const Mesh mesh = test::lattice(4, 4, 5.0);
  const double gamma = 0.7, stretch = 1.02;
  std::vector<Vec3> position = test::trellis(mesh, gamma);
  for (Vec3& x : position)
    for (double& c : x) c *= stretch;
  ModelSpec model;
  const double gain = 1.0 / (stretch * stretch * std::cos(gamma));
  for (const double t : compute_fields(mesh, test::small_card(), model, 0.0, position).thickness)
    EXPECT_NEAR(t, 0.5 * gain, 1e-14);
  model.thickness = Thickness::constant;
  const Fields fields = compute_fields(mesh, test::small_card(), model, 0.0, position);
  for (const double t : fields.thickness) EXPECT_EQ(t, 0.5);
  for (const double w : fields.areal_weight) EXPECT_NEAR(w, gain, 1e-13);
}

}  // namespace
}  // namespace weaveform
