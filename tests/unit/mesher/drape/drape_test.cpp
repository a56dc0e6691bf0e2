// A blank draped as the scene says: where it begins, what the mesh then holds, what is reported and what is refused.
#include "mesher/drape/drape.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "core/error.hpp"
#include "core/vector/vector.hpp"
#include "mesher/drape/flat_pattern.hpp"
#include "mesher/drape/sphere_net.hpp"
#include "mesher/lattice/build.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "mesher/scene/reader.hpp"
#include "tests/support/temporary_folder.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

// A dome of 75 mm, top at the origin, its shank below.
const std::string dome = R"([tools.dome]
shape = "sphere"
radius = 75
axis = [0, 0, -1]
position = [0, 0, -75]
)";
const std::string blank = R"([blank]
size = [120, 100]
yarn_angle = 20
orientation = 10
coarsening = 2
)";
const std::string drape_table = "[drape]\ntool = \"dome\"\n";

struct Draped {
  Scene scene;
  Mesh mesh;  // flat
  Drape drape;
  explicit Draped(const std::string& text, const std::vector<std::string>& overrides = {})
      : scene(read_scene_text(text, "s.toml", overrides)),
        mesh(build_flat_mesh(scene, load_card(scene.fabric.material))),
        drape(drape_blank(scene, mesh, make_tools(scene, mesh))) {}
};

std::string drape_complaint(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    const Draped draped(text, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void expect_in(const std::string& part, const std::string& text) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in\n" << text;
}

TEST(Drape, EveryYarnKeepsItsLengthAndEveryCrossingLiesHalfAThicknessOffTheTool) {
  const Draped d(blank + dome + drape_table);
  ASSERT_TRUE(d.drape.whole());
  EXPECT_LT(d.drape.length_error, 1e-9);
  for (int n = 0; n < d.mesh.node_count(); ++n) {
    ASSERT_TRUE(d.drape.placed[n] != 0);
    if (d.mesh.nodes.crossing[n][0] < 0) continue;
    EXPECT_NEAR(distance(d.drape.position[n], Vec3{0, 0, -75}), 75.0 + 0.5 * d.mesh.thickness, 1e-9);
  }
}

TEST(Drape, TiedEndsStayInLineWithTheirYarn) {
  const Draped d(blank + dome + drape_table);
  ASSERT_FALSE(d.mesh.tie.empty());
  for (const auto& tie : d.mesh.tie)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(d.drape.position[tie.node][c],
                  (1 - tie.share) * d.drape.position[tie.to[0]][c] + tie.share * d.drape.position[tie.to[1]][c], 1e-12);
}

TEST(Drape, AMeshThatStartsDrapedKeepsItsFlatPlacesThroughTheFile) {
  const Scene scene = read_scene_text(blank + dome + drape_table, "s.toml");
  const Card card = load_card(scene.fabric.material);
  const Mesh flat = build_flat_mesh(scene, card), mesh = build_mesh(scene, card);
  EXPECT_EQ(mesh.nodes.flat_position, flat.nodes.position);
  EXPECT_EQ(mesh.flat_positions(), flat.flat_positions());
  EXPECT_EQ(mesh.yarns.rest_length, flat.yarns.rest_length);
  EXPECT_EQ(mesh.cells.area, flat.cells.area);
  EXPECT_TRUE(flat.nodes.flat_position.empty());
  const fs::path file = test::scratch_file("drape.vtu");
  write_mesh(mesh, file);
  const Mesh back = read_mesh(file);
  fs::remove(file);
  EXPECT_EQ(back.nodes.position, mesh.nodes.position);
  EXPECT_EQ(back.nodes.flat_position, mesh.nodes.flat_position);
}

TEST(Drape, EchoReadsBackToTheSameDrape) {
  const Scene scene = read_scene_text(blank + dome + drape_table +
                                          "seed = [0, 0, 0]\nanchor = [5, 2]\nwarp_curve = [[-9, 0, 0], [0, 0, 0], "
                                          "[9, 1, 0]]\nwarp_direction = [1, 0, 0]\n",
                                      "s.toml");
  EXPECT_EQ(read_scene_text(scene_to_toml(scene), "s.toml"), scene) << scene_to_toml(scene);
}

// On a plane the drape is the flat blank moved, whatever its outline: the crossings outside that carry it are laid too.
TEST(Drape, ANarrowBlankAcrossTheYarnsLiesOnAPlaneAsItWas) {
  const Draped d(
      "[blank]\nsize = [40, 200]\nyarn_angle = 45\nposition = [1, 2, 3]\n[tools.table]\nshape = \"plane\"\nposition = "
      "[0, 0, -20]\n[drape]\ntool = \"table\"\n");
  ASSERT_TRUE(d.drape.whole());
  EXPECT_TRUE(d.drape.tight.empty());
  const double z = -20.0 + 0.5 * d.mesh.thickness;
  for (int n = 0; n < d.mesh.node_count(); ++n) {
    const auto& flat = d.mesh.nodes.position[n];
    EXPECT_LT(distance(d.drape.position[n], Vec3{flat[0], flat[1], z}), 1e-9);
  }
}

// A fabric laid from below, its upper side to the tool.
TEST(Drape, TheUpperSideStaysUpOnAToolFromAbove) {
  const Draped d(
      "[blank]\nsize = [60, 60]\nyarn_angle = 0\n[tools.punch]\nshape = \"sphere\"\nradius = 75\n[drape]\ntool = "
      "\"punch\"\nprojection = [0, 0, 1]\n");
  ASSERT_TRUE(d.drape.whole());
  EXPECT_NEAR(d.drape.seed[2], 0.0, 1e-6);  // the punch touches the flat blank
  for (int n = 0; n < d.mesh.node_count(); ++n) {
    const auto &flat = d.mesh.nodes.position[n], &x = d.drape.position[n];
    EXPECT_LT(std::hypot(x[0] - flat[0], x[1] - flat[1]), 10.0);  // not mirrored
  }
}

TEST(Drape, AnchorAndSeedSayWhichPointLiesWhere) {
  const Draped d(blank + dome + drape_table + "anchor = [30, -20]\nseed = [0, 45, -15]\n");
  double least = 1e9;
  for (int n = 0; n < d.mesh.node_count(); ++n) {
    if (distance(d.drape.position[n], d.drape.seed) > 1e-9) continue;
    const double angle = 10.0 * std::numbers::pi / 180.0;
    const double x = 30.0 * std::cos(angle) + 20.0 * std::sin(angle);
    const double y = 30.0 * std::sin(angle) - 20.0 * std::cos(angle);
    least = std::hypot(d.mesh.nodes.position[n][0] - x, d.mesh.nodes.position[n][1] - y);
  }
  EXPECT_LT(least, 0.71 * std::max(d.mesh.spacing[0], d.mesh.spacing[1]));
}

TEST(Drape, AGivenCurveThatIsAGeodesicGivesTheSameNet) {
  std::string warp = "warp_curve = [", weft = "weft_curve = [";
  for (int k = -60; k <= 60; ++k) {
    const double a = k * std::numbers::pi / 180.0, c = std::cos(30.0 * std::numbers::pi / 180.0), s = 0.5;
    const double out = 75.0 * std::sin(a), z = 75.0 * std::cos(a) - 75.0;
    warp += fmt::format("[{:.6f},{:.6f},{:.6f}],", c * out, s * out, z);
    weft += fmt::format("[{:.6f},{:.6f},{:.6f}],", -s * out, c * out, z);
  }
  const Draped free(blank + dome + drape_table);
  const Draped led(blank + dome + drape_table + warp + "]\n" + weft + "]\n");
  ASSERT_TRUE(led.drape.whole());
  EXPECT_LT(led.drape.length_error, 1e-9);
  for (int n = 0; n < free.mesh.node_count(); ++n)
    EXPECT_LT(distance(free.drape.position[n], led.drape.position[n]),
              1e-4);  // the curve has six digits after the point
}

TEST(Drape, ACurvedGeneratorShearsThePlane) {
  const Draped d(
      "[blank]\nsize = [80, 80]\nyarn_angle = 0\n[tools.table]\nshape = \"plane\"\nposition = [0, 0, 0]\n[drape]\ntool "
      "= "
      "\"table\"\nseed = [0, 0, 0]\nwarp_curve = [[-50, 10, 0], [0, 0, 0], [50, 30, 0]]\n");
  // right of the seed the warp leaves it at atan(30/50), the weft at right angles to that; left it comes in at
  // -atan(10/50)
  ASSERT_TRUE(d.drape.whole());
  double least = 1e9, greatest = -1e9;
  for (const double angle : d.drape.shear_angle) {
    least = std::min(least, angle);
    greatest = std::max(greatest, angle);
  }
  EXPECT_NEAR(greatest, 0.0, 1e-9);
  EXPECT_NEAR(least, -std::atan(0.6) - std::atan(0.2), 1e-9);
}

// Centroid of a cell's flat polygon, from the seed at the blank's centre.
std::array<double, 2> flat_centre(const Mesh& mesh, int c) {
  double twice = 0.0, x = 0.0, y = 0.0;
  const int begin = mesh.cells.offset[c], end = mesh.cells.offset[c + 1];
  for (int a = begin; a < end; ++a) {
    const auto& p = mesh.nodes.position[mesh.cells.node[a]];
    const auto& q = mesh.nodes.position[mesh.cells.node[a + 1 == end ? begin : a + 1]];
    const double cross = p[0] * q[1] - q[0] * p[1];
    twice += cross;
    x += cross * (p[0] + q[0]) / 3.0;
    y += cross * (p[1] + q[1]) / 3.0;
  }
  return {x / twice, y / twice};
}

// A square of 1725 mm in cells of 75 mm on a sphere of 1 m, whose exact net has g(uv/R^2) at (u, v).
std::string sphere_scene(const std::string& phase) {
  return "[blank]\nsize = [1725.0, 1725.0]\nyarn_angle = 0.0\ncoarsening = 15.2439024390\nfit = 'none'\nphase = " +
         phase +
         "\n[tools.dome]\nshape = 'sphere'\nradius = 1000.0\nposition = [0, 0, -1000]\naxis = [0, 0, -1]\noffset = 0\n"
         "[drape]\ntool = 'dome'\nanchor = [0, 0]\nseed = [0, 0, 0]\n";
}

TEST(Drape, CellsCutByTheBlanksEdgeHaveTheNetsAngleAtTheirCentre) {
  constexpr double deg = std::numbers::pi / 180.0;
  for (const char* phase : {"[0, 0]", "[0.5, 0.5]", "[0.25, 0.1]", "[0.9, 0.3]", "[-0.4, 0.0]"}) {
    const Draped d(sphere_scene(phase));
    ASSERT_TRUE(d.drape.whole()) << phase;
    // where the crossing nearest to the anchor, which lies on the seed, is on the flat blank
    std::array<double, 2> seed = {0.0, 0.0};
    double nearest = 1e9;
    for (int n = 0; n < d.mesh.node_count(); ++n) {
      if (d.mesh.nodes.crossing[n][0] < 0 || distance(d.drape.position[n], d.drape.seed) > nearest) continue;
      nearest = distance(d.drape.position[n], d.drape.seed);
      seed = {d.mesh.nodes.position[n][0], d.mesh.nodes.position[n][1]};
    }
    double greatest = 0.0;
    for (int c = 0; c < d.mesh.cells.size(); ++c) {
      const auto at = flat_centre(d.mesh, c);
      const double exact = sphere_net_angle((at[0] - seed[0]) * (at[1] - seed[1]) * 1e-6);
      EXPECT_NEAR(d.drape.shear_angle[c] / deg, exact / deg, 0.01) << phase << " cell " << c;
      greatest = std::max(greatest, std::abs(d.drape.shear_angle[c]));
      EXPECT_EQ(d.drape.extrapolated[c], 0);
    }
    if (std::string(phase) == "[0, 0]") {
      EXPECT_NEAR(greatest / deg, 39.13, 0.03);
    } else if (std::string(phase) == "[0.5, 0.5]") {
      EXPECT_NEAR(greatest / deg, 41.366, 0.01);
    }
  }
}

TEST(Drape, FreeEndsOfTheResultLieOnTheToolAndThoseOfAStartInLine) {
  const Draped d(sphere_scene("[0, 0]"));
  for (const auto& tie : d.mesh.tie) {
    EXPECT_NEAR(distance(d.drape.laid[tie.node], Vec3{0, 0, -1000}), 1000.0, 1e-6);
    EXPECT_GT(distance(d.drape.position[tie.node], Vec3{0, 0, -1000}), 1000.5);
  }
}

// On developable surfaces, along the axis, no cell is sheared: neither a whole one nor one at the edge.
TEST(Drape, CutCellsOnACylinderAndAConeAreUnsheared) {
  const std::string cylinder =
      "[tools.t]\nshape = 'cylinder'\nradius = 60\naxis = [1, 0, 0]\nposition = [0, 0, -60]\n[drape]\ntool = 't'\n";
  const Draped along("[blank]\nsize = [61, 83]\nyarn_angle = 0\nphase = [0.2, 0.3]\nfit = 'none'\n" + cylinder);
  for (const double angle : along.drape.shear_angle) EXPECT_NEAR(angle, 0.0, 1e-6);
  const Draped across("[blank]\nsize = [61, 83]\nyarn_angle = 45\nphase = [0.2, 0.3]\nfit = 'none'\n" + cylinder);
  // gamma = (a/r)^2 sin 2b / 12 of the chords (drape.hpp)
  const double invented = std::pow(4.92 / 60.0, 2) / 12.0;
  for (const double angle : across.drape.shear_angle) EXPECT_NEAR(std::abs(angle), invented, 0.3 * invented);
  // a cone, seed 65 mm off its axis, warp down its side
  const Draped cone(
      "[blank]\nsize = [61, 83]\nyarn_angle = 0\nphase = [0.2, 0.3]\nfit = 'none'\n[tools.t]\nshape = "
      "'revolved'\noffset = "
      "0\nposition = [0, 0, 0]\nprofile = [[10, 40], [130, -200]]\n[drape]\ntool = 't'\nseed = [65, 0, -70]\n"
      "warp_direction = [1, 0, -2]\n");
  ASSERT_TRUE(cone.drape.whole());
  for (const double angle : cone.drape.shear_angle) EXPECT_NEAR(angle, 0.0, std::pow(4.92 / 40.0, 2) / 12.0);
}

// A dome of triangles, 75 mm in radius.
TEST(Drape, CutCellsOnATriangulatedSphereHaveTheExactNetsAngle) {
  constexpr double deg = std::numbers::pi / 180.0, radius = 75.0;
  const fs::path file = test::scratch_file("dome.stl");
  {
    std::ofstream out(file);
    out.precision(17);
    out << "solid dome\n";
    const auto at = [&](int ring, int k) {
      const double polar = ring * 1.5 * deg, around = k * 3.0 * deg;
      return std::array<double, 3>{radius * std::sin(polar) * std::cos(around),
                                   radius * std::sin(polar) * std::sin(around), radius * (std::cos(polar) - 1.0)};
    };
    const auto facet = [&](const std::array<std::array<double, 3>, 3>& corners) {
      out << "facet normal 0 0 1\nouter loop\n";
      for (const auto& x : corners) out << "vertex " << x[0] << ' ' << x[1] << ' ' << x[2] << "\n";
      out << "endloop\nendfacet\n";
    };
    for (int k = 0; k < 120; ++k) facet({at(0, 0), at(1, k), at(1, k + 1)});
    for (int ring = 1; ring < 50; ++ring)
      for (int k = 0; k < 120; ++k) {
        facet({at(ring, k), at(ring + 1, k), at(ring + 1, k + 1)});
        facet({at(ring, k), at(ring + 1, k + 1), at(ring, k + 1)});
      }
    out << "endsolid dome\n";
  }
  const Draped d(
      fmt::format("[blank]\nsize = [100, 104]\nyarn_angle = 0\nphase = [0, 0]\nfit = 'none'\n[tools.t]\nshape = "
                  "'triangles'\noffset = 0\nfile = '{}'\n[drape]\ntool = 't'\n",
                  file.string()));
  fs::remove(file);
  ASSERT_TRUE(d.drape.whole());
  double greatest = 0.0, exact_greatest = 0.0;
  for (int c = 0; c < d.mesh.cells.size(); ++c) {
    const auto at = flat_centre(d.mesh, c);
    const double exact = sphere_net_angle(at[0] * at[1] / (radius * radius));
    EXPECT_NEAR(d.drape.shear_angle[c] / deg, exact / deg, 0.5) << c;
    greatest = std::max(greatest, std::abs(d.drape.shear_angle[c]) / deg);
    exact_greatest = std::max(exact_greatest, std::abs(exact) / deg);
  }
  EXPECT_NEAR(greatest, exact_greatest, 0.3);
}

TEST(Drape, FoldsAreCountedByPlaceAndNoStartForASolve) {
  const std::string text =
      "[blank]\nsize = [220, 220]\nyarn_angle = 0\ncoarsening = 2\n[tools.dome]\nshape = "
      "\"revolved\"\nposition = [0, 0, -75]\nprofile = [[0, -75], [75, 0, 0, 0], [0, 75, 0, 0]]\n" +
      drape_table;
  const Draped d(text);
  ASSERT_EQ(d.drape.folds.size(), 4U);  // one a quarter
  EXPECT_FALSE(d.drape.whole());
  const Scene scene = read_scene_text(text, "s.toml");
  try {
    (void)build_mesh(scene, load_card(scene.fabric.material));
    FAIL() << "a folded start was taken";
  } catch (const PhysicsError& error) {
    expect_in("s.toml: [drape] on tool 'dome' is no start for a solve", error.what());
    expect_in("the net folds", error.what());
  }
}

// STL text of a plate in z = 0 with an optional square hole, two triangles a square of 10 mm.
fs::path plate(double half, double hole, double unit = 1.0, bool flipped = false) {
  static int number = 0;
  const fs::path file = test::scratch_file(fmt::format("plate_{}.stl", number++));
  std::ofstream out(file);
  out.precision(17);
  out << "solid plate\n";
  const auto facet = [&](std::array<std::array<double, 2>, 3> p) {
    if (flipped) std::swap(p[1], p[2]);
    out << "facet normal 0 0 1\nouter loop\n";
    for (const auto& x : p) out << "vertex " << unit * x[0] << ' ' << unit * x[1] << " 0\n";
    out << "endloop\nendfacet\n";
  };
  for (double y = -half; y < half - 1e-9; y += 10.0)
    for (double x = -half; x < half - 1e-9; x += 10.0) {
      if (std::abs(x + 5.0 - 20.0) < hole && std::abs(y + 5.0 - 20.0) < hole) continue;
      facet({{{x, y}, {x + 10, y}, {x + 10, y + 10}}});
      facet({{{x, y}, {x + 10, y + 10}, {x, y + 10}}});
    }
  out << "endsolid plate\n";
  return file;
}

std::string on_plate(const fs::path& file, double angle) {
  return fmt::format(
      "[blank]\nsize = [200, 200]\nyarn_angle = {}\n[tools.part]\nshape = \"triangles\"\nfile = \"{}\"\n[drape]\ntool "
      "= "
      "\"part\"\n",
      angle, file.string());
}

// A plate as wide as the blank: the net beyond the blank's edge leaves it.
TEST(Drape, CutCellsWhereTheToolEndsAreSaidToBeExtrapolated) {
  const auto extrapolated = [](double half) {
    const fs::path file = plate(half, 0.0);
    const Draped d(
        fmt::format("[blank]\nsize = [50, 50]\nyarn_angle = 0\nphase = [0.3, 0.3]\nfit = 'none'\n[tools.part]\nshape = "
                    "'triangles'\nfile = '{}'\n[drape]\ntool = 'part'\n",
                    file.string()));
    fs::remove(file);
    EXPECT_TRUE(d.drape.whole());
    for (const double angle : d.drape.shear_angle) EXPECT_NEAR(angle, 0.0, 1e-9);
    return std::count(d.drape.extrapolated.begin(), d.drape.extrapolated.end(), 1);
  };
  EXPECT_EQ(extrapolated(100.0), 0);
  EXPECT_GT(extrapolated(25.0), 20);
}

TEST(Drape, TheFlatPatternOfAPartIsTheBlankCutAtItsBorder) {
  const fs::path file = plate(60.0, 0.0);
  const Draped d(on_plate(file, 30.0));
  EXPECT_FALSE(d.drape.unreachable.empty());
  expect_in("border or a hole", d.drape.unreachable.front().what);
  const FlatPattern pattern = flat_pattern(d.scene, d.mesh, make_tools(d.scene, d.mesh), d.drape);
  ASSERT_EQ(pattern.size(), 1U);
  // the plate is flat, so the pattern is the plate; every point lies on its border, corners are cut between two yarns
  for (const auto& p : pattern[0]) EXPECT_NEAR(std::max(std::abs(p[0]), std::abs(p[1])), 60.0, 1e-3);
  EXPECT_NEAR(pattern_area(pattern), 120.0 * 120.0, 4.0 * d.mesh.spacing[0] * d.mesh.spacing[0]);
  EXPECT_EQ(flat_pattern_csv({{{1, 2}, {3, 4.5}}}), "loop,x_mm,y_mm\n0,1,2\n0,3,4.5\n");
  fs::remove(file);
}

TEST(Drape, AHoleIsReportedByPlace) {
  const fs::path file = plate(120.0, 10.0);  // 10 to 30 mm in x and y
  const Draped d(on_plate(file, 0.0));
  ASSERT_EQ(d.drape.unreachable.size(), 1U);
  const auto& place = d.drape.unreachable.front();
  expect_in("border or a hole", place.what);
  for (int c = 0; c < 2; ++c) EXPECT_NEAR(place.at[c], 10.0, 2.0 * d.mesh.spacing[0]);
  fs::remove(file);
}

TEST(Drape, WholeBlanksHaveTheirOwnAreaAsPattern) {
  const Draped d(blank + dome + drape_table);
  const FlatPattern pattern = flat_pattern(d.scene, d.mesh, make_tools(d.scene, d.mesh), d.drape);
  ASSERT_EQ(pattern.size(), 1U);
  // four corners are cut straight between yarn ends
  EXPECT_NEAR(pattern_area(pattern), 120.0 * 100.0, 4.0 * d.mesh.spacing[0] * d.mesh.spacing[1]);
  EXPECT_LT(pattern_area(pattern), 120.0 * 100.0);
}

TEST(Drape, TightRadiiAndSharpEdgesAreReportedByPlace) {
  const std::string ring =
      "[tools.ring]\nshape = \"ring\"\nopening_radius = 200\nposition = [-220, 0, 0]\n[blank]\nsize = "
      "[80, 60]\nyarn_angle = 30\n[drape]\ntool = \"ring\"\n";
  const Draped round(ring + "[fabric]\nmaterial = \"twintex-pw\"\n", {"tools.ring.fillet_radius=8"});
  ASSERT_FALSE(round.drape.tight.empty());
  double radius = 0.0;
  ASSERT_EQ(std::sscanf(round.drape.tight.front().what.c_str(), "the tool's radius of about %lf", &radius), 1);
  EXPECT_NEAR(radius, 8.0, 1.2);  // chords that begin before the bend see less of it
  const Draped wide(ring, {"tools.ring.fillet_radius=19"});
  EXPECT_TRUE(wide.drape.tight.empty());
  const Draped sharp(ring, {"tools.ring.offset=0"});
  ASSERT_FALSE(sharp.drape.tight.empty());
  expect_in("sharp edge", sharp.drape.tight.front().what);
  EXPECT_NEAR(sharp.drape.tight.front().at[2], 0.0, 0.5);
  EXPECT_NEAR(std::hypot(sharp.drape.tight.front().at[0] + 220.0, sharp.drape.tight.front().at[1]), 200.0, 0.5);
}

TEST(Drape, WrongInputIsNamed) {
  expect_in("there is no [tools.dom]; did you mean 'dome'?",
            drape_complaint(blank + dome + "[drape]\ntool = \"dom\"\n"));
  expect_in("lacks the required key 'tool'", drape_complaint(blank + dome + "[drape]\n"));
  expect_in("seed (0, 0, 12) mm is 11.75 mm off the surface of tool 'dome'; the nearest point of it is (0, 0, 0.25) mm",
            drape_complaint(blank + dome + drape_table + "seed = [0, 0, 12]\n"));
  expect_in("the blank misses tool 'dome'", drape_complaint(blank + dome + drape_table, {"blank.position=[100,0,0]"}));
  expect_in("far before tool 'dome' it is inside it already",
            drape_complaint(blank + dome + drape_table, {"drape.projection=[0,0,1]"}));
  expect_in("is across the surface at the seed",
            drape_complaint(blank + dome + drape_table, {"drape.warp_direction=[0,0,1]"}));
  expect_in("'projection' is zero", drape_complaint(blank + dome + drape_table, {"drape.projection=[0,0,0]"}));
  expect_in("[drape] has both 'seed' and 'projection'",
            drape_complaint(blank + dome + drape_table + "seed = [0,0,0]\nprojection = [1,0,0]\n"));
  expect_in("passes the seed (0, 0, 0.25) mm at a distance of 20",
            drape_complaint(blank + dome + drape_table + "seed = [0,0,0]\nwarp_curve = [[-9, 20, 0], [9, 20, 0]]\n"));
  expect_in("'warp_curve' is two points", drape_complaint(blank + dome + drape_table + "warp_curve = [[1, 2]]\n"));
  expect_in("no crossing of the blank lies near", drape_complaint(blank + dome + drape_table + "anchor = [200, 0]\n"));
  expect_in("shear frame cannot start draped",
            drape_complaint(dome + drape_table + "[frame]\n[blank]\nsize=[100,100]\n"));
}

}  // namespace
}  // namespace weaveform
