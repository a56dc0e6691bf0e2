// Tools from any file: units, moulds in the meshes of other codes, the tolerance that the cells give, one reading a
// run.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>

#include "core/error.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/tools/gmsh_session.hpp"
#include "mesher/tools/surface_file.hpp"
#include "mesher/tools/tool.hpp"
#include "mesher/tools/triangle_report.hpp"
#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

class SurfaceFile : public testing::Test {
protected:
  fs::path file(const std::string& name, const std::string& text) {
    test::write_text(text, folder_.path() / name);
    return folder_.path() / name;
  }
  [[nodiscard]] static Scene scene(const fs::path& file, const std::string& more = "") {
    return read_scene_text(fmt::format("[blank]\nsize = [100, 100]\n[tools.mould]\nshape = \"triangles\"\nfile = "
                                       "\"{}\"\n{}",
                                       file.string(), more),
                           "s.toml");
  }

private:
  test::TemporaryFolder folder_;
};

const std::string ball_script = "SetFactory(\"OpenCASCADE\");\nSphere(1) = {0, 0, 0, 30};\n";

TEST_F(SurfaceFile, AToleranceIsOfMillimetresWhateverTheFilesUnit) {
  const FileSurface mm = read_surface(file("ball.geo", ball_script), {1.0, 0.2, ""});
  const FileSurface m = read_surface(file("small.geo", "SetFactory(\"OpenCASCADE\");\nSphere(1) = {0, 0, 0, 0.03};\n"),
                                     {1000.0, 0.2, ""});
  EXPECT_NEAR(inspect(m.list).extent(), 60.0, 0.5);
  EXPECT_LE(m.chord_error, 0.2);
  EXPECT_NEAR(static_cast<double>(m.list.triangle.size()), static_cast<double>(mm.list.triangle.size()),
              0.1 * static_cast<double>(mm.list.triangle.size()));
}

TEST_F(SurfaceFile, AUnitForAFileThatNamesItsOwnIsAnError) {
  const fs::path igs = fs::path(WEAVEFORM_SOURCE_DIR) / "tests" / "data" / "cad" / "block_inch.igs";
  EXPECT_THROW((void)read_surface(igs, {25.4, 0.1, ""}), InputError);
  EXPECT_NEAR(inspect(read_surface(igs, {1.0, 0.1, ""}).list).extent(), 40.0, 1e-6);
}

TEST_F(SurfaceFile, TheToleranceLeftOpenIsAHundredthOfACell) {
  const fs::path part = file("ball.geo", ball_script);
  const auto triangles = [](const Scene& scene, double cell) {
    return make_tools(scene, 0.5, cell).front().surface->size();
  };
  const Scene open = scene(part);
  EXPECT_LT(triangles(open, 20.0), triangles(open, 5.0));
  for (const double cell : {20.0, 5.0})
    EXPECT_EQ(triangles(open, cell),
              triangles(scene(part, fmt::format("chord_tolerance = {}\n", 0.01 * cell)), usual_cell_edge));
}

TEST_F(SurfaceFile, CadIsReadOnceForAllWhoAsk) {
  int readings = 0;
  watch_cad_reading([&](const fs::path&, double fraction) { readings += fraction == 1.0 ? 1 : 0; });
  const fs::path part = file("once.geo", ball_script + "// once\n");
  const Scene asks = scene(part);
  (void)make_tools(asks, 0.5);
  (void)make_tools(asks, 0.5);
  (void)make_tools(asks, 0.7);
  EXPECT_EQ(readings, 1);
  (void)make_tools(asks, 0.5, 2.0 * usual_cell_edge);
  EXPECT_EQ(readings, 2) << "another tolerance is another surface";
  test::write_text("SetFactory(\"OpenCASCADE\");\nSphere(1) = {0, 0, 0, 20};\n", part);
  EXPECT_NEAR(make_tools(asks, 0.5).front().surface->distance({0, 0, 50}).distance, 30.0, 0.1);
  EXPECT_EQ(readings, 3) << "another content is another surface";
  watch_cad_reading({});
}

// A tent over 0.6 m x 0.4 m, its ridge 0.1 m high, as Abaqus/CAE writes a discrete rigid part.
std::string mould(const std::string& end, const std::string& instance = "") {
  std::string text =
      "*Heading\n*Part, name=MOULD\n*Node\n1, -0.3, -0.2, 0.\n2, 0., -0.2, 0.1\n3, 0.3, -0.2, 0.\n"
      "4, -0.3, 0.2, 0.\n5, 0., 0.2, 0.1\n6, 0.3, 0.2, 0.\n*Element, type=R3D4\n1, 1, 4, 5, 2\n"
      "*Element, type=R3D3\n2, 2, 5, 6\n3, 2, 6, 3\n*Node\n7, 0., 0., 0.\n*Nset, nset=RP, internal\n7,\n*End Part\n"
      "*Assembly, name=Assembly\n*Instance, name=MOULD-1, part=MOULD\n" +
      instance + "*End Instance\n*End Assembly\n";
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += end.size()) text.replace(at, 1, end);
  return text;
}

TEST_F(SurfaceFile, ShellsOfAnAbaqusPartAreATool) {
  for (const char* end : {"\n", "\r\n"})
    for (const char* name : {"mould.inp", "mould.INP"}) {
      const FileSurface surface = read_surface(file(name, mould(end)), {1000.0, 0.05, ""});
      const TriangleReport report = inspect(surface.list);
      EXPECT_EQ(report.triangles, 4);
      EXPECT_NEAR(report.high[0] - report.low[0], 600.0, 1e-9);
      EXPECT_NEAR(report.high[2], 100.0, 1e-9);
      EXPECT_NEAR(report.area, 2.0 * 400.0 * std::hypot(300.0, 100.0), 1e-6);
    }
}

TEST_F(SurfaceFile, AnInstanceStandsWhereTheAssemblyPutsIt) {
  const FileSurface moved = read_surface(file("moved.inp", mould("\n", "0.1, 0., 0.05\n")), {1000.0, 0.05, ""});
  EXPECT_NEAR(inspect(moved.list).low[0], -200.0, 1e-9);
  EXPECT_NEAR(inspect(moved.list).high[2], 150.0, 1e-9);
  // a quarter turn about z after it
  const FileSurface turned =
      read_surface(file("turned.inp", mould("\n", "0., 0., 0.\n0., 0., 0., 0., 0., 1., 90.\n")), {1000.0, 0.05, ""});
  EXPECT_NEAR(inspect(turned.list).high[1], 300.0, 1e-9);
  EXPECT_NEAR(inspect(turned.list).high[0], 200.0, 1e-9);
}

TEST_F(SurfaceFile, TheToolsNameChoosesAmongInstances) {
  std::string two = mould("\n");
  two.insert(two.find("*End Assembly"), "*Instance, name=PUNCH, part=MOULD\n0., 0., 1.\n*End Instance\n");
  const fs::path both = file("two.inp", two);
  EXPECT_EQ(inspect(read_surface(both, {1.0, 0.05, ""}).list).triangles, 8);
  const TriangleReport punch = inspect(read_surface(both, {1.0, 0.05, "punch"}).list);
  EXPECT_EQ(punch.triangles, 4);
  EXPECT_NEAR(punch.low[2], 1.0, 1e-12);
}

// The mould's shells turn as they happen to; its open side is where the blank comes from.
TEST_F(SurfaceFile, AMouldFacesTheSideThatTheBlankIsDrapedFrom) {
  const Scene above = scene(file("mould.inp", mould("\n")), "unit = \"m\"\n[drape]\ntool = \"mould\"\n");
  EXPECT_NEAR(make_tools(above, 0.5).front().surface->distance({0, 0, 130}).distance, 30.0, 1e-9);
  const Scene below =
      scene(file("mould.inp", mould("\n")), "unit = \"m\"\n[drape]\ntool = \"mould\"\nprojection = [0, 0, 1]\n");
  EXPECT_LT(make_tools(below, 0.5).front().surface->distance({0, 0, 130}).distance, 0.0);
}

TEST_F(SurfaceFile, AMeshWithoutShellsIsNoTool) {
  EXPECT_THROW(
      (void)read_surface(file("none.inp", "*Node\n1, 0., 0., 0.\n2, 1., 0., 0.\n*Element, type=T3D2\n1, 1, 2\n"),
                         {1.0, 0.05, ""}),
      InputError);
}

}  // namespace
}  // namespace weaveform
