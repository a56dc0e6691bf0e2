// CAD as other people's programs write it: IGES in every unit, tips, fillets, mesh options in scripts, damage.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "mesher/outline/cad_outline.hpp"
#include "mesher/tools/cad.hpp"
#include "mesher/tools/triangle_report.hpp"
#include "tests/support/mutations.hpp"
#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;
using std::numbers::pi;

const fs::path data = fs::path(WEAVEFORM_SOURCE_DIR) / "tests" / "data" / "cad";
const std::string opencascade = "SetFactory(\"OpenCASCADE\");\n";

class StrangersCad : public testing::Test {
protected:
  fs::path file(const std::string& name, const std::string& text) {
    test::write_text(text, folder_.path() / name);
    return folder_.path() / name;
  }
  [[nodiscard]] fs::path place(const std::string& name) const { return folder_.path() / name; }

private:
  test::TemporaryFolder folder_;
};

struct Looked {
  CadSurface surface;
  TriangleReport report;
};
Looked look(const fs::path& file, double tolerance) {
  Looked looked{read_cad(file, tolerance), {}};
  looked.report = inspect(turned_alike(looked.surface.list, {0, 0, 1e6}));
  EXPECT_LE(looked.surface.chord_error, tolerance) << file;
  return looked;
}

void expect_size(const TriangleReport& report, const std::array<double, 3>& size, double within) {
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(report.high[c] - report.low[c], size[c], within) << "along " << c;
}

std::string stranger_complaint(const fs::path& file, double tolerance = 0.05) {
  try {
    (void)read_cad(file, tolerance);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// IGES in fixed columns: 72 of text, a letter for the section, a number.
std::string iges_line(const std::string& text, char section, int number) {
  return fmt::format("{:<72}{}{:>7}\n", text, section, number);
}

// One bilinear patch over 100 x 60 units whose far corner is raised by 10.
std::string iges_patch(int unit, const std::string& name) {
  const auto fields = [](std::initializer_list<int> values) {
    std::string text;
    for (const int v : values) text += fmt::format("{:>8}", v);
    return text;
  };
  std::string text = iges_line("own patch", 'S', 1);
  text += iges_line("1H,,1H;,5Hpatch,9Hpatch.igs,3Hown,3Hown,32,38,6,308,15,5Hpatch,1.0,", 'G', 1);
  text += iges_line(
      fmt::format("{},{}H{},1,0.01,15H20260101.000000,0.0001,100.0,3Hown,3Hown,11,0,", unit, name.size(), name), 'G',
      2);
  text += iges_line("15H20260101.000000;", 'G', 3);
  text += iges_line(fields({128, 1, 0, 0, 0, 0, 0, 0}) + "00000000", 'D', 1);
  text += iges_line(fields({128, 0, 0, 2, 0}), 'D', 2);
  const auto parameters = [](const std::string& values) { return fmt::format("{:<64}{:>8}", values, 1); };
  text += iges_line(parameters("128,1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,"), 'P', 1);
  text += iges_line(parameters("0.,100.,0.,0.,0.,60.,0.,100.,60.,10.,0.,1.,0.,1.;"), 'P', 2);
  return text + iges_line("S      1G      3D      2P      2", 'T', 1);
}

TEST_F(StrangersCad, AnIgesPatchHasItsSizeInMillimetresWhateverItsUnit) {
  struct Unit {
    int flag;
    const char* name;
    double millimetres;
  };
  for (const Unit& unit :
       {Unit{2, "MM", 1.0}, {1, "INCH", 25.4}, {6, "M", 1000.0}, {10, "CM", 10.0}, {4, "FT", 304.8}}) {
    const double mm = unit.millimetres;
    const Looked looked = look(file("patch.igs", iges_patch(unit.flag, unit.name)), 0.05 * mm);
    expect_size(looked.report, {100.0 * mm, 60.0 * mm, 10.0 * mm}, 1e-6 * mm);
    // integral of sqrt(6000^2 + (600 v)^2 + (1000 u)^2) over the unit square
    EXPECT_NEAR(looked.report.area, 6037.6 * mm * mm, 2e-4 * 6037.6 * mm * mm) << unit.name;
  }
}

// IGES knows no solids in most programs: faces lie side by side, each with borders of its own.
TEST_F(StrangersCad, AnIgesSolidIsClosedInInchesAsInMillimetres) {
  for (const char* name : {"block_mm.igs", "block_inch.igs"}) {
    const Looked looked = look(data / name, 0.02);
    EXPECT_TRUE(looked.report.closed) << name;
    EXPECT_EQ(looked.report.pieces, 1) << name;
    expect_size(looked.report, {40.0, 30.0, 20.0}, 1e-6);
    EXPECT_NEAR(looked.report.volume, 20.0 * (1200.0 - pi * 36.0), 10.0) << name;
    EXPECT_EQ(describe_faults(looked.report), "") << name;
  }
}

TEST_F(StrangersCad, AnIgesFaceInMetresIsAnOutlineInMillimetresInAnyCaseOfItsEnding) {
  for (const char* ending : {".igs", ".IGS", ".Iges"}) {
    const fs::path copy = place(std::string("plate") + ending);
    fs::copy_file(data / "plate_metre.igs", copy);
    std::vector<std::string> complaints;
    auto loops = read_cad_outline(copy.string(), 0.01, complaints);
    EXPECT_TRUE(complaints.empty());
    ASSERT_EQ(loops.size(), 2U) << ending;
    std::sort(loops.begin(), loops.end(), [](const auto& a, const auto& b) { return a.point.size() < b.point.size(); });
    double area = 0.0, farthest = 0.0;
    for (std::size_t k = 0; k < loops[0].point.size(); ++k) {
      const auto &a = loops[0].point[k], &b = loops[0].point[(k + 1) % loops[0].point.size()];
      area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    for (const auto& p : loops[1].point) farthest = std::max(farthest, std::abs(std::hypot(p[0] - 20.0, p[1]) - 15.0));
    EXPECT_NEAR(std::abs(area), 120.0 * 80.0, 1e-6);
    EXPECT_LT(farthest, 1e-6) << "the hole's points lie on its circle";
  }
}

// Two faces that share a border and do not know it: the fabric goes on across.
TEST_F(StrangersCad, ASeamBetweenFacesIsNoOutline) {
  std::vector<std::string> complaints;
  const fs::path two =
      file("two.geo", opencascade + "Rectangle(1) = {0, 0, 0, 40, 30};\nRectangle(2) = {40, 0, 0, 20, 30};\n");
  convert_cad(two, place("two.step"));
  const auto loops = read_cad_outline(place("two.step").string(), 0.01, complaints);
  ASSERT_EQ(loops.size(), 1U);
  EXPECT_EQ(loops[0].point.size(), 6U);
}

TEST_F(StrangersCad, EndingsAreTakenInAnyCaseOfLetters) {
  const fs::path box = file("box.geo", opencascade + "Box(1) = {0, 0, 0, 30, 20, 10};\n");
  for (const char* ending : {".Stp", ".STEP", ".BREP", ".Brep", ".sTp"}) {
    convert_cad(box, place(std::string("copy") + ending));
    EXPECT_NEAR(look(place(std::string("copy") + ending), 0.1).report.volume, 6000.0, 1e-6) << ending;
  }
}

TEST_F(StrangersCad, AnIgesSolidWrittenAsStepIsTheSameSolid) {
  convert_cad(data / "block_inch.igs", place("block.step"));
  const Looked looked = look(place("block.step"), 0.02);
  EXPECT_TRUE(looked.report.closed);
  EXPECT_NEAR(looked.report.volume, 20.0 * (1200.0 - pi * 36.0), 10.0);
}

// Curvature has no bound at a tip, nor where a control point nearly meets its end.
TEST_F(StrangersCad, ATipHasTheVolumeThatItsFormulaSays) {
  const Looked drill =
      look(file("drill.geo", opencascade + "Box(1) = {0, 0, 0, 40, 40, 30};\n"
                                           "Cylinder(2) = {20, 20, 12, 0, 0, 18, 4};\n"
                                           "Cone(3) = {20, 20, 9.6, 0, 0, 2.4, 0, 4, 2*Pi};\n"
                                           "BooleanDifference(4) = {Volume{1}; Delete;}{Volume{2,3}; Delete;};\n"),
           0.05);
  EXPECT_TRUE(drill.report.closed);
  EXPECT_NEAR(drill.report.volume, 48000.0 - pi * 16.0 * 18.0 - pi * 16.0 * 2.4 / 3.0, 12.0);
  EXPECT_EQ(describe_faults(drill.report), "");
  const Looked cone = look(file("cone.geo", opencascade + "Cone(1) = {0, 0, 0, 0, 0, 50, 30, 0, 2*Pi};\n"), 0.05);
  EXPECT_TRUE(cone.report.closed);
  EXPECT_NEAR(cone.report.volume, pi * 900.0 * 50.0 / 3.0, 150.0);
  const Looked blunt =
      look(file("blunt.geo", opencascade + "Point(1) = {0, 0, 0}; Point(2) = {1e-7, 0, 0};\n"
                                           "Point(3) = {0, 0, -30}; Point(4) = {40, 0, -50};\n"
                                           "Bezier(1) = {1, 2, 3, 4};\nExtrude {0, 40, 0} {Curve{1};}\n"),
           0.05);
  expect_size(blunt.report, {40.0, 40.0, 50.0}, 1e-6);
}

TEST_F(StrangersCad, SidesAreSizedByTheSagittaAlone) {
  EXPECT_EQ(look(file("box.geo", opencascade + "Box(1) = {0, 0, 0, 120, 60, 25};\n"), 0.05).report.triangles, 12);
  const Looked filleted =
      look(file("block.geo", opencascade + "Box(1) = {0, 0, 0, 120, 60, 25};\nFillet{1}{1:12}{1.0}\n"), 0.05);
  EXPECT_LT(filleted.report.triangles, 2000);
  EXPECT_TRUE(filleted.report.closed);
  // 12 edges lose (1 - pi/4) each along what is between the corners, 8 corners lose 1 - pi/6
  const double volume = 180000.0 - (1.0 - pi / 4.0) * 4.0 * (118.0 + 58.0 + 23.0) - 8.0 * (1.0 - pi / 6.0);
  EXPECT_NEAR(filleted.report.volume, volume, 30.0);
  const Looked finer = look(place("block.geo"), 0.0125);
  EXPECT_LT(finer.report.triangles, 4 * filleted.report.triangles) << "chords along a fillet stay as long as it is";
}

TEST_F(StrangersCad, AHoleSmallerThanTheToleranceStaysAHole) {
  const Looked looked =
      look(file("pin.geo", opencascade + "Box(1) = {0, 0, 0, 30, 30, 5};\nCylinder(2) = {15, 15, -1, 0, 0, 9, "
                                         "0.2};\nBooleanDifference(3) = {Volume{1}; Delete;}{Volume{2}; Delete;};\n"),
           0.5);
  EXPECT_TRUE(looked.report.closed);
  EXPECT_LT(looked.report.volume, 4500.0 - 0.3);
}

// Scripts of others nearly always say how they are to be meshed; here that is nobody's business.
TEST_F(StrangersCad, MeshOptionsOfAScriptChangeNoGeometry) {
  const Looked box =
      look(file("part.geo", opencascade + "Box(1) = {0, 0, 0, 100, 60, 20};\nRecombine Surface{6};\n"), 0.05);
  EXPECT_TRUE(box.report.closed);
  EXPECT_NEAR(box.report.area, 18400.0, 1e-6);
  for (const char* options :
       {"Recombine Surface{:};\n", "Mesh.ElementOrder = 2;\n", "Mesh.RecombineAll = 1;\nMesh 2;\n",
        "Mesh.MeshSizeMax = 30;\nMesh.SubdivisionAlgorithm = 1;\n"}) {
    const Looked dome =
        look(file("dome.geo", opencascade + "Sphere(1) = {0, 0, 0, 75, 0, Pi/2, 2*Pi};\n" + options), 0.1);
    EXPECT_TRUE(dome.report.closed) << options;
    expect_size(dome.report, {150.0, 150.0, 75.0}, 0.2);
  }
}

// Gmsh's own kernel is meshed by Gmsh, whose transfinite lines and recombined faces cannot be undone: they are refined.
TEST_F(StrangersCad, FacesOfGmshsOwnKernelComeWithinTheToleranceWithAnyMeshOptions) {
  const std::string dome =
      "R = 40;\nPoint(1) = {0,0,0}; Point(2) = {R,0,0}; Point(3) = {0,R,0}; Point(4) = {-R,0,0};\n"
      "Point(5) = {0,-R,0}; Point(6) = {0,0,R};\n"
      "Circle(1) = {2,1,3}; Circle(2) = {3,1,4}; Circle(3) = {4,1,5}; Circle(4) = {5,1,2};\n"
      "Circle(5) = {2,1,6}; Circle(6) = {3,1,6}; Circle(7) = {4,1,6}; Circle(8) = {5,1,6};\n"
      "Curve Loop(1) = {1,6,-5}; Surface(1) = {1}; Curve Loop(2) = {2,7,-6}; Surface(2) = {2};\n"
      "Curve Loop(3) = {3,8,-7}; Surface(3) = {3}; Curve Loop(4) = {4,5,-8}; Surface(4) = {4};\n"
      "Curve Loop(5) = {1,2,3,4}; Plane Surface(5) = {5};\n";
  for (const char* options :
       {"", "Transfinite Curve {1:8} = 4;\n", "Recombine Surface{1:5};\nMesh.ElementOrder = 2;\n"}) {
    const Looked looked = look(file("dome.geo", dome + options), 0.2);
    EXPECT_TRUE(looked.report.closed) << options;
    expect_size(looked.report, {80.0, 80.0, 40.0}, 1e-6);
    const double volume = 2.0 / 3.0 * pi * 64000.0;
    EXPECT_NEAR(looked.report.volume, volume, 0.01 * volume) << options;
    EXPECT_LT(looked.report.triangles, 20000) << options;
  }
}

TEST_F(StrangersCad, TheReadersOwnWordsComeWithTheLine) {
  const std::string unknown =
      stranger_complaint(file("newer.geo", opencascade + "c = newcl;\nRectangle(1) = {0, 0, 0, 1, 1};\n"));
  EXPECT_NE(unknown.find("line 2: Unknown variable 'newcl'"), std::string::npos) << unknown;

  convert_cad(file("box.geo", opencascade + "Box(1) = {0, 0, 0, 30, 20, 10};\n"), place("box.step"));
  std::string step = test::read_text(place("box.step"));
  const std::size_t at = step.find("CARTESIAN_POINT('',(");
  ASSERT_NE(at, std::string::npos);
  step.replace(at, 20, "CARTESIAN_POINT('',((");
  // a statement is found wanting where it ends, on the line after
  const auto line = std::count(step.begin(), step.begin() + static_cast<long>(at), '\n') + 2;
  const std::string broken = stranger_complaint(file("broken.step", step));
  EXPECT_NE(broken.find(fmt::format("Line {}: Incorrect syntax", line)), std::string::npos) << line << ": " << broken;

  std::string iges = iges_patch(2, "MM");
  iges.replace(iges.find("     128"), 8, "     999");
  const std::string undefined = stranger_complaint(file("undefined.igs", iges));
  EXPECT_NE(undefined.find("entity type"), std::string::npos) << undefined;
}

TEST_F(StrangersCad, DamagedIgesEndsInASurfaceOrAnError) {
  const std::string sound = test::read_text(data / "block_mm.igs");
  int read = 0, refused = 0;
  for (unsigned seed = 0; seed < 30; ++seed) {
    try {
      (void)inspect(read_cad(file("damaged.igs", test::damaged(sound, seed)), 0.5).list);
      ++read;
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(read, 3);
  EXPECT_GT(refused, 1);
}

TEST_F(StrangersCad, AToleranceBeyondReasonIsRefusedAtOnce) {
  EXPECT_NE(stranger_complaint(file("ball.geo", opencascade + "Sphere(1) = {0, 0, 0, 30};\n"), 1e-6).find("too fine"),
            std::string::npos);
}

}  // namespace
}  // namespace weaveform
