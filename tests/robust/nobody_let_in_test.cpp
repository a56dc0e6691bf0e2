// Input that may come from anybody: it runs no program, writes no file, and takes the program down in no way.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "tests/support/command_folder.hpp"

namespace {

namespace fs = std::filesystem;
using weaveform::test::CommandResult;
using weaveform::test::read_text;
using weaveform::test::says;
using weaveform::test::tiny_scene;
using weaveform::test::write_text;

class NobodyLetIn : public weaveform::test::CommandFolder {
protected:
  void write(const std::string& name, const std::string& text) const { write_text(text, file(name)); }

  // In a file, the first `old` after `from` becomes `fresh`.
  void replace(const std::string& name, const std::string& from, const std::string& old,
               const std::string& fresh) const {
    std::string text = read_text(file(name));
    const std::size_t begin = text.find(from), at = begin == std::string::npos ? begin : text.find(old, begin);
    ASSERT_NE(at, std::string::npos) << name << ": no " << old << " after " << from;
    write(name, text.replace(at, old.size(), fresh));
  }

  // An error of ours that says which file.
  void expect_refused(const std::string& command, const std::string& name) const {
    const CommandResult result = run(command);
    EXPECT_TRUE(result.exit_code == 2 || result.exit_code == 4) << command << ": " << result.exit_code << result.err;
    EXPECT_TRUE(says(result, "error: ") && says(result, name)) << command << ": " << result.err;
  }
};

const std::string scene_of_a_file =
    "[blank]\nshape = \"file\"\noutline = \"blank.geo\"\nyarn_angle = 0\ncoarsening = 4\n"
    "[analysis]\ngravity = [0, 0, -9810]\nduration = 1e-4\n";
const std::string square = "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {-50, -50, 0, 100, 100};\n";

TEST_F(NobodyLetIn, AScriptRunsNoProgramUnlessItIsTrusted) {
  write("scene.toml", scene_of_a_file);
  write("blank.geo", "SystemCall \"touch entered\";\n" + square);
  for (const char* command : {"check scene.toml", "mesh scene.toml -o out", "mesh --plan scene.toml",
                              "run scene.toml -o out", "tool blank.geo", "export scene.toml --format gmsh -o x.msh"}) {
    const CommandResult result = run(std::string("weaveform ") + command);
    EXPECT_EQ(result.exit_code, 2) << command << result.err;
    EXPECT_TRUE(says(result, "blank.geo:1:1: 'SystemCall'")) << command << result.err;
    EXPECT_TRUE(says(result, "--trust-geo")) << command << result.err;
    EXPECT_FALSE(fs::exists(file("entered"))) << command;
  }
  EXPECT_EQ(run("weaveform check scene.toml --trust-geo").exit_code, 0);
  EXPECT_TRUE(fs::exists(file("entered")));
}

TEST_F(NobodyLetIn, NothingBesideAPartIsReadAndNothingUnderAnotherName) {
  write("blank.geo", square);
  write("blank.geo.opt", "SystemCall \"touch entered\";\n");
  EXPECT_EQ(run("weaveform tool blank.geo -o part.step").exit_code, 0);
  write("part.step.opt", "SystemCall \"touch entered\";\n");
  EXPECT_EQ(run("weaveform tool part.step").exit_code, 0);
  for (const char* name : {"a.step", "a.Step", "a.STP", "a.iges", "a.Igs", "a.brep", "a.BREP"}) {
    write(name, "SystemCall \"touch entered\";\n" + square);
    expect_refused(std::string("weaveform tool ") + name, name);
  }
  write("b.GEO", "SystemCall \"touch entered\";\n" + square);
  expect_refused("weaveform tool b.GEO", "b.GEO:1:1");
  EXPECT_FALSE(fs::exists(file("entered")));
}

TEST_F(NobodyLetIn, AConvertedPartIsTheOnlyFileWritten) {
  write("blank.geo", square);
  EXPECT_EQ(run("weaveform tool blank.geo -o part.step && weaveform tool part.step -o part.brep").exit_code, 0);
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(file(""))) names.insert(entry.path().filename());
  EXPECT_EQ(names, (std::set<std::string>{"blank.geo", "part.brep", "part.step", "tiny.toml"}));
  const CommandResult back = run("weaveform tool part.brep");
  EXPECT_EQ(back.exit_code, 0) << back.err;
  EXPECT_NE(back.out.find("100 x 100 x 0 mm"), std::string::npos) << back.out;
}

TEST_F(NobodyLetIn, DamagedMeshesFramesAndIndicesAreErrors) {
  write("tiny.toml", tiny_scene());
  ASSERT_EQ(run("weaveform run tiny.toml -o r -q").exit_code, 0);
  const auto fresh = [&] {
    fs::remove_all(file("d"));
    fs::copy(file("r"), file("d"), fs::copy_options::recursive);
  };
  const struct {
    const char *name, *from, *old, *fresh, *command;
  } damages[] = {
      {"d/frames/frame_0004.vtu", "TimeValue", "NumberOfTuples=\"1\"", "NumberOfTuples=\"999999999\"", "post d"},
      {"d/frames/frame_0004.vtu", "<Piece", "NumberOfPoints=\"", "NumberOfPoints=\"9999999", "post d"},
      {"d/frames/frame_0004.vtu", "<Piece", "NumberOfCells=\"", "NumberOfCells=\"-", "post d"},
      {"d/frames/frame_0004.vtu", "<Points", "Float64", "Float65", "post d"},
      {"d/mesh.vtu", "<PointData", "NumberOfComponents=\"2\"", "NumberOfComponents=\"2000000000\"", "solve d"},
      {"d/mesh.vtu", "<CellData", "type=\"Float64\"", "type=\"Floot64\"", "solve d"},
      {"d/mesh.vtu", "<Cells", "type=\"Int64\"", "type=\"UInt8\"", "solve d"},
      {"d/mesh.vtu", "<Points", "AQAAAA", "/////w", "solve d"},  // the number of compressed blocks
      {"d/result.pvd", "<DataSet", "file=\"frames", "file=\"../../frames", "post d"},
      {"d/result.pvd", "<DataSet", "timestep=\"0", "timestep=\"nan", "post d"},
  };
  for (const auto& damage : damages) {
    fresh();
    replace(damage.name, damage.from, damage.old, damage.fresh);
    expect_refused(std::string("weaveform ") + damage.command, damage.name);
  }
  fresh();
  fs::copy_file(file("d/mesh.vtu"), file("d/frames/frame_0004.vtu"), fs::copy_options::overwrite_existing);
  EXPECT_EQ(run("weaveform post d").exit_code, 0) << "the mesh has the nodes of a frame";
  ASSERT_EQ(run("weaveform run tiny.toml -o other -q --set blank.coarsening=5").exit_code, 0);
  fs::copy_file(file("other/frames/frame_0004.vtu"), file("d/frames/frame_0004.vtu"),
                fs::copy_options::overwrite_existing);
  expect_refused("weaveform post d", "frame_0004.vtu");
}

TEST_F(NobodyLetIn, AForeignGridWhoseCellsNameNoPointIsAnError) {
  write("tiny.toml", tiny_scene());
  ASSERT_EQ(run("weaveform run tiny.toml -o r -q").exit_code, 0);
  for (const std::string node : {"3", "-1", "2000000000", "99999999999999999999"})
    for (const std::string offset : {"4", "1000000", "-4"}) {
      write("x.vtu",
            "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
            "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\">\n<Points><DataArray type=\"Float64\" "
            "NumberOfComponents=\"3\" format=\"ascii\">-50 -50 0 50 -50 0 50 50 0 -50 50 0</DataArray></Points>\n"
            "<Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 " +
                node + "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" + offset +
                "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">9</DataArray></Cells>\n"
                "</Piece></UnstructuredGrid></VTKFile>\n");
      if (node == "3" && offset == "4")
        EXPECT_EQ(run("weaveform export r --format csv -o x.csv --onto x.vtu").exit_code, 0);
      else
        expect_refused("weaveform export r --format csv -o y.csv --onto x.vtu", "x.vtu");
    }
}

TEST_F(NobodyLetIn, NumbersBeyondAllMeasureAreRefusedBeforeTheyAreUsed) {
  const std::string scene = tiny_scene() +
                            "[tools.dome]\nshape = \"revolved\"\nposition = [0, 0, -90]\n"
                            "profile = [[300, 0], [88.741196, 0], [73.950997, 12.5, 88.741196, 15], [0, 75, 0, 0]]\n";
  write("s.toml", scene);
  ASSERT_EQ(run("weaveform check s.toml").exit_code, 0);
  for (const char* huge : {"1e308", "-1e300", "1e200", "2e6"}) {
    const std::string x = huge;
    for (const std::string& set :
         {"tools.dome.profile=[[300,0],[88.741196,0],[73.950997,12.5,88.741196,15],[0,75," + x + ",0]]",
          "tools.dome.profile=[[300," + x + "],[88,0],[0,75]]", "tools.dome.position=[0,0," + x + "]",
          "tools.dome.travel=" + x, "blank.size=[100," + x + "]", "grip.top.travel=" + x,
          "blank.position=[" + x + ",0,0]"})
      EXPECT_EQ(run("weaveform check s.toml --set '" + set + "'").exit_code, 2) << set;
  }
}

TEST_F(NobodyLetIn, NestingWithoutEndIsAnError) {
  const std::string deep(1000000, '[');
  write("deep.toml", "[blank]\nsize = " + deep + "\n");
  expect_refused("weaveform check deep.toml", "deep.toml");
  std::string tables = "a = ";
  for (int k = 0; k < 200000; ++k) tables += "{a=";
  write("tables.toml", tables + "\n");
  expect_refused("weaveform check tables.toml", "tables.toml");
  write("tiny.toml", tiny_scene());
  ASSERT_EQ(run("weaveform run tiny.toml -o r -q").exit_code, 0);
  write("r/solve.json", deep);
  expect_refused("weaveform post r", "solve.json");
  write("r/solve.json", "{\"steps\": " + deep + std::string(deep.size(), ']') + "}");
  expect_refused("weaveform post r", "solve.json");
}

TEST_F(NobodyLetIn, ASurfaceWithACornerNowhereIsRefusedByFacet) {
  for (const char* corner : {"nan 0 0", "0 1e308 0", "inf 0 0"}) {
    write("t.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 10 0 0\nvertex " +
                       std::string(corner) + "\nendloop\nendfacet\nendsolid x\n");
    const CommandResult result = run("weaveform tool t.stl");
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_TRUE(says(result, "t.stl:6: facet 1 has a corner at")) << result.err;
  }
}

}  // namespace
