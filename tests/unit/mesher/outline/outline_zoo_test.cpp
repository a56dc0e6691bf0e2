// Blanks of every outline: what the mesher keeps exactly for each, whatever the yarn angle and coarsening.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <numeric>
#include <set>

#include "core/error.hpp"
#include "core/vector/vector.hpp"
#include "mesher/outline/loops.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/mesher/lattice/lattice_zoo.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;
using lattice_zoo::plain_weave;
using lattice_zoo::twill;

struct Blank {
  std::string name;
  Scene scene;
  double area;  // mm^2; exact
};

Scene shaped(BlankShape shape, std::array<double, 2> size = {115.0, 230.0}) {
  Scene scene;
  scene.blank.shape = shape;
  scene.blank.size = size;
  return scene;
}

// A rectangle 180 x 120 with a notch 20 wide and 30 deep in its lower side, and a round-ish and a square hole.
fs::path notched_file() {
  const fs::path file = test::scratch_file("notched_outline.csv");
  std::ofstream out(file);
  out << "x_mm,y_mm\n# outer\n-90,-60\n-10,-60\n-10,-30\n10,-30\n10,-60\n90,-60\n90,60\n-90,60\n-90,-60\n\n"
         "# hole, the same way around as the outer "
         "one\n30,0\n50,0\n50,20\n30,20\n30,0\n\n-50,0\n-30,10\n-50,20\n-60,10\n"
         "-50,0\n";
  return file;
}

std::vector<Blank> outlines() {
  std::vector<Blank> blanks;
  blanks.push_back({"disc", shaped(BlankShape::disc, {150.0, 150.0}), std::numbers::pi * 75.0 * 75.0});
  blanks.push_back({"ellipse", shaped(BlankShape::disc, {200.0, 120.0}), std::numbers::pi * 100.0 * 60.0});
  Blank triangle{"triangle", shaped(BlankShape::polygon), 0.5 * 180.0 * 150.0};
  triangle.scene.blank.corners = {{-90, -60}, {90, -60}, {20, 90}};
  blanks.push_back(triangle);
  Blank letter{"clockwise L", shaped(BlankShape::polygon), 150.0 * 150.0 - 80.0 * 90.0};
  letter.scene.blank.corners = {{0, 0}, {0, 150}, {70, 150}, {70, 60}, {150, 60}, {150, 0}};
  blanks.push_back(letter);
  Blank notched{"notched with holes", shaped(BlankShape::file), 180.0 * 120.0 - 20.0 * 30.0 - 400.0 - 300.0};
  notched.scene.blank.outline = notched_file().string();
  blanks.push_back(notched);
  return blanks;
}

// The component out of the plane of (a - o) x (b - o).
double turn_at(const Vec3& o, const Vec3& a, const Vec3& b) {
  return cross(minus(a, o), minus(b, o))[2];
}

// Everything that must hold on any flat mesh of known area.
void check_mesh(const Mesh& mesh, const Card& card, double area, const std::string& name) {
  constexpr double rounding = 1e-11;  // of sums over up to 1e5 terms
  EXPECT_NEAR(std::accumulate(mesh.cells.area.begin(), mesh.cells.area.end(), 0.0) / area, 1.0, rounding) << name;
  EXPECT_NEAR(std::accumulate(mesh.nodes.mass.begin(), mesh.nodes.mass.end(), 0.0) / (card.area_density() * area), 1.0,
              rounding)
      << name;
  std::array<double, 2> length{};
  std::set<std::array<int, 2>> seen;
  std::vector<int> used(mesh.node_count(), 0);
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const auto [a, b] = mesh.yarns.node[e];
    length[static_cast<std::size_t>(mesh.yarns.family[e])] += mesh.yarns.yarns[e] * mesh.yarns.rest_length[e];
    EXPECT_TRUE(seen.insert({std::min(a, b), std::max(a, b)}).second) << name << ": duplicate element " << e;
    EXPECT_GT(mesh.yarns.yarns[e], 0.0) << name;
    ++used[a];
    ++used[b];
  }
  for (std::size_t f = 0; f < 2; ++f) EXPECT_NEAR(length[f] * card.yarn[f].interval / area, 1.0, rounding) << name;
  std::set<std::array<double, 2>> places;
  for (int n = 0; n < mesh.node_count(); ++n) {
    EXPECT_GT(used[n], 0) << name << ": orphan node " << n;
    EXPECT_TRUE(places.insert({mesh.nodes.position[n][0], mesh.nodes.position[n][1]}).second)
        << name << ": twin of " << n;
  }
  for (int c = 0; c < mesh.cells.size(); ++c) {
    const int begin = mesh.cells.offset[c], end = mesh.cells.offset[c + 1];
    double twice = 0.0;
    for (int a = begin + 1; a + 1 < end; ++a)
      twice += turn_at(mesh.nodes.position[mesh.cells.node[begin]], mesh.nodes.position[mesh.cells.node[a]],
                       mesh.nodes.position[mesh.cells.node[a + 1]]);
    // counter-clockwise, and no sliver: a stub shorter than a tenth of the spacing makes no cell of its own
    EXPECT_GT(0.5 * twice, 0.004 * mesh.spacing[0] * mesh.spacing[1]) << name << ": cell " << c;
  }
}

TEST(OutlineZoo, AreaYarnLengthAndMassAreExactAndNothingIsDuplicateOrphanOrSliver) {
  int count = 0;
  for (const auto& blank : outlines())
    for (const Card& card : {plain_weave(), twill()})
      for (const double angle : {0.0, 17.0, 30.0, 45.0, 90.0})
        for (const double coarsening : {0.5, 1.0, 2.0, 3.0}) {
          Scene scene = blank.scene;
          scene.blank.yarn_angle = angle;
          scene.blank.coarsening = {coarsening, coarsening};
          check_mesh(build_mesh(scene, card), card, blank.area,
                     fmt::format("{} {} {} deg k {}", blank.name, card.name, angle, coarsening));
          ++count;
        }
  EXPECT_EQ(count, 200);
}

// A cross: the square's cells alone, the yarns of both families out to the arms' ends.
TEST(OutlineZoo, ACrossHasYarnsInItsArmsAndCellsInItsMiddle) {
  for (const Card& card : {plain_weave(), twill()})
    for (const double angle : {0.0, 90.0})
      for (const double coarsening : {1.0, 2.0}) {
        Scene scene = shaped(BlankShape::cross, {230.0, 200.0});
        scene.blank.arm_width = 120.0;
        scene.blank.yarn_angle = angle;
        scene.blank.coarsening = {coarsening, coarsening};
        for (const std::string edge : {"left", "right", "bottom", "top"})
          scene.grip.push_back(lattice_zoo::grip_on(edge));
        const Mesh mesh = build_mesh(scene, card);
        EXPECT_NEAR(std::accumulate(mesh.cells.area.begin(), mesh.cells.area.end(), 0.0), 120.0 * 120.0, 1e-8);
        std::array<double, 2> length{};
        for (int e = 0; e < mesh.yarn_count(); ++e)
          length[static_cast<std::size_t>(mesh.yarns.family[e])] += mesh.yarns.yarns[e] * mesh.yarns.rest_length[e];
        double mass = 0.0;
        for (std::size_t f = 0; f < 2; ++f) {
          const bool along_x = (f == 0) == (angle == 0.0);
          EXPECT_NEAR(length[f], 120.0 * (along_x ? 230.0 : 200.0) / card.yarn[f].interval, 1e-8);
          mass += length[f] * card.yarn[f].linear_density;
        }
        EXPECT_NEAR(std::accumulate(mesh.nodes.mass.begin(), mesh.nodes.mass.end(), 0.0), mass, 1e-12 * mass);
        for (const auto& grip : scene.grip)
          for (const auto& set : mesh.sets) {
            if (set.name != grip.name) continue;
            EXPECT_FALSE(set.node.empty());
            for (const int n : set.node) {
              const auto& x = mesh.nodes.position[n];
              EXPECT_NEAR(grip.edge == BlankEdge::left || grip.edge == BlankEdge::right ? std::abs(x[0]) - 115.0
                                                                                        : std::abs(x[1]) - 100.0,
                          0.0, 1e-9);
            }
          }
      }
}

TEST(OutlineZoo, AShapeWithoutNamedEdgesAsksForABox) {
  Scene scene = shaped(BlankShape::disc, {150.0, 150.0});
  scene.grip = {lattice_zoo::grip_on("bottom")};
  try {
    static_cast<void>(build_mesh(scene, plain_weave()));
    FAIL() << "a disc has no bottom";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("a disc has no edges with names; give the grip a 'box'"),
              std::string::npos)
        << error.what();
  }
}

// Two blanks cut from one roll: every yarn of the second lies a whole number of intervals from those of the first.
TEST(OutlineZoo, BlanksOfOneRollShareTheirYarns) {
  const Card card = plain_weave();
  Scene first = shaped(BlankShape::disc, {150.0, 150.0}), second = first;
  for (auto* scene : {&first, &second}) scene->blank.yarn_angle = 0.0;
  first.blank.on_roll = {10.0, 20.0};
  second.blank.on_roll = {333.3, -71.7};
  const auto crossing_on_roll = [&](const Scene& scene) {
    const Mesh mesh = build_mesh(scene, card);
    int n = 0;
    while (mesh.nodes.crossing[n][0] < 0) ++n;
    return std::array<double, 2>{mesh.nodes.position[n][0] + (*scene.blank.on_roll)[0],
                                 mesh.nodes.position[n][1] + (*scene.blank.on_roll)[1]};
  };
  for (const auto* scene : {&first, &second})
    for (const double x : crossing_on_roll(*scene))
      EXPECT_NEAR(x / 4.92, std::round(x / 4.92), 1e-9);  // a crossing lies at the roll's origin
}

std::string outline_script(const std::string& text) {
  const fs::path file = test::scratch_file("outline.geo");
  std::ofstream(file) << text;
  return file.string();
}

// A plate with a round hole and a notch, as a Gmsh script: read through the same door as STEP, IGES and BREP.
TEST(OutlineCad, APlateWithAHoleAndANotchHasItsArea) {
  Scene scene = shaped(BlankShape::file);
  scene.blank.outline = outline_script(
      "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {-90, -60, 0, 180, 120};\nDisk(2) = {40, 10, 0, 20};\n"
      "Rectangle(3) = {-10, -60, 0, 20, 30};\nBooleanDifference{ Surface{1}; Delete; }{ Surface{2,3}; Delete; }\n");
  scene.blank.yarn_angle = 30.0;
  const double area = 180.0 * 120.0 - 20.0 * 30.0 - std::numbers::pi * 400.0;
  const Mesh mesh = build_mesh(scene, plain_weave());
  const double meshed = std::accumulate(mesh.cells.area.begin(), mesh.cells.area.end(), 0.0);
  // chords within 0.01 mm of the hole's edge leave at most that times its length
  EXPECT_NEAR(meshed, area, 0.01 * 2.0 * std::numbers::pi * 20.0);
  check_mesh(mesh, plain_weave(), meshed, "plate");
}

TEST(OutlineCad, OpenAndTiltedCurvesAreNamedByPlace) {
  Scene scene = shaped(BlankShape::file);
  const auto message = [&](const std::string& text) -> std::string {
    scene.blank.outline = outline_script(text);
    try {
      static_cast<void>(build_mesh(scene, plain_weave()));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string open =
      message("Point(1)={0,0,0};Point(2)={100,0,0};Point(3)={100,100,0};Line(1)={1,2};Line(2)={2,3};\n");
  EXPECT_NE(open.find("the outline is open at ("), std::string::npos) << open;
  const std::string tilted =
      message("Point(1)={0,0,0};Point(2)={100,0,0};Point(3)={100,100,9};Line(1)={1,2};Line(2)={2,3};Line(3)={3,1};\n");
  EXPECT_NE(tilted.find("leaves its plane"), std::string::npos) << tilted;
}

std::string complaint_about(const std::string& text) {
  const fs::path file = test::scratch_file("bad_outline.csv");
  std::ofstream(file) << text;
  std::vector<std::string> complaints;
  auto loops = read_outline_csv(file.string(), complaints);
  static_cast<void>(sound_loops(std::move(loops), file.string(), complaints));
  return complaints.empty() ? "" : complaints.front();
}

// A file that is no outline is one error, however long it is.
TEST(OutlineFile, AFileOfAnotherKindIsOneError) {
  const fs::path file = test::scratch_file("no_outline.csv");
  const auto complaints_about = [&](const std::string& text) {
    std::ofstream(file) << text;
    std::vector<std::string> complaints;
    (void)read_outline_csv(file.string(), complaints);
    return complaints;
  };
  std::string words, lonely, bytes(5000, '\x01');
  for (int k = 0; k < 3000; ++k) {
    words += "0\nSECTION\n\n";
    lonely += "1,2\n\n";
  }
  const auto no_points = complaints_about(words);
  ASSERT_EQ(no_points.size(), 1U);
  EXPECT_NE(no_points[0].find(".csv:2: 'SECTION' is not a point"), std::string::npos) << no_points[0];
  EXPECT_NE(no_points[0].find("; 5998 other lines"), std::string::npos) << no_points[0];
  const auto open = complaints_about(lonely);
  ASSERT_EQ(open.size(), 1U);
  EXPECT_NE(open[0].find("; 2999 other loops"), std::string::npos) << open[0];
  EXPECT_LT(complaints_about("x,y\n" + bytes).at(0).size(), 300U);
}

TEST(OutlineFile, TroubleIsNamedWithItsLine) {
  EXPECT_EQ(complaint_about("0,0\n10,0\n10,10\n0,0\n"), "");
  const std::string open = complaint_about("x;y\n0;0\n10;0\n10;10\n0;10\n");
  EXPECT_NE(open.find(".csv:5: the outline is open: it ends 10 mm"), std::string::npos) << open;
  const std::string text = complaint_about("0,0\n10,0\nten,10\n0,0\n");
  EXPECT_NE(text.find(".csv:3: 'ten,10' is not a point"), std::string::npos) << text;
  const std::string bow = complaint_about("0,0\n10,10\n10,0\n0,7\n0,0\n");
  EXPECT_NE(bow.find("crosses or touches"), std::string::npos) << bow;
  const std::string through = complaint_about("0,0\n10,0\n10,10\n0,10\n0,0\n\n5,5\n15,5\n15,8\n5,5\n");
  EXPECT_NE(through.find("crosses or touches"), std::string::npos) << through;
  const std::string flat = complaint_about("0,0\n5,0\n10,0\n0,0\n");
  EXPECT_NE(flat.find("no area"), std::string::npos) << flat;
  const std::string none = complaint_about("# nothing\n");
  EXPECT_NE(none.find("no outline"), std::string::npos) << none;
}

}  // namespace
}  // namespace weaveform
