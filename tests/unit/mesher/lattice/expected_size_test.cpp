#include "mesher/lattice/expected_size.hpp"

#include <gtest/gtest.h>

#include <string>

#include "mesher/lattice/build.hpp"
#include "mesher/scene/reader.hpp"

namespace weaveform {
namespace {

ExpectedSize size_of(const std::string& blank, Mesh* mesh = nullptr) {
  const Scene scene = read_scene_text("[blank]\n" + blank, "", {});
  const Card card = load_card(scene.fabric.material);
  if (mesh != nullptr) *mesh = build_mesh(scene, card);
  return expected_size(scene.blank, card, read_blank_outline(scene));
}

TEST(ExpectedSize, IsThatOfTheMeshButForItsBorder) {
  for (const std::string blank :
       {"size = [300, 200]\nyarn_angle = 0\n", "size = [300, 200]\nyarn_angle = 30\ncoarsening = [1, 2]\n",
        "shape = \"disc\"\nsize = [300, 300]\nyarn_angle = 45\n",
        "shape = \"polygon\"\ncorners = [[0, 0], [300, 0], [0, 300]]\nyarn_angle = 10\n"}) {
    Mesh mesh;
    const ExpectedSize size = size_of(blank, &mesh);
    EXPECT_NEAR(size.cells, mesh.cells.size(), 0.15 * mesh.cells.size()) << blank;
    EXPECT_GE(size.crossings, 0.9 * mesh.lattice_size[0] * mesh.lattice_size[1]) << blank;
    EXPECT_EQ(size.outlier, "") << blank;
  }
}

TEST(ExpectedSize, NamesTheCornerThatLiesFarFromAllOthers) {
  EXPECT_EQ(size_of("shape = \"polygon\"\ncorners = [[0, 0], [100, 0], [100, 100], [50, 9e5], [0, 100]]\n").outlier,
            "corner 4 (50, 900000)");
  // a long strip has no such corner
  EXPECT_EQ(size_of("shape = \"polygon\"\ncorners = [[0, 0], [9e4, 0], [9e4, 50], [0, 50]]\n").outlier, "");
}

}  // namespace
}  // namespace weaveform
