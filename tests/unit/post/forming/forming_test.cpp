// Meridians, outlines, the net on a sphere and the forces on shapes whose answers are known.
#include "post/forming/forming.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "mesher/drape/sphere_net.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/post/forming/forming_shapes.hpp"

namespace weaveform {
namespace {

using std::numbers::pi;
constexpr double radius = 75.0;  // mm

Scene bowl_scene() {
  Scene scene;
  scene.blank.size = {200.0, 200.0};
  scene.blank.yarn_angle = 0.0;
  scene.tools = {test::tool_spec("punch", ToolShape::sphere, 90.0)};
  return scene;
}

PartAxis upright() {
  return {};
}

// On the bowl, the flat distance from the pole is the arc.
struct Bowl {
  Mesh mesh = test::centred_lattice(33, 5.0);
  std::vector<Vec3> position = test::moved(mesh, [](const Vec3& x) { return test::on_bowl(x, radius); });
  FabricSurface surface = make_surface(mesh, position, std::vector<double>(mesh.cells.size(), 0.25));
};

TEST(Meridian, ArcHeightAndRadiusOnASphereAreExactAtNodes) {
  const Bowl bowl;
  for (const double azimuth : {0.0, 0.5 * pi}) {
    const auto points = meridian(bowl.surface, upright(), azimuth);
    ASSERT_EQ(points.size(), 17U) << "the row of nodes from the pole to the edge";
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double angle = 5.0 * static_cast<double>(k) / radius;
      EXPECT_NEAR(points[k].radius, radius * std::sin(angle), 1e-9);
      EXPECT_NEAR(points[k].height, -radius * std::cos(angle), 1e-9);
      // chords instead of arcs
      EXPECT_NEAR(points[k].arc, static_cast<double>(k) * 2.0 * radius * std::sin(2.5 / radius), 1e-9);
      EXPECT_NEAR(points[k].angle, 0.25, 1e-15);
    }
  }
}

TEST(Meridian, DiagonalFollowsTheDirectionAskedForAndEndsAtTheCorner) {
  const Bowl bowl;
  const auto points = meridian(bowl.surface, upright(), 0.25 * pi);
  ASSERT_GT(points.size(), 16U);
  for (const auto& p : points) EXPECT_NEAR(p.place.x(), p.place.y(), 1e-9);
  EXPECT_NEAR(points.front().radius, 0.0, 1e-9);
  EXPECT_NEAR(points.back().place.x(), bowl.position.back()[0], 1e-9);
}

TEST(Meridian, AngleLinearOverTheBlankComesBackExactlyInside) {
  const Mesh mesh = test::centred_lattice(21, 5.0);
  std::vector<double> angle;
  for (int c = 0; c < mesh.cells.size(); ++c)
    angle.push_back(0.01 * (5.0 * mesh.cells.lattice[c][0] + 2.5) + 0.02 * (5.0 * mesh.cells.lattice[c][1] + 2.5));
  const auto points = meridian(make_surface(mesh, mesh.nodes.position, angle), upright(), 30.0 * pi / 180.0);
  ASSERT_GT(points.size(), 10U);
  for (const auto& p : points) {
    if (p.radius > 44.0) continue;  // the nodes of the edge have cells on one side only
    EXPECT_NEAR(p.angle, 0.01 * (50.0 + p.place.x()) + 0.02 * (50.0 + p.place.y()), 1e-12);
    EXPECT_NEAR(p.arc, p.radius, 1e-9);
  }
}

TEST(Meridian, HalfPlaneWithoutFabricGivesNothing) {
  PartAxis aside;
  aside.origin = {500.0, 0.0, 0.0};
  EXPECT_TRUE(meridian(Bowl().surface, aside, 0.0).empty());
}

TEST(Outline, RunsOnceAroundTheBlank) {
  const Mesh mesh = test::centred_lattice(5, 10.0);
  const std::vector<int> nodes = outline_nodes(mesh);
  EXPECT_EQ(nodes.size(), 16U);
  for (const int n : nodes)
    EXPECT_EQ(std::max(std::abs(mesh.nodes.position[n][0]), std::abs(mesh.nodes.position[n][1])), 20.0);
}

TEST(Outline, HoleIsNotTheOutline) {
  Mesh mesh = test::centred_lattice(6, 10.0);
  MeshCells ring;
  for (int c = 0; c < mesh.cells.size(); ++c) {
    if (mesh.cells.lattice[c] == std::array{2, 2}) continue;
    ring.node.insert(ring.node.end(), mesh.cells.node.begin() + 4 * c, mesh.cells.node.begin() + 4 * c + 4);
    ring.offset.push_back(static_cast<int>(ring.node.size()));
    ring.area.push_back(100.0);
  }
  mesh.cells = ring;
  EXPECT_EQ(outline_nodes(mesh).size(), 20U);
}

// A square shrunk to 0.9 and 0.7 of its sides: r(azimuth) of either is in closed form.
TEST(DrawIn, OfAShrunkSquareIsExactInEveryDirection) {
  const Mesh mesh = test::centred_lattice(9, 10.0);
  const auto after = test::moved(mesh, [](const Vec3& x) { return Vec3{0.9 * x[0], 0.7 * x[1], -5.0}; });
  const DrawIn found = draw_in(outline_nodes(mesh), mesh.nodes.position, after, upright());
  ASSERT_EQ(found.row.size(), 360U);
  double sum = 0.0, greatest = 0.0;
  for (const auto& r : found.row) {
    const double c = std::abs(std::cos(r.azimuth)), s = std::abs(std::sin(r.azimuth));
    const double before = 40.0 / std::max(c, s), inside = 1.0 / std::max(c / 36.0, s / 28.0);
    EXPECT_NEAR(r.draw_in(), before - inside, 1e-9);
    sum += before - inside;
    greatest = std::max(greatest, before - inside);
  }
  EXPECT_NEAR(found.mean, sum / 360.0, 1e-9);
  EXPECT_NEAR(found.greatest, greatest, 1e-9);
  EXPECT_NEAR(found.at(0.0).value(), 4.0, 1e-9);
  EXPECT_NEAR(found.at(0.5 * pi).value(), 12.0, 1e-9);
}

TEST(PartAxis, IsThatOfTheToolThatTravels) {
  Scene scene = bowl_scene();
  scene.blank.position = {1.0, 2.0, 3.0};
  scene.tools.insert(scene.tools.begin(), test::tool_spec("base", ToolShape::plane, 0.0));
  scene.tools[1].position = {{10.0, -5.0, 60.0}};
  const PartAxis axis = part_axis(scene, make_tools(scene, 0.5));
  EXPECT_EQ(axis.tool, "punch");
  EXPECT_NEAR((axis.origin - Eigen::Vector3d(10.0, -5.0, 3.0)).norm(), 0.0, 1e-12);
}

TEST(PartAxis, OfALyingCylinderIsItsTravel) {
  Scene scene = bowl_scene();
  scene.tools[0].shape = ToolShape::cylinder;
  scene.tools[0].axis = {0.0, 1.0, 0.0};
  scene.tools[0].position = {{7.0, 0.0, 60.0}};
  const PartAxis axis = part_axis(scene, make_tools(scene, 0.5));
  EXPECT_NEAR((axis.up - Eigen::Vector3d::UnitZ()).norm(), 0.0, 1e-12);
  EXPECT_NEAR((axis.origin - Eigen::Vector3d(7.0, 0.0, 0.0)).norm(), 0.0, 1e-12);
}

TEST(PartAxis, WithoutATravellingToolIsTheBlanksCentre) {
  Scene scene = bowl_scene();
  scene.tools[0].travel = 0.0;
  scene.blank.position = {1.0, 2.0, 3.0};
  const PartAxis axis = part_axis(scene, make_tools(scene, 0.5));
  EXPECT_EQ(axis.tool, "");
  EXPECT_NEAR((axis.origin - Eigen::Vector3d(1.0, 2.0, 3.0)).norm(), 0.0, 1e-12);
}

// Angles put to g(s) plus a known error come back as that error.
TEST(NetOnSphere, FindsTheDifferenceFromTheNet) {
  Bowl bowl;
  const double off = 3.0 * pi / 180.0;
  Fields fields;
  fields.position = bowl.position;
  std::vector<double> s;
  for (int c = 0; c < bowl.mesh.cells.size(); ++c) {
    const double u = -77.5 + 5.0 * bowl.mesh.cells.lattice[c][0], v = -77.5 + 5.0 * bowl.mesh.cells.lattice[c][1];
    s.push_back(u * v / (radius * radius));
    const bool beyond = std::abs(s.back()) > 0.5;
    fields.shear_angle.push_back(sphere_net_angle(s.back()) + (beyond ? off : 0.0));
  }
  const auto fit = compare_with_sphere_net(bowl_scene(), bowl.mesh, fields, {test::sphere_tool(radius)});
  ASSERT_TRUE(fit.has_value());
  double inside = 0.0, square = 0.0;
  for (std::size_t c = 0; c < s.size(); ++c) {
    EXPECT_NEAR(fit->cell[c].s, s[c], 1e-12);
    if (!fit->cell[c].on_sphere || std::abs(s[c]) > sphere_net_end()) continue;
    inside += 1.0;
    square += std::abs(s[c]) > 0.5 ? off * off : 0.0;
  }
  EXPECT_GT(inside, 500.0);
  EXPECT_EQ(fit->cells, inside);
  EXPECT_NEAR(fit->rms, std::sqrt(square / inside), 1e-9);
  EXPECT_NEAR(fit->greatest, off, 1e-9);
  EXPECT_NEAR(fit->holds_to, 0.5, 1e-12);
}

TEST(NetOnSphere, LiftedCellsCountAsElsewhere) {
  const Bowl bowl;
  Fields fields;
  fields.shear_angle.assign(bowl.mesh.cells.size(), 0.1);
  fields.position = test::moved(bowl.mesh, [](const Vec3& x) { return test::on_bowl(x, radius + 0.2); });
  const auto fit = compare_with_sphere_net(bowl_scene(), bowl.mesh, fields, {test::sphere_tool(radius)});
  EXPECT_EQ(fit->cells, 0);
  EXPECT_TRUE(std::isnan(fit->rms));
}

TEST(NetOnSphere, SceneWithoutASphereHasNone) {
  Scene scene = bowl_scene();
  scene.tools[0].shape = ToolShape::plane;
  EXPECT_FALSE(compare_with_sphere_net(scene, Bowl().mesh, {}, {test::plane_tool(0.0)}).has_value());
}

// Punch down, die and binder: the die carries 3 % too much in one row, and anything in the row while forces set in.
TEST(ForceBalance, FindsTheRowThatDoesNotAddUp) {
  Scene scene = bowl_scene();
  scene.tools = {test::tool_spec("binder", ToolShape::plane, 0.0), test::tool_spec("die", ToolShape::plane, 0.0),
                 test::tool_spec("punch", ToolShape::sphere, 90.0)};
  scene.tools[0].axis = {0.0, 0.0, -1.0};
  History history{{"time_s", "binder.force_N", "die.force_N", "punch.force_N", "punch.displacement_mm"}, {}};
  for (int k = 0; k <= 100; ++k) {
    const double punch = 5.0 * k, die = 650.0 + punch;
    history.row.push_back({0.01 * k, 650.0, k == 40 ? 1.03 * die : k < 3 ? 0.1 * die : die, punch, 0.9 * k});
  }
  const auto balance = force_balance(scene, make_tools(scene, 0.5), history);
  ASSERT_TRUE(balance.has_value());
  EXPECT_DOUBLE_EQ(balance->at_time, 0.4);
  EXPECT_NEAR(balance->greatest, 0.03 * 850.0 / (0.5 * (850.0 + 1.03 * 850.0)), 1e-12);
  const auto curve = punch_curve(scene, history);
  EXPECT_EQ(curve->punch, "punch");
  EXPECT_EQ(curve->greatest, 500.0);
  EXPECT_EQ(curve->greatest_at, 90.0);
  scene.analysis.gravity = {0.0, 0.0, -9810.0};
  EXPECT_FALSE(force_balance(scene, make_tools(scene, 0.5), history).has_value());
}

// A whole evaluation and its files where there is neither sphere nor travel.
TEST(Forming, SceneOfARestingPlateGivesWhatThereIs) {
  const test::TemporaryFolder folder;
  Scene scene = bowl_scene();
  scene.tools = {test::tool_spec("plate", ToolShape::plane, 0.0)};
  const Mesh mesh = test::centred_lattice(9, 10.0);
  const Fields fields = compute_fields(mesh, test::small_card(), {}, 1.0, mesh.nodes.position);
  const History history{{"time_s", "plate.displacement_mm", "plate.force_N"}, {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}};
  std::ofstream(folder.path() / "sphere_net.csv") << "of an earlier run";
  const auto forming = evaluate_forming(scene, mesh, make_tools(scene, mesh), fields, history);
  ASSERT_TRUE(forming.has_value());
  write_forming(*forming, mesh, fields, folder.path());
  for (const char* name : {"meridians.csv", "meridians.svg", "outline.csv", "outline.vtp", "wrinkles.vtp"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / name)) << name;
  for (const char* name : {"sphere_net.csv", "sphere_net.svg", "punch_force.svg"})
    EXPECT_FALSE(std::filesystem::exists(folder.path() / name)) << name;
  const auto json = forming_json(*forming);
  EXPECT_TRUE(json["punch"].is_null());
  EXPECT_TRUE(json["sphere_net"].is_null());
  EXPECT_EQ(json["draw_in_mm"]["largest"], 0.0);
  EXPECT_EQ(forming_table(*forming).find("nan"), std::string::npos);
  scene.tools.clear();
  EXPECT_FALSE(evaluate_forming(scene, mesh, make_tools(scene, mesh), fields, history).has_value());
}

}  // namespace
}  // namespace weaveform
