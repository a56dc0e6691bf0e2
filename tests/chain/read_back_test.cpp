// Every kind of file that Weaveform writes, opened by meshio and by VTK's own python.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "mesher/mesh/mesh_io.hpp"
#include "tests/support/command_folder.hpp"

namespace {

namespace fs = std::filesystem;
using weaveform::test::tiny_scene;
using weaveform::test::write_text;

const std::string python = "/usr/bin/python3";  // Debian's, whose packages python3-meshio and python3-vtk9 are

struct Opened {
  std::string file, trouble;
  long points = 0, cells = 0;
  std::string names;  // comma before and after each
  [[nodiscard]] bool has(const std::string& name) const { return names.find("," + name + ",") != std::string::npos; }
};

class ReadBack : public weaveform::test::CommandFolder {
protected:
  [[nodiscard]] bool has_module(const std::string& module) const {
    return run(python + " -c 'import " + module + "'").exit_code == 0;
  }
  [[nodiscard]] std::map<std::string, Opened> opened(const std::string& reader,
                                                     const std::vector<std::string>& files) const {
    std::string command = python + " " + WEAVEFORM_SOURCE_DIR + "/tests/data/read_back.py " + reader;
    for (const auto& name : files) command += " " + name;
    std::istringstream out(run(command).out);
    std::map<std::string, Opened> found;
    for (std::string line; std::getline(out, line);) {
      Opened one;
      std::istringstream words(line);
      std::string what, word;
      words >> one.file >> what;
      if (what == "error") {
        std::getline(words, one.trouble);
      } else if (what == "points") {
        words >> one.points >> word >> one.cells >> word >> one.names;
        one.names = "," + one.names + ",";
      } else {
        continue;  // a reader's chatter
      }
      found[one.file] = one;
    }
    for (const auto& name : files) EXPECT_EQ(found.count(name), 1U) << reader << " " << name;
    return found;
  }
  void write_all() const {
    write_text(tiny_scene(), file("tiny.toml"));
    write_text(tiny_scene() + "[tools.floor]\nshape = \"plane\"\nposition = [0, 0, -1]\ntravel = 0.0\n",
               file("tool.toml"));
    // cells of up to six nodes; with a tool; with ties and without
    must("weaveform run tiny.toml --output cut --quiet --set blank.fit=none --set output.frames=2");
    must("weaveform run tiny.toml --output fitted --quiet --set output.frames=1");
    must("weaveform run tool.toml --output tool --quiet --set output.frames=1");
    must(
        "weaveform post virtual cut --format aramis --output lab --set instrument.facet_size=6 --set virtual.stages=1");
    must("weaveform post compare cut lab/stages --settings lab/settings.toml --output compared");
    must("weaveform export cut --format vtu --output fibres.vtu --quiet");
    must("weaveform export tiny.toml --format gmsh --output mesh.msh --quiet --set blank.fit=none");
    must("weaveform export tiny.toml --format abaqus --output shells.inp --quiet --set model.cell=shell");
    must(std::string("weaveform drape ") + WEAVEFORM_SOURCE_DIR + "/examples/drape_hemisphere.toml --output drape");
  }
  const std::vector<std::string> grids = {
      "cut/mesh.vtu", "fitted/mesh.vtu", "cut/frames/frame_0002.vtu",    "tool/mesh.vtu", "tool/frames/frame_0001.vtu",
      "fibres.vtu",   "drape/drape.vtu", "compared/stages/stage_001.vtu"};
};

TEST_F(ReadBack, MeshioOpensMeshesAndResults) {
  if (!has_module("meshio")) GTEST_SKIP() << "python3-meshio is not installed";
  write_all();
  std::vector<std::string> files = grids;
  files.insert(files.end(), {"mesh.msh", "shells.inp"});
  auto found = opened("meshio", files);
  for (const auto& name : files) EXPECT_EQ(found[name].trouble, "") << name;
  const weaveform::Mesh mesh = weaveform::read_mesh(file("cut") / "mesh.vtu");
  for (const std::string name : {"cut/mesh.vtu", "cut/frames/frame_0002.vtu"}) {
    EXPECT_EQ(found[name].points, mesh.node_count());
    EXPECT_EQ(found[name].cells, mesh.yarn_count() + mesh.cells.size());
  }
  for (const std::string name :
       {"mass_t", "set_top", "family", "area_mm2", "spacing_mm", "thickness_mm", "coefficient_per_mm"})
    EXPECT_TRUE(found["cut/mesh.vtu"].has(name)) << name;
  for (const std::string name : {"displacement_mm", "shear_angle_deg", "yarn_force_N", "warp_direction", "TimeValue"})
    EXPECT_TRUE(found["cut/frames/frame_0002.vtu"].has(name)) << name;
  for (const std::string name : {"contact_tool", "contact_pressure_MPa", "tool_floor"})
    EXPECT_TRUE(found["tool/frames/frame_0001.vtu"].has(name)) << name;
  for (const std::string name : {"section_mm2", "gmsh:physical", "warp", "top"})
    EXPECT_TRUE(found["mesh.msh"].has(name)) << found["mesh.msh"].names;
}

// Our mesh through meshio, in each of the formats that both write and read: it comes in as a foreign one.
TEST_F(ReadBack, MeshesOfMeshioComeIn) {
  if (!has_module("meshio")) GTEST_SKIP() << "python3-meshio is not installed";
  write_text(tiny_scene(), file("tiny.toml"));
  must("weaveform mesh tiny.toml --output made --quiet");
  must("weaveform export tiny.toml --format gmsh --output mesh.msh --quiet");
  must(python + " " + WEAVEFORM_SOURCE_DIR + "/tests/data/rewrite_mesh.py mesh.msh");
  const weaveform::Mesh mesh = weaveform::read_mesh(file("made") / "mesh.vtu");
  for (const std::string name : {"meshio.inp", "meshio_22.msh", "meshio_22_binary.msh"}) {
    must("weaveform import " + name + " --scene tiny.toml --output back --quiet");
    const weaveform::Mesh back = weaveform::read_mesh(file("back") / "mesh.vtu");
    EXPECT_EQ(back.yarn_count(), mesh.yarn_count()) << name;
    EXPECT_EQ(back.cells.size(), mesh.cells.size()) << name;
  }
}

TEST_F(ReadBack, VtkOpensThemAll) {
  if (!has_module("vtkmodules.vtkIOXML")) GTEST_SKIP() << "python3-vtk9 is not installed";
  write_all();
  std::vector<std::string> files = grids;
  files.emplace_back("cut/contours.vtp");
  auto found = opened("vtk", files);
  for (const auto& name : files) EXPECT_EQ(found[name].trouble, "") << name;
  EXPECT_TRUE(found["tool/frames/frame_0001.vtu"].has("contact_tool"));
  EXPECT_TRUE(found["cut/mesh.vtu"].has("coefficient_per_mm"));
}

}  // namespace
