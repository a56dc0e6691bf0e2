// Fibre directions of a formed fabric, and what is left of them on another mesh. The exact field: a flat blank laid on
// a sphere with its distances from the middle kept (azimuthal equidistant map), whose derivatives are closed forms.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>
#include <string>

#include "core/error.hpp"
#include "core/vector/angle.hpp"
#include "mesher/lattice/build.hpp"
#include "mesher/scene/reader.hpp"
#include "post/transfer/fibre_field.hpp"
#include "post/transfer/write_fibre.hpp"

namespace weaveform {
namespace {

using Eigen::Vector3d;
constexpr double sphere_radius = 200.0;  // mm; the blank's corners reach 81 deg from the top

Vector3d on_sphere(double u, double v) {
  const double rho = std::hypot(u, v), a = rho / sphere_radius;
  const double s = rho > 0.0 ? sphere_radius * std::sin(a) / rho : 1.0;
  return {s * u, s * v, sphere_radius * std::cos(a)};
}

// dX/du and dX/dv: radially cos a, around the pole sin(a)/a.
std::array<Vector3d, 2> derivatives(double u, double v) {
  const double rho = std::hypot(u, v), a = rho / sphere_radius;
  if (rho < 1e-12) return {Vector3d::UnitX(), Vector3d::UnitY()};
  const double c = u / rho, s = v / rho, around = std::sin(a) / a;
  const Vector3d out(std::cos(a) * c, std::cos(a) * s, -std::sin(a)), side(-s, c, 0.0);
  return {c * out - around * s * side, s * out + around * c * side};
}

// The blank's place under a point of the sphere.
std::array<double, 2> place_under(const Vector3d& x) {
  const double a = std::atan2(std::hypot(x.x(), x.y()), x.z()), r = std::hypot(x.x(), x.y());
  return r > 0.0 ? std::array{sphere_radius * a * x.x() / r, sphere_radius * a * x.y() / r} : std::array{0.0, 0.0};
}

struct Draped {
  Scene scene;
  Mesh mesh;
  FibreField field;
};

Draped draped(double coarsening) {
  Draped result;
  result.scene = read_scene(std::string(WEAVEFORM_SOURCE_DIR) + "/examples/hemisphere_pw.toml",
                            {"blank.coarsening=" + std::to_string(coarsening)});
  result.mesh = build_mesh(result.scene, load_card(result.scene.fabric.material, result.scene.file));
  std::vector<Vec3> position;
  for (const auto& x : result.mesh.nodes.position) {
    const Vector3d p = on_sphere(x[0], x[1]);
    position.push_back({p.x(), p.y(), p.z()});
  }
  result.field = fibre_field(result.mesh, result.scene, position);
  return result;
}

// Quadrilaterals of 60 mm turned by 30 deg against the yarns: coarser than the fabric at coarsening 8 (39 mm).
ForeignMesh structure() {
  constexpr int side = 4;
  constexpr double h = 60.0, turn = std::numbers::pi / 6.0;
  ForeignMesh mesh;
  mesh.file = "structure";
  for (int j = 0; j <= side; ++j)
    for (int i = 0; i <= side; ++i) {
      const double p = h * (i - 0.5 * side), q = h * (j - 0.5 * side);
      const Vector3d x = on_sphere(std::cos(turn) * p - std::sin(turn) * q, std::sin(turn) * p + std::cos(turn) * q);
      mesh.position.push_back({x.x(), x.y(), x.z()});
      mesh.number.push_back(static_cast<long>(mesh.position.size()));
    }
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const int n = j * (side + 1) + i;
      mesh.shells.push_back({100 + static_cast<long>(mesh.shells.size()), 0, {n, n + 1, n + side + 2, n + side + 1}});
    }
  return mesh;
}

// Greatest angle (deg) between mapped and exact directions, both in the plane of the element.
double greatest_error(const FibreField& mapped) {
  double worst = 0.0;
  for (const auto& element : mapped.element) {
    const Vector3d centre(element.centre[0], element.centre[1], element.centre[2]);
    const auto [u, v] = place_under(centre);
    const auto exact = derivatives(u, v);
    const Vec3 warp = {exact[0].x(), exact[0].y(), exact[0].z()}, weft = {exact[1].x(), exact[1].y(), exact[1].z()};
    worst =
        std::max(worst, std::abs(angle_in_plane(mapped, element, warp, element.state.warp).angle) * degrees_per_radian);
    worst =
        std::max(worst, std::abs(angle_in_plane(mapped, element, weft, element.state.weft).angle) * degrees_per_radian);
  }
  return worst;
}

TEST(FibreField, OfTheFlatFabricIsItsYarns) {
  const Scene scene = read_scene(std::string(WEAVEFORM_SOURCE_DIR) + "/examples/bias_extension_pw.toml",
                                 {"blank.coarsening=4", "blank.fit=none"});
  const Mesh mesh = build_mesh(scene, load_card(scene.fabric.material, scene.file));
  for (const auto& element : fibre_field(mesh, scene, mesh.nodes.position).element) {
    EXPECT_NEAR(element.state.warp[0], std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(element.state.weft[0], -std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(element.state.shear_angle, 0.0, 1e-12);
    EXPECT_NEAR(element.state.thickness, mesh.thickness, 1e-12);
    EXPECT_NEAR(element.state.fibre_volume_ratio, 1.0, 1e-12);
  }
}

// Simple shear by gamma with yarns of kept length: J = cos gamma, so t = t0 / cos gamma with the volume kept, and
// 1 / cos gamma more fibre in the volume with the thickness kept.
TEST(FibreField, ThickensAsItShears) {
  for (const std::string thickness : {"constant-volume", "constant"}) {
    const Scene scene = read_scene(std::string(WEAVEFORM_SOURCE_DIR) + "/examples/hemisphere_pw.toml",
                                   {"blank.coarsening=8", "model.thickness=" + thickness});
    const Mesh mesh = build_mesh(scene, load_card(scene.fabric.material, scene.file));
    const double gamma = 0.6;
    std::vector<Vec3> position;
    for (const auto& x : mesh.nodes.position)
      position.push_back({x[0] + std::sin(gamma) * x[1], std::cos(gamma) * x[1], x[2]});
    for (const auto& element : fibre_field(mesh, scene, position).element) {
      const double more = 1.0 / std::cos(gamma);
      EXPECT_NEAR(element.state.shear_angle, gamma, 1e-12);
      EXPECT_NEAR(element.state.fibre_mass_ratio, more, 1e-12);
      EXPECT_NEAR(element.state.thickness, mesh.thickness * (thickness == "constant" ? 1.0 : more), 1e-12);
      EXPECT_NEAR(element.state.fibre_volume_ratio, thickness == "constant" ? more : 1.0, 1e-12);
    }
  }
}

// Halving the fabric's spacing at least halves the angle error until what a flat shell of 60 mm can say of a sphere is
// left. docs/export.md states these numbers.
TEST(MapOnto, AngleErrorFallsWithTheFabricsSpacing) {
  const ForeignMesh mesh = structure();
  const double coarse = greatest_error(map_onto(draped(8).field, mesh));
  const double fine = greatest_error(map_onto(draped(4).field, mesh));
  RecordProperty("angle_error_deg", std::to_string(coarse) + " " + std::to_string(fine));
  EXPECT_LT(coarse, 0.1);  // measured 0.049 deg
  EXPECT_LT(fine, 0.5 * coarse);
}

// A chord of 60 mm stands (60 sqrt 2 / 2)^2 / (2 R) = 4.5 mm off the sphere at most, less what the fabric's own does.
TEST(MapOnto, ReportsTheDistance) {
  ForeignMesh mesh = structure();
  const FibreField near = map_onto(draped(2).field, mesh);
  EXPECT_GT(near.greatest_distance, 1.0);
  EXPECT_LT(near.greatest_distance, 4.5);
  EXPECT_LE(near.mean_distance, near.greatest_distance);
  EXPECT_EQ(near.far, 0);
  for (auto& x : mesh.position) x[2] += 1000.0;
  Onto onto;
  onto.within = 1100.0;
  const FibreField far = map_onto(draped(4).field, mesh, onto);
  for (const auto& element : far.element) EXPECT_GT(element.distance, 900.0);
}

// Half a shell (60 mm) or cell is the distance that is allowed when none is told.
TEST(MapOnto, ShellsFarFromTheFabricGetNoDirection) {
  ForeignMesh mesh = structure();
  for (const std::size_t n : {0U, 1U, 5U, 6U}) mesh.position[n][2] += 100.0;  // the corners of the first shell
  const FibreField field = map_onto(draped(4).field, mesh);
  EXPECT_NEAR(field.within, 30.0, 3.0);
  EXPECT_TRUE(field.element.front().far);
  EXPECT_FALSE(field.element.back().far);
  EXPECT_EQ(field.far, std::count_if(field.element.begin(), field.element.end(), [](const auto& e) { return e.far; }));
  EXPECT_GT(field.greatest_distance, field.within);
  EXPECT_LT(field.mean_distance, field.within) << "of the shells on the fabric alone";
  for (const std::string& text : {orientation_abaqus(field, "test").text, orientation_calculix(field, 1.0, "test").text,
                                  drape_openradioss(field, "test").text})
    EXPECT_NE(text.find(std::to_string(field.far) + " shells lie farther than"), std::string::npos);
  EXPECT_EQ(orientation_abaqus(field, "test").text.find("\n100, "), std::string::npos) << "the far shell's number";
  const std::string csv = fibre_csv(field).text;
  const std::size_t row = csv.find("\n100,") + 1;
  const std::string first = csv.substr(row, csv.find('\n', row) - row);
  EXPECT_NE(first.find(",0,0,0,0,0,0,0,0,0,0,"), std::string::npos) << first;
  EXPECT_EQ(first.back(), '0');
  for (auto& x : mesh.position) x[2] += 1000.0;
  EXPECT_THROW((void)map_onto(draped(4).field, mesh), InputError) << "none is near";
}

// The same part in metres, turned and moved away: with unit, rotation and position the same directions in its own axes.
TEST(MapOnto, AnswersInTheAxesOfAPartThatWasPlaced) {
  const FibreField fabric = draped(4).field;
  const FibreField straight = map_onto(fabric, structure());
  ForeignMesh moved = structure();
  const Eigen::AngleAxisd turn(0.7, Vector3d(1.0, 2.0, 3.0).normalized());
  const Vector3d origin(300.0, -50.0, 20.0);
  for (auto& x : moved.position) {
    const Vector3d own = turn.inverse() * (Vector3d(x[0], x[1], x[2]) - origin) * 1e-3;
    x = {own.x(), own.y(), own.z()};
  }
  Onto onto;
  onto.axis = {1.0, 2.0, 3.0};
  onto.angle = 0.7 * degrees_per_radian;
  onto.position = {300.0, -50.0, 20.0};
  try {
    (void)map_onto(fabric, moved, onto);
    FAIL() << "metres are asked about";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("in metres? Give --unit m"), std::string::npos) << error.what();
  }
  onto.unit = LengthUnit::m;
  const FibreField field = map_onto(fabric, moved, onto);
  ASSERT_EQ(field.element.size(), straight.element.size());
  for (std::size_t k = 0; k < field.element.size(); ++k) {
    const StateElement &a = field.element[k], &b = straight.element[k];
    EXPECT_NEAR(a.distance, b.distance, 1e-6);
    EXPECT_NEAR(a.state.shear_angle, b.state.shear_angle, 1e-6);
    const Vector3d world = turn * Vector3d(a.state.warp[0], a.state.warp[1], a.state.warp[2]);
    EXPECT_NEAR(world.dot(Vector3d(b.state.warp[0], b.state.warp[1], b.state.warp[2])), 1.0, 1e-6);
  }
  // thicknesses for a model in metres
  const std::string text = orientation_calculix(field, 1.0, "test").text;
  const std::size_t section = text.find("\n*SHELL SECTION") + 1;
  EXPECT_NEAR(std::stod(text.substr(text.find('\n', section))), 1e-3 * field.element[0].state.thickness, 2e-6);
}

// Groups cover every shell once, within the angle; an angle of 0 makes a group of each shell on a sphere.
TEST(FibreFiles, CalculixGroupsHoldTheirShellsDirections) {
  const FibreField field = draped(8).field;
  std::vector<std::size_t> groups;
  for (const double angle : {0.0, 2.0, 20.0}) {
    std::istringstream in(orientation_calculix(field, angle, "test").text);
    std::map<long, std::string> group_of;
    std::map<std::string, std::array<Vector3d, 2>> axes;
    std::string block;
    for (std::string line; std::getline(in, line);) {
      if (line.rfind("**", 0) == 0) continue;
      if (line[0] == '*') {
        block = line;
        continue;
      }
      std::vector<double> value;
      std::istringstream fields(line);
      for (std::string word; std::getline(fields, word, ',');) {
        EXPECT_LE(word.find_last_not_of(' ') - word.find_first_not_of(' ') + 1, 20U) << "CalculiX cuts longer numbers";
        value.push_back(std::stod(word));
      }
      for (const double number : value) {
        if (block.rfind("*ELSET, ELSET=FIBRE_", 0) != 0) break;
        EXPECT_TRUE(group_of.emplace(std::lround(number), block.substr(20)).second) << number;
      }
      if (block.rfind("*ORIENTATION, NAME=WARP_", 0) == 0)
        axes[block.substr(24, block.find(',', 24) - 24)] = {Vector3d(value[0], value[1], value[2]),
                                                            Vector3d(value[3], value[4], value[5])};
    }
    ASSERT_EQ(group_of.size(), field.element.size());
    for (const auto& element : field.element) {
      const auto& [a, b] = axes.at(group_of.at(element.number));
      const Vector3d warp(element.state.warp[0], element.state.warp[1], element.state.warp[2]);
      EXPECT_LE(std::acos(std::min(1.0, a.dot(warp))) * degrees_per_radian, std::max(angle, 1e-5));
      EXPECT_NEAR(a.dot(b), 0.0, 1e-12);
    }
    groups.push_back(axes.size());
  }
  EXPECT_EQ(groups[0], field.element.size()) << "no two shells lie alike";
  EXPECT_LT(groups[2], groups[0]);
}

TEST(MapOnto, RefusesElementsAcrossTheFabric) {
  ForeignMesh mesh;
  mesh.file = "wall";
  mesh.position = {{0, 0, 190}, {0, 10, 190}, {0, 10, 210}, {0, 0, 210}};
  mesh.number = {1, 2, 3, 4};
  mesh.shells.push_back({1, 7, {0, 1, 2, 3}});
  try {
    (void)map_onto(draped(8).field, mesh);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("wall:7: element 1"), std::string::npos) << error.what();
  }
}

// Files read back field by field.
TEST(FibreFiles, AbaqusOrientationsHoldTheDirections) {
  const FibreField field = draped(8).field;
  std::istringstream in(orientation_abaqus(field, "test").text);
  std::string block;
  std::size_t at = 0;
  int found[3] = {0, 0, 0};
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("**", 0) == 0) continue;
    if (line[0] == '*') {
      block = line;
      at = 0;
      continue;
    }
    if (block.rfind("*DISTRIBUTION, NAME=", 0) != 0 || line[0] == ',') continue;
    std::istringstream fields(line);
    std::vector<double> value;
    for (std::string word; std::getline(fields, word, ',');) value.push_back(std::stod(word));
    const StateElement& element = field.element.at(at++);
    ASSERT_EQ(static_cast<long>(value[0]), element.number);
    const bool warp = block.find("WARP_DIRECTIONS") != std::string::npos;
    const bool thick = block.find("THICKNESS") != std::string::npos;
    ++found[thick ? 2 : (warp ? 0 : 1)];
    ASSERT_EQ(value.size(), thick ? 2U : 7U);
    if (thick) {
      EXPECT_NEAR(value[1], element.state.thickness, 1e-12);
      continue;
    }
    const Vec3& a = warp ? element.state.warp : element.state.weft;
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(value[1 + c], a[c], 1e-12);
    // local 3 = a x b is the fabric's normal for both
    const Vector3d x(value[1], value[2], value[3]), y(value[4], value[5], value[6]);
    const Vector3d w(element.state.warp[0], element.state.warp[1], element.state.warp[2]);
    const Vector3d f(element.state.weft[0], element.state.weft[1], element.state.weft[2]);
    EXPECT_GT(x.cross(y).dot(w.cross(f)), 0.0);
  }
  for (const int count : found) EXPECT_EQ(count, static_cast<int>(field.element.size()));
}

TEST(FibreFiles, DrapeHoldsThinningAndAngle) {
  const FibreField field = draped(8).field;
  std::istringstream in(drape_openradioss(field, "test").text);
  int ply = 0;
  std::size_t at = 0, read = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (line.rfind("/DRAPE/", 0) == 0) {
      ply = std::stoi(line.substr(7));
      at = 0;
      std::getline(in, line);
      EXPECT_EQ(line, ply == 1 ? "warp" : "weft");
      continue;
    }
    ASSERT_EQ(line.size(), 60U) << line;
    const StateElement& element = field.element.at(at++);
    EXPECT_EQ(line.substr(0, 10), element.node.size() == 4 ? "SHELL     " : "SH3N      ");
    EXPECT_EQ(std::stol(line.substr(10, 10)), element.number);
    EXPECT_NEAR(std::stod(line.substr(20, 20)), element.state.thickness / field.flat_thickness, 1e-12);
    // Turning the projected reference by the angle about the normal gives the yarn.
    const double angle = std::stod(line.substr(40, 20)) / degrees_per_radian;
    const auto x = [&](std::size_t k) {
      const Vec3& p = field.position[element.node[k]];
      return Vector3d(p[0], p[1], p[2]);
    };
    const Vector3d normal = (element.node.size() == 4 ? Vector3d((x(2) - x(0)).cross(x(3) - x(1)))
                                                      : Vector3d((x(1) - x(0)).cross(x(2) - x(0))))
                                .normalized();
    const Vec3& flat = field.flat_direction[ply - 1];
    const Vector3d reference(flat[0], flat[1], flat[2]);
    const Vector3d base = (reference - reference.dot(normal) * normal).normalized();
    const Vector3d turned = Eigen::AngleAxisd(angle, normal) * base;
    const Vec3& yarn = ply == 1 ? element.state.warp : element.state.weft;
    EXPECT_GT(turned.dot(Vector3d(yarn[0], yarn[1], yarn[2])), 1.0 - 1e-3)
        << "a warped shell's yarn may leave its plane";
    ++read;
  }
  EXPECT_EQ(read, 2 * field.element.size());
}

TEST(FibreFiles, CsvHasARowPerElement) {
  const FibreField field = draped(8).field;
  std::istringstream in(fibre_csv(field).text);
  std::string line;
  std::getline(in, line);
  const auto columns = std::count(line.begin(), line.end(), ',');
  EXPECT_EQ(columns, 15);
  for (const auto& element : field.element) {
    ASSERT_TRUE(std::getline(in, line));
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), columns);
    EXPECT_EQ(std::stol(line), element.number);
  }
  EXPECT_FALSE(std::getline(in, line));
}

}  // namespace
}  // namespace weaveform
