// The layers of a stack on structural shells: along the shell's normal, without those that are not there.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "post/transfer/layered.hpp"

namespace weaveform {
namespace {

// Three squares side by side in the plane, the second with its normal down; warp along x, weft along y.
FibreField three_squares() {
  FibreField field;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 2; ++j) field.position.push_back({1.0 * i, 1.0 * j, 0.0});
  field.flat_thickness = 0.5;
  for (int k = 0; k < 3; ++k) {
    StateElement element;
    element.number = 11 + k;
    element.node = {2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1};
    if (k == 1) std::reverse(element.node.begin(), element.node.end());
    element.state.thickness = 0.5;
    field.element.push_back(element);
  }
  return field;
}

// The upper ply ends before the third.
std::vector<FibreLayer> patched() {
  FibreField upper = three_squares();
  upper.element[2].far = true;
  for (StateElement& element : upper.element) {
    element.state.warp = {0.0, 1.0, 0.0};
    element.state.weft = {-1.0, 0.0, 0.0};
    element.state.thickness = 0.25;
  }
  return {{"base-1", "my card", three_squares()}, {"patch", "other", upper}};
}

// The data lines of the section of the set that has this shell.
std::string section_of(const std::string& text, const std::string& shell) {
  const std::size_t set = text.find("*ELSET, ELSET=LAYERS_", 0);
  for (std::size_t at = set; at != std::string::npos; at = text.find("*ELSET, ELSET=LAYERS_", at + 1)) {
    const std::size_t list = text.find('\n', at) + 1;
    if (text.substr(list, text.find('\n', list) - list) != shell) continue;
    const std::size_t begin = text.find('\n', text.find("COMPOSITE", list)) + 1;
    return text.substr(begin, std::min(text.find("\n*", begin), text.size()) - begin);
  }
  return "";
}

TEST(Layers, StandAlongTheShellsNormalAndEndWithTheirPly) {
  const std::string text = layers_calculix(patched(), 1.0, "a test").text;
  const std::string up = section_of(text, "11"), down = section_of(text, "12"), alone = section_of(text, "13");
  EXPECT_LT(up.find("BASE_1"), up.find("PATCH")) << up;
  EXPECT_GT(down.find("BASE_1"), down.find("PATCH")) << down;
  EXPECT_NE(alone.find("MY_CARD"), std::string::npos) << alone;
  EXPECT_EQ(alone.find("PATCH"), std::string::npos) << alone;
  EXPECT_NE(up.find("0.25, , OTHER, WARP_"), std::string::npos) << up;
}

TEST(Layers, OfAbaqusShareSectionsWhereTheirOrderIsOne) {
  const std::string text = layers_abaqus(patched(), "a test").text;
  EXPECT_EQ(section_of(text, "12"),
            "THICKNESS_PATCH, 3, OTHER, WARP_PATCH, PATCH\n"
            "THICKNESS_BASE_1, 3, MY_CARD, WARP_BASE_1, BASE_1\n");
  EXPECT_EQ(section_of(text, "13"), "THICKNESS_BASE_1, 3, MY_CARD, WARP_BASE_1, BASE_1");
  EXPECT_EQ(std::string::npos, text.find("13, 0., 1., 0.")) << "no direction of the patch where it is not";
}

TEST(Layers, OfOpenRadiossHaveABlockForEveryYarnFamily) {
  const std::string text = layers_openradioss(patched(), "a test").text;
  for (const char* block : {"/DRAPE/1\nwarp of base-1\n", "/DRAPE/2\nweft of base-1\n", "/DRAPE/3\nwarp of patch\n",
                            "/DRAPE/4\nweft of patch\n"})
    EXPECT_NE(text.find(block), std::string::npos) << block;
}

// Shells again with columns of 8, layers two a line with columns of 10; angles from the first edge.
TEST(Layers, OfLsDynaStandBehindTheirShell) {
  const std::string text = layers_lsdyna(patched(), "a test").text;
  EXPECT_NE(text.find("$ MID 1: my card\n$ MID 2: other\n*ELEMENT_SHELL_COMPOSITE\n"), std::string::npos) << text;
  EXPECT_NE(text.find("      11       1       1       3       4       2\n"
                      "         1       0.5         0                   2      0.25        90\n"),
            std::string::npos)
      << text;
  // its first edge runs along x, its normal down: the patch is its first layer, its warp to the right of the edge
  EXPECT_NE(text.find("      12       1       4       6       5       3\n"
                      "         2      0.25       -90                   1       0.5         0\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("      13       1       5       7       8       6\n         1       0.5         0\n"),
            std::string::npos)
      << text;
}

TEST(Layers, AreOneTableWithThePlysName) {
  const std::string text = layers_csv(patched()).text;
  EXPECT_TRUE(text.starts_with("ply,element,x_mm,"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 7);
  EXPECT_NE(text.find("\nbase-1,11,"), std::string::npos);
  EXPECT_NE(text.find("\npatch,13,"), std::string::npos);
}

}  // namespace
}  // namespace weaveform
