// What a report's page holds: numbers packed and named, a lattice thinned without losing cells, tools cut to the fabric.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/vector/vector.hpp"
#include "post/forming/tools_near.hpp"
#include "post/report/base64.hpp"
#include "post/report/page.hpp"
#include "post/report/shown_part.hpp"
#include "post/report/viewer.hpp"
#include "post/report/words.hpp"
#include "tests/support/fabric_patch.hpp"
#include "tests/unit/solver/lattice/trellis.hpp"

namespace weaveform {
namespace {

std::string encoded(const std::string& text) {
  return base64(reinterpret_cast<const unsigned char*>(text.data()), text.size());
}

TEST(Base64, GivesTheVectorsOfRfc4648) {
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foob"), "Zm9vYg==");
  EXPECT_EQ(encoded("fooba"), "Zm9vYmE=");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

TEST(Words, NameColumnsAndMeasuresWithTheirUnit) {
  EXPECT_EQ(column_in_words("punch.force_N"), "force of punch (N)");
  EXPECT_EQ(column_in_words("kinetic_energy_mJ"), "kinetic energy (mJ)");
  EXPECT_EQ(column_in_words("frame.normalised_shear_force_N_per_mm"), "frame normalised shear force (N/mm)");
  EXPECT_EQ(measure_in_words("tools.punch.force_N"), "force of punch at the end (N)");
  EXPECT_EQ(measure_in_words("grips.top.largest_force_N"), "largest force of top (N)");
  EXPECT_EQ(measure_in_words("max(top.force_N)"), "greatest force of top (N)");
  EXPECT_EQ(measure_in_words("last(center.shear_angle_deg)"), "shear angle of center at the end (°)");
  EXPECT_EQ(measure_in_words("measures.center.sd"), "standard deviation of the shear angle of center at the end (°)");
  EXPECT_EQ(measure_in_words("max_shear_angle_deg"), "greatest shear angle (°)");
  EXPECT_EQ(measure_in_words("forming.draw_in_mm.largest"), "forming draw in mm largest");
  EXPECT_EQ(measure_in_words("cells"), "cells");
}

// Each cell of the mesh is stood for by one shown piece of it at least, and by one block at most.
void expect_all_cells(const Mesh& mesh, const ShownPart& part) {
  std::vector<int> count(static_cast<std::size_t>(mesh.cells.size()), 0);
  for (const int cell : part.of) ++count[static_cast<std::size_t>(cell)];
  for (int c = 0; c < mesh.cells.size(); ++c) {
    const int nodes = mesh.cells.offset[c + 1] - mesh.cells.offset[c];
    EXPECT_GE(count[static_cast<std::size_t>(c)], 1) << c;
    EXPECT_LE(count[static_cast<std::size_t>(c)], nodes > 4 ? 2 : 1) << c;
  }
}

double area(const Mesh& mesh, const ShownPart& part) {
  double sum = 0.0;
  for (const auto& cell : part.cell) {
    const auto at = [&](std::size_t k) {
      return mesh.nodes.position[static_cast<std::size_t>(part.node[static_cast<std::size_t>(cell[k])])];
    };
    sum += 0.5 * length(cross(minus(at(2), at(0)), minus(at(3), at(1))));
  }
  return sum;
}

TEST(ShownPart, HasEveryCellAndYarnOfASmallMesh) {
  const test::FabricPatch patch;  // cut at 30 deg: cells of three to six nodes
  const ShownPart part = shown_part(patch.mesh, 1);
  expect_all_cells(patch.mesh, part);
  EXPECT_EQ(part.node.size(), static_cast<std::size_t>(patch.mesh.node_count()));
  EXPECT_EQ(part.yarn[0].size() + part.yarn[1].size(), static_cast<std::size_t>(patch.mesh.yarn_count()));
}

TEST(ShownPart, ThinnedInBlocksCoversTheSameAreaWithFewerCells) {
  const Mesh mesh = test::lattice(42, 31, 2.0);
  const ShownPart whole = shown_part(mesh, 1), thinned = shown_part(mesh, 4);
  expect_all_cells(mesh, thinned);
  EXPECT_NEAR(area(mesh, whole), 41.0 * 30.0 * 4.0, 1e-9);
  EXPECT_NEAR(area(mesh, thinned), area(mesh, whole), 1e-9);
  EXPECT_EQ(thinned.cell.size(), 70U + 41U * 30U - 70U * 16U);  // 10 x 7 blocks, the rest cell by cell
}

TEST(ShownPart, ThinnedKeepsTheCellsOfCutEdges) {
  const test::FabricPatch patch("twintex-pw", 45.0, {150.0, 150.0});
  const ShownPart part = shown_part(patch.mesh, 2);
  expect_all_cells(patch.mesh, part);
  EXPECT_LT(part.cell.size(), static_cast<std::size_t>(patch.mesh.cells.size()));
  EXPECT_NEAR(area(patch.mesh, part), area(patch.mesh, shown_part(patch.mesh, 1)), 1e-6);
}

foreign::ToolMesh square_tool(double side) {
  foreign::ToolMesh mesh;
  for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
    mesh.node.push_back({0.5 * side * x, 0.5 * side * y, 5.0});
  mesh.face.push_back({0, 1, 2, 3});
  return mesh;
}

double area(const foreign::ToolMesh& mesh) {
  double sum = 0.0;
  for (const auto& face : mesh.face) {
    const auto at = [&](std::size_t k) { return mesh.node[static_cast<std::size_t>(face[face[k] < 0 ? k - 1 : k])]; };
    sum += 0.5 * length(cross(minus(at(2), at(0)), minus(at(3), at(1))));
  }
  return sum;
}

TEST(ToolsNear, AreCutAtTheSidesOfABox) {
  const auto cut = cut_to_box(square_tool(1000.0), {-10.0, -20.0, 0.0}, {30.0, 20.0, 10.0});
  EXPECT_NEAR(area(cut), 40.0 * 40.0, 1e-9);
  for (const Vec3& x : cut.node) {
    EXPECT_GE(x[0], -10.0 - 1e-9);
    EXPECT_LE(x[0], 30.0 + 1e-9);
    EXPECT_EQ(x[2], 5.0);
  }
  EXPECT_TRUE(cut_to_box(square_tool(1000.0), {-10.0, -20.0, 6.0}, {30.0, 20.0, 10.0}).face.empty()) << "above it";
  EXPECT_NEAR(area(cut_to_box(square_tool(4.0), {-10.0, -20.0, 0.0}, {30.0, 20.0, 10.0})), 16.0, 1e-12) << "all inside";
}

TEST(ReportPage, NoTextOfTheDataEndsTheScript) {
  const std::string evil = "</script><script>alert(1)</script><!-- & \xff";
  const std::string page = report_page({{"title", evil}, {"text", evil}});
  EXPECT_EQ(page.find("alert(1)</script>"), std::string::npos);
  EXPECT_EQ(page.find('\xff'), std::string::npos);
  const std::size_t from = page.find("id=\"weaveform-data\">") + 20, to = page.find("</script>", from);
  const auto data = nlohmann::json::parse(page.substr(from, to - from));
  EXPECT_EQ(data["text"].get<std::string>().substr(0, 33), evil.substr(0, 33));
}

TEST(ReportPage, HoldsAViewerThatAsksForNothingElse) {
  EXPECT_GT(viewer_script().size(), 500000U);
  EXPECT_EQ(viewer_script().find("</script"), std::string_view::npos);
  EXPECT_LT(report_page({{"title", "t"}}).size(), 2000000U);
}

}  // namespace
}  // namespace weaveform
