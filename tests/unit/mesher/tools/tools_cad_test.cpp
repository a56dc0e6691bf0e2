// Tools from CAD and what is said about surfaces of triangles.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "core/error.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/tools/cad.hpp"
#include "mesher/tools/tool.hpp"
#include "mesher/tools/triangle_report.hpp"
#include "tests/support/mutations.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/temporary_folder.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;
using std::numbers::pi;

const fs::path examples = fs::path(WEAVEFORM_SOURCE_DIR) / "examples" / "cad";

class TemporaryFile {
public:
  explicit TemporaryFile(const std::string& ending, const std::string& text = "") {
    static int number = 0;
    path_ = test::scratch_file(fmt::format("cad_{}{}", number++, ending));
    if (!text.empty()) std::ofstream(path_) << text;
  }
  ~TemporaryFile() { fs::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

private:
  fs::path path_;
};

const std::string ball = "SetFactory(\"OpenCASCADE\");\nSphere(1) = {0, 0, 0, 30};\n";

TEST(Cad, ABallComesWithinTheChordToleranceAndTendsToItsVolume) {
  const TemporaryFile file(".geo", ball);
  const double volume = 4.0 / 3.0 * pi * 27000.0;
  double error_before = volume;
  for (const double tolerance : {1.0, 0.2, 0.05}) {
    const CadSurface surface = read_cad(file.path(), tolerance);
    EXPECT_LE(surface.chord_error, tolerance);
    double farthest = 0.0;  // chord error by the formula, on centres of triangles
    for (const auto& t : surface.list.triangle) {
      std::array<double, 3> c = {0, 0, 0};
      for (const int n : t)
        for (int k = 0; k < 3; ++k) c[k] += surface.list.point[n][k] / 3.0;
      farthest = std::max(farthest, 30.0 - std::hypot(c[0], c[1], c[2]));
    }
    EXPECT_LE(farthest, tolerance);
    const TriangleReport report = inspect(turned_alike(surface.list, {0, 0, 0}));
    EXPECT_TRUE(report.closed);
    EXPECT_EQ(describe_faults(report), "");
    EXPECT_LT(volume - report.volume, error_before);
    EXPECT_GT(report.volume, 0.0);
    error_before = volume - report.volume;
  }
  EXPECT_LT(error_before, 0.005 * volume);
}

TEST(Cad, TheSamePartInStepAndBrepIsTheSameSurface) {
  // 100 x 70 x 60 with upright edges rounded by 25: ((100*70 - (4 - pi) 25^2) * 60
  const double volume = (7000.0 - (4.0 - pi) * 625.0) * 60.0;
  const fs::path source = examples / "box_punch_sharp.geo";
  const TemporaryFile step(".step"), brep(".brep");
  convert_cad(source, step.path());
  convert_cad(source, brep.path());
  for (const fs::path& file : {source, step.path(), brep.path()}) {
    const TriangleReport report = inspect(turned_alike(read_cad(file, 0.05).list, {0, 0, 0}));
    EXPECT_TRUE(report.closed) << file;
    EXPECT_EQ(report.pieces, 1) << file;
    EXPECT_NEAR(report.volume, volume, 1e-3 * volume) << file;
    EXPECT_NEAR(report.extent(), 100.0, 1e-6) << file;
  }
}

TEST(Cad, AStepFileInMetresComesInMillimetres) {
  const TemporaryFile step(".step");
  convert_cad(examples / "box_punch_sharp.geo", step.path());
  std::ifstream in(step.path());
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const std::size_t at = text.find("SI_UNIT(.MILLI.,.METRE.)");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 24, "SI_UNIT($,.METRE.)");
  const TemporaryFile metres(".step", text);
  EXPECT_NEAR(inspect(read_cad(metres.path(), 1000.0).list).extent(), 100000.0, 1.0);
}

TEST(Cad, OpenSurfacesFaceTheGivenPoint) {
  const TemporaryFile file(".geo", "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 40, 30};\n");
  const TriangleList list = read_cad(file.path(), 0.1).list;
  for (const double side : {1.0, -1.0}) {
    const TriangleSurface surface(turned_alike(list, {20, 15, 5.0 * side}), "plate");
    EXPECT_NEAR(surface.distance({20, 15, 5.0 * side}).distance, 5.0, 1e-12);
    EXPECT_NEAR(surface.distance({20, 15, -5.0 * side}).distance, -5.0, 1e-12);
  }
}

// OpenCASCADE crashes on about every third of these; here that is an error like any other.
TEST(Cad, DamagedFilesEndInASurfaceOrAnError) {
  const TemporaryFile box(".geo",
                          "SetFactory(\"OpenCASCADE\");\nBox(1) = {-10, -10, 0, 20, 20, 10};\n"
                          "Fillet{1}{1:4}{2}\n");
  for (const char* ending : {".step", ".brep"}) {
    const TemporaryFile sound(ending), file(ending);
    convert_cad(box.path(), sound.path());
    const std::string bytes = test::read_text(sound.path());
    int refused = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
      test::write_text(test::damaged(bytes, seed), file.path());
      bool was_read = false;
      try {
        const TriangleList list = read_cad(file.path(), 1.0).list;
        was_read = true;
        (void)inspect(turned_alike(list, {0, 0, 1e6}));
      } catch (const InputError& error) {
        EXPECT_TRUE(was_read || std::string(error.what()).find(file.path().string()) != std::string::npos)
            << error.what();
        ++refused;
      }
    }
    EXPECT_GT(refused, 5) << ending;
  }
}

TEST(Cad, GmshSaysWhatIsWrongAndWhere) {
  const TemporaryFile file(".geo", "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1;\n");
  try {
    (void)read_cad(file.path(), 1.0);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(file.path().filename().string() + "', line 2: syntax error"),
              std::string::npos)
        << error.what();
  }
}

TEST(Cad, WrongFilesAreNamed) {
  EXPECT_THROW((void)read_cad("no_such.step", 0.1), FileError);
  const TemporaryFile empty(".step", "this is no STEP file\n"), line(".geo", "Point(1) = {0, 0, 0, 1};\n");
  EXPECT_THROW((void)read_cad(empty.path(), 0.1), InputError);
  EXPECT_THROW((void)read_cad(line.path(), 0.1), InputError);
  const TemporaryFile round(".geo", ball);
  EXPECT_THROW((void)read_cad(round.path(), 1e-9), InputError);
}

// A box of triangles, 10 mm, its corner at the origin.
TriangleList box() {
  TriangleList list;
  for (int n = 0; n < 8; ++n) list.point.push_back({10.0 * (n & 1), 10.0 * (n >> 1 & 1), 10.0 * (n >> 2 & 1)});
  for (const auto& q : {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    list.triangle.push_back({q[0], q[1], q[2]});
    list.triangle.push_back({q[0], q[2], q[3]});
  }
  return list;
}

TEST(TriangleReport, ASoundBoxHasItsVolumeAndNoFault) {
  const TriangleReport report = inspect(box());
  EXPECT_TRUE(report.closed);
  EXPECT_NEAR(report.volume, 1000.0, 1e-9);
  EXPECT_NEAR(report.area, 600.0, 1e-9);
  EXPECT_EQ(describe_faults(report), "");
  EXPECT_FALSE(turned_inward(box()));
  EXPECT_TRUE(turned_inward(turned_over(box())));
}

TEST(TriangleReport, FaultsAreFoundByPlace) {
  TriangleList open = box();
  open.triangle.pop_back();
  TriangleReport report = inspect(open);
  ASSERT_EQ(report.rims.size(), 1U);
  EXPECT_NEAR(report.rims[0].size, 20.0 + std::sqrt(200.0), 1e-9);

  // the lid's corner not quite where the walls end: a slit along two edges
  TriangleList slit = box();
  slit.point.push_back({10.0, 10.0, 10.001});
  for (auto& t : slit.triangle)
    if (t == std::array{4, 5, 7} || t == std::array{4, 7, 6})
      for (int& n : t) n = n == 7 ? 8 : n;
  report = inspect(slit);
  ASSERT_EQ(report.gaps.size(), 1U);
  EXPECT_TRUE(report.rims.empty());
  EXPECT_NE(describe_faults(report).find("a gap between faces"), std::string::npos);

  TriangleList turned = box();
  std::swap(turned.triangle[3][0], turned.triangle[3][1]);
  EXPECT_EQ(inspect(turned).turned.size(), 3U);
  EXPECT_NEAR(inspect(turned_alike(turned, {0, 0, 0})).volume, 1000.0, 1e-9);

  TriangleList sliver = box();
  sliver.point.push_back({5.0, 0.0, 0.0});
  sliver.triangle.push_back({0, 1, 8});
  report = inspect(sliver);
  ASSERT_EQ(report.degenerate.size(), 1U);
  EXPECT_NEAR(report.degenerate[0].at[0], 5.0, 1e-9);

  TriangleList crossed = box();
  for (const auto& p : {std::array{5.0, 5.0, 5.0}, {6.0, 5.0, 5.0}, {5.0, 5.0, 15.0}}) crossed.point.push_back(p);
  crossed.triangle.push_back({8, 9, 10});
  report = inspect(crossed);
  ASSERT_FALSE(report.intersections.empty());
}

std::string stl(const TriangleList& list, double unit) {
  std::string text = "solid x\n";
  for (const auto& t : list.triangle) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int n : t)
      text +=
          fmt::format("vertex {} {} {}\n", unit * list.point[n][0], unit * list.point[n][1], unit * list.point[n][2]);
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid x\n";
}

std::string cad_complaint(const fs::path& file, const std::string& more = "") {
  try {
    const Scene scene =
        read_scene_text(fmt::format("[blank]\nsize = [30, 30]\n[tools.part]\nshape = \"triangles\"\nfile = \"{}\"\n{}",
                                    file.string(), more),
                        "s.toml");
    (void)make_tools(scene, 0.5);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ToolOfTriangles, MetresAndNormalsInwardAreErrorsThatSaySo) {
  const TemporaryFile metres(".stl", stl(box(), 1e-3)), inward(".stl", stl(turned_over(box()), 1.0)),
      sound(".stl", stl(box(), 1.0));
  EXPECT_EQ(cad_complaint(sound.path()), "");
  EXPECT_NE(cad_complaint(metres.path()).find("is the file in metres? Set unit = \"m\""), std::string::npos)
      << cad_complaint(metres.path());
  EXPECT_EQ(cad_complaint(metres.path(), "unit = \"m\"\n"), "");
  EXPECT_EQ(cad_complaint(metres.path(), "unit = \"mm\"\n"), "");
  EXPECT_NE(cad_complaint(sound.path(), "unit = \"m\"\n[drape]\ntool=\"x\"\n").find("no [tools.x]"), std::string::npos);
  EXPECT_NE(cad_complaint(inward.path()).find("normals inward"), std::string::npos);
  EXPECT_EQ(cad_complaint(inward.path(), "flip = true\n"), "");
  const Scene scene = read_scene_text(
      fmt::format("[blank]\nsize = [30, 30]\n[tools.part]\nshape = \"triangles\"\nunit = \"m\"\nfile = \"{}\"\n",
                  metres.path().string()),
      "s.toml");
  EXPECT_NEAR(make_tools(scene, 0.5)[0].surface->distance({5, 5, 17}).distance, 7.0, 1e-9);
}

}  // namespace
}  // namespace weaveform
