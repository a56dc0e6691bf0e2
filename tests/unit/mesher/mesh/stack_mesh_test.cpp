// The mesh of a stack: the plies come back out of it bit for bit, from memory and from the file, and no damage is believed.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "mesher/mesh/stack.hpp"
#include "tests/support/same_mesh.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/mesher/lattice/lattice_zoo.hpp"

namespace weaveform {
namespace {

using namespace lattice_zoo;

class StackMesh : public testing::Test {
protected:
  static Mesh meshed(const Animal& a) { return build_mesh(a.scene, a.card); }
  // Unlike in fabric, direction, spacing; with grips.
  const Mesh lower_ = meshed(animal(twill(), 30.0, {6.25, 8.5}, {1.0, 1.0}, {0.1, 0.3}, true));
  const Mesh upper_ = meshed(animal(twill(), 0.0, {7.5, 9.5}, {2.0, 1.0}, {0.0, 0.0}, true));
  const Mesh stack_ = joined_mesh({{"lower", &lower_}, {"upper", &upper_}, {"last", &lower_}});
};

TEST_F(StackMesh, IsAMeshItselfAndGivesEachPlyBack) {
  EXPECT_EQ(stack_.check(), "");
  EXPECT_EQ(stack_.cells.size(), 2 * lower_.cells.size() + upper_.cells.size());
  EXPECT_EQ(stack_.spacing[0], std::min(lower_.spacing[0], upper_.spacing[0]));
  test::expect_same_mesh(ply_mesh(stack_, 0), lower_);
  test::expect_same_mesh(ply_mesh(stack_, 1), upper_);
  test::expect_same_mesh(ply_mesh(stack_, 2), lower_);
  EXPECT_EQ(ply_mesh(stack_, 1).shown_node(3), lower_.node_count() + 3);
}

TEST_F(StackMesh, ReadsBackBitForBit) {
  const test::TemporaryFolder folder;
  write_mesh(stack_, folder.path() / "mesh.vtu");
  const Mesh read = read_mesh(folder.path() / "mesh.vtu");
  test::expect_same_mesh(read, stack_);
  EXPECT_EQ(read.ply, stack_.ply);
}

TEST_F(StackMesh, AFrameStaysWithItsPly) {
  const test::TemporaryFolder folder;
  Mesh framed = upper_;
  framed.frame.corner = {0, 1, 2, 3};
  const Mesh stack = joined_mesh({{"free", &lower_}, {"framed", &framed}});
  EXPECT_EQ(stack.check(), "");
  write_mesh(stack, folder.path() / "mesh.vtu");
  const Mesh read = read_mesh(folder.path() / "mesh.vtu");
  EXPECT_EQ(read.ply, stack.ply);
  EXPECT_EQ(read.ply[1].frame.corner[2], lower_.node_count() + 2);
  test::expect_same_mesh(ply_mesh(read, 0), lower_);
  test::expect_same_mesh(ply_mesh(read, 1), framed);
  Mesh wrong = stack;
  wrong.ply[1].frame.corner[3] = 0;
  EXPECT_NE(wrong.check(), "");
}

// Names may be those of the file's own arrays.
TEST_F(StackMesh, AnyNameOfAPlyReadsBack) {
  const test::TemporaryFolder folder;
  const Mesh stack = joined_mesh({{"first", &lower_}, {"spacing_mm", &upper_}});
  write_mesh(stack, folder.path() / "mesh.vtu");
  EXPECT_EQ(read_mesh(folder.path() / "mesh.vtu").ply, stack.ply);
}

TEST_F(StackMesh, SaysToWhichPlyEverythingBelongs) {
  const auto nodes = ply_of_nodes(stack_), cells = ply_of_cells(stack_), yarns = ply_of_yarns(stack_);
  EXPECT_EQ(nodes[0], 0);
  EXPECT_EQ(nodes[lower_.node_count()], 1);
  EXPECT_EQ(nodes.back(), 2);
  for (int c = 0; c < stack_.cells.size(); ++c)
    for (int k = stack_.cells.offset[c]; k < stack_.cells.offset[c + 1]; ++k)
      EXPECT_EQ(nodes[stack_.cells.node[k]], cells[c]);
  for (int e = 0; e < stack_.yarn_count(); ++e) EXPECT_EQ(nodes[stack_.yarns.node[e][0]], yarns[e]);
  EXPECT_EQ(ply_of_cells(lower_), std::vector<int>(lower_.cells.size(), 0));
}

TEST_F(StackMesh, RangesThatCannotBeAreFound) {
  Mesh mesh = stack_;
  mesh.ply[1].first_node += 1;
  EXPECT_NE(mesh.check(), "");
  mesh = stack_;
  mesh.ply[1].first_cell = stack_.cells.size() + 7;
  EXPECT_NE(mesh.check(), "");
  mesh = stack_;
  mesh.ply[2].first_row = -3;
  EXPECT_NE(mesh.check(), "");
  mesh = stack_;
  mesh.ply[0].spacing[0] = 0.0;
  EXPECT_NE(mesh.check(), "");
  mesh = stack_;
  std::swap(mesh.yarns.node[0], mesh.yarns.node[lower_.yarn_count()]);  // each names the other ply's nodes
  EXPECT_NE(mesh.check(), "");
}

}  // namespace
}  // namespace weaveform
