// .vtu files of every encoding, sound and damaged: a grid that holds together or an error, never a crash.
#include "mesher/mesh/vtu_grid.hpp"

#include <gtest/gtest.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <chrono>
#include <cmath>
#include <functional>

#include "core/error.hpp"
#include "mesher/lattice/build.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "mesher/mesh/vtk_file.hpp"
#include "mesher/scene/reader.hpp"
#include "tests/support/mutations.hpp"
#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

enum class Encoding { ascii, base64, compressed, appended_raw, appended_compressed };
constexpr Encoding encodings[] = {Encoding::ascii, Encoding::base64, Encoding::compressed, Encoding::appended_raw,
                                  Encoding::appended_compressed};

// Two squares side by side, one triangle on top; thirds at the points, which no decimal text has.
void write_foreign(const fs::path& file, Encoding encoding) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int k = 0; k < 6; ++k) points->InsertNextPoint(k % 3 / 3.0, k < 3 ? 0.0 : 1.0, 0.0);
  points->InsertNextPoint(0.5, 2.0, 0.0);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  const vtkIdType cells[3][4] = {{0, 1, 4, 3}, {1, 2, 5, 4}, {3, 4, 6, 0}};
  grid->InsertNextCell(VTK_QUAD, 4, cells[0]);
  grid->InsertNextCell(VTK_QUAD, 4, cells[1]);
  grid->InsertNextCell(VTK_TRIANGLE, 3, cells[2]);
  vtkNew<vtkDoubleArray> third;
  third->SetName("third");
  for (int k = 0; k < 7; ++k) third->InsertNextValue(k / 3.0);
  grid->GetPointData()->AddArray(third);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(grid);
  if (encoding == Encoding::ascii) writer->SetDataModeToAscii();
  if (encoding == Encoding::base64 || encoding == Encoding::compressed) writer->SetDataModeToBinary();
  if (encoding == Encoding::appended_raw || encoding == Encoding::appended_compressed) {
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
  }
  if (encoding == Encoding::compressed || encoding == Encoding::appended_compressed)
    writer->SetCompressorTypeToZLib();
  else
    writer->SetCompressorTypeToNone();
  ASSERT_EQ(writer->Write(), 1);
}

TEST(VtuGrid, EveryEncodingReadsTheSame) {
  const test::TemporaryFolder folder;
  keep_vtk_in_one_thread();
  for (const Encoding encoding : encodings) {
    write_foreign(folder.path() / "x.vtu", encoding);
    const VtuGrid grid = read_vtu(folder.path() / "x.vtu", std::nullopt, "mend it");
    ASSERT_EQ(grid.point.size(), 7U);
    EXPECT_TRUE(grid.double_precision);
    EXPECT_EQ(grid.type, (std::vector<std::uint8_t>{VTK_QUAD, VTK_QUAD, VTK_TRIANGLE}));
    EXPECT_EQ(grid.offset, (std::vector<std::int64_t>{0, 4, 8, 11}));
    EXPECT_EQ(grid.node, (std::vector<std::int64_t>{0, 1, 4, 3, 1, 2, 5, 4, 3, 4, 6}));
    const VtuArray* third = find_array(grid.point_data, "third");
    ASSERT_TRUE(third != nullptr && third->holds<double>());
    for (std::size_t k = 0; k < 7; ++k) {
      if (encoding != Encoding::ascii) {
        EXPECT_EQ(third->at<double>(k), static_cast<double>(k) / 3.0);
      }
      EXPECT_NEAR(third->as_double(k), static_cast<double>(k) / 3.0, 1e-9);
    }
    EXPECT_TRUE(read_vtu(folder.path() / "x.vtu", std::vector<std::string>{}, "").point_data.empty());
  }
}

// How many of the damaged variants were read all the same.
int survive(const fs::path& file, unsigned variants, const std::function<void()>& read) {
  const std::string sound = test::read_text(file);
  int whole = 0;
  for (unsigned seed = 0; seed < variants; ++seed) {
    test::write_text(test::damaged(sound, seed), file);
    try {
      read();
      ++whole;
    } catch (const InputError&) {
    } catch (const FileError&) {
    }
  }
  test::write_text(sound, file);
  return whole;
}

TEST(VtuGrid, DamagedForeignFilesEndInAGridThatHoldsTogetherOrAnError) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "x.vtu";
  for (const Encoding encoding : encodings) {
    write_foreign(file, encoding);
    const auto begin = std::chrono::steady_clock::now();
    survive(file, 60, [&] {
      const VtuGrid grid = read_vtu(file, std::nullopt, "");
      for (const std::int64_t n : grid.node) ASSERT_TRUE(n >= 0 && n < std::ssize(grid.point));
      for (const VtuArray& array : grid.point_data) ASSERT_EQ(array.tuples, grid.point.size());
    });
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60));
  }
}

TEST(VtuGrid, DamagedMeshesEndInASoundMeshOrAnError) {
  const test::TemporaryFolder folder;
  const Scene scene = read_scene_text(test::tiny_scene(), "tiny.toml");
  const fs::path file = folder.path() / "mesh.vtu";
  write_mesh(build_mesh(scene, load_card(scene.fabric.material, scene.file)), file);
  survive(file, 150, [&] {
    const Mesh mesh = read_mesh(file);
    for (const auto& position : mesh.nodes.position)
      for (const double x : position) ASSERT_TRUE(std::isfinite(x));
  });
  EXPECT_NO_THROW((void)read_mesh(file));
}

TEST(VtuGrid, WhatFitsTheFormatAndNoMeshIsNamed) {
  const test::TemporaryFolder folder;
  const Scene scene = read_scene_text(test::tiny_scene(), "tiny.toml");
  const Mesh sound = build_mesh(scene, load_card(scene.fabric.material, scene.file));
  const fs::path file = folder.path() / "mesh.vtu";
  const auto complaint = [&](const std::function<void(Mesh&)>& spoil) -> std::string {
    Mesh mesh = sound;
    spoil(mesh);
    write_mesh(mesh, file);
    try {
      (void)read_mesh(file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint([](Mesh&) {}), "");
  EXPECT_NE(complaint([](Mesh& m) { m.nodes.position[3][0] = std::nan(""); }).find("node 3"), std::string::npos);
  EXPECT_NE(complaint([](Mesh& m) { m.yarns.rest_length[2] = 0.0; }).find("rest length of yarn element 2"),
            std::string::npos);
  EXPECT_NE(complaint([](Mesh& m) { m.cells.area[1] = -1.0; }).find("area of cell 1"), std::string::npos);
  EXPECT_NE(complaint([](Mesh& m) { m.nodes.mass[0] = INFINITY; }).find("mass of node 0"), std::string::npos);
  EXPECT_NE(complaint([](Mesh& m) {
              m.lattice_size = {2000000000, 2000000000};
            }).find("a lattice of"),
            std::string::npos);
  EXPECT_NE(complaint([](Mesh& m) {
              m.nodes.crossing[0] = m.nodes.crossing[1] = {0, 0};
            }).find("where another does"),
            std::string::npos);
  EXPECT_NE(complaint([](Mesh& m) { m.yarns.node[0][1] = m.yarns.node[0][0]; }).find("twice"), std::string::npos);
}

TEST(VtuGrid, BytesOfTheChildAreBelievedNoMoreThanTheFile) {
  VtuGrid grid;
  grid.point = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  grid.type = {VTK_TRIANGLE};
  grid.offset = {0, 3};
  grid.node = {0, 1, 2};
  grid.point_data = {{"a", VtuType::float64, 1, 3, std::vector<char>(24)}};
  const std::string sound = encode_vtu(grid);
  EXPECT_EQ(decode_vtu(sound).node, grid.node);
  for (unsigned seed = 0; seed < 3000; ++seed) {
    try {
      (void)decode_vtu(test::damaged(sound, seed));
    } catch (const std::runtime_error&) {
    }
  }
  for (const std::int64_t wrong : {std::int64_t{-1}, std::int64_t{3}, INT64_MAX}) {
    VtuGrid other = grid;
    other.node[1] = wrong;
    EXPECT_THROW((void)decode_vtu(encode_vtu(other)), std::runtime_error);
    other = grid;
    other.offset = {0, wrong};
    if (wrong != 3) {
      EXPECT_THROW((void)decode_vtu(encode_vtu(other)), std::runtime_error);
    }
  }
}

}  // namespace
}  // namespace weaveform
