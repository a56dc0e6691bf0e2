// What a scene of several plies leads to: plies on each other, tools on the outer faces, grips that hold some, symmetry of
// all, the same from the scene and around the mesh that it made.
#include "mesher/mesh/stack.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "mesher/resolve/drape_stack.hpp"
#include "mesher/resolve/resolve.hpp"
#include "mesher/scene/reader.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/same_mesh.hpp"

namespace weaveform {
namespace {

const std::string blank_lines = "[blank]\nsize = [100, 100]\nyarn_angle = 0\ncoarsening = 4\nposition = [1, 2, 3]\n";
const std::string plies = "[[ply]]\nname = \"lower\"\n[[ply]]\nname = \"upper\"\nyarn_angle = 45\n";

class Stack : public testing::Test {
protected:
  [[nodiscard]] Resolved resolved(const std::string& scene, const std::vector<std::string>& overrides = {}) const {
    test::write_text(scene, folder_.path() / "s.toml");
    Findings found;
    Resolved model = resolve(folder_.path() / "s.toml", overrides, found);
    found.throw_if_any();
    return model;
  }
  [[nodiscard]] std::string complaint(const std::string& scene) const {
    try {
      (void)resolved(scene);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  }
  test::TemporaryFolder folder_;
};

TEST_F(Stack, PliesLieOnEachOtherFromTheBlanksPlaceUp) {
  const Resolved model = resolved(blank_lines + plies +
                                  "[[ply]]\nname = \"top\"\n[stack]\ngap = 0.25\n[[stack.pair]]\nplies = "
                                  "[\"top\", \"upper\"]\ngap = 0\n");
  const double t = model.ply[0].mesh.thickness;
  EXPECT_EQ(model.ply[0].scene.blank.position, (std::array{1.0, 2.0, 3.0}));
  EXPECT_DOUBLE_EQ(model.ply[1].scene.blank.position[2], 3.0 + t + 0.25);
  EXPECT_DOUBLE_EQ(model.ply[2].scene.blank.position[2], 3.0 + 2.0 * t + 0.25);
  for (std::size_t k = 0; k < 3; ++k) test::expect_same_mesh(ply_mesh(model.mesh, k), model.ply[k].mesh);
}

TEST_F(Stack, APlyLaidFaceDownThatIsTheSameEitherWayIsSaid) {
  const std::string turned = "[model]\ncell = \"rotation-free\"\n" + plies + "face = \"down\"\n";
  const auto lines = early_warnings(resolved(blank_lines + turned));
  const auto said = [](const std::string& line) {
    return line.rfind("ply 'upper': face = \"down\" changes nothing", 0) == 0;
  };
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(), said), 1);
  const auto silent = early_warnings(resolved(blank_lines + plies));
  EXPECT_EQ(std::count_if(silent.begin(), silent.end(), said), 0);
}

TEST_F(Stack, APlyThatIsPlacedCarriesThoseAfterIt) {
  const Resolved model = resolved(blank_lines + plies + "position = [5, 0, 7]\n[[ply]]\nname = \"top\"\n");
  EXPECT_EQ(model.ply[1].scene.blank.position, (std::array{5.0, 0.0, 7.0}));
  EXPECT_DOUBLE_EQ(model.ply[2].scene.blank.position[2], 7.0 + model.ply[1].mesh.thickness);
  EXPECT_EQ(model.ply[2].scene.blank.position[0], 1.0);
}

TEST_F(Stack, ToolsFindTheOuterFacesAndStandOffEachPlyByItsOwnHalf) {
  const Resolved model = resolved(blank_lines + plies + R"(material = "twintex-tw"
[tools.punch]
shape = "sphere"
radius = 20
travel = 5
[tools.die]
shape = "ring"
opening_radius = 25
[tools.binder]
shape = "plane"
axis = [0, 0, -1]
)");
  const double low = model.ply[0].mesh.thickness, high = model.ply[1].mesh.thickness, z = 3.0,
               top = z + 0.5 * (low + high);
  ASSERT_NE(low, high);
  // in the order of their names
  EXPECT_DOUBLE_EQ(model.tools[0].start.origin[2], top + 0.5 * high);
  EXPECT_DOUBLE_EQ(model.tools[1].start.origin[2], z - 0.5 * low);
  EXPECT_DOUBLE_EQ(model.tools[2].start.origin[2], top + 0.5 * high + 20.0);
  for (const Tool& tool : model.ply[0].tools) EXPECT_EQ(tool.offset, 0.5 * low);
  for (const Tool& tool : model.ply[1].tools) EXPECT_EQ(tool.offset, 0.5 * high);
}

TEST_F(Stack, GripsHoldThePliesTheyNameOrWhateverIsThere) {
  const Resolved model = resolved(blank_lines + plies + R"(size = [25, 25]
coarsening = 1
[[grip]]
name = "both"
box = [-11, -11, 11, 11]
[[grip]]
name = "rim"
box = [35, -50, 50, 50]
[[grip]]
name = "one"
edge = "left"
plies = ["upper"]
)");
  const auto names = [&](std::size_t ply) {
    std::vector<std::string> all;
    for (const NodeSet& set : model.ply[ply].mesh.sets) all.push_back(set.name);
    return all;
  };
  EXPECT_EQ(names(0), (std::vector<std::string>{"both", "rim", "outline"}));
  EXPECT_EQ(names(1), (std::vector<std::string>{"both", "one", "outline"}));
  EXPECT_NE(complaint(blank_lines + plies + "[[grip]]\nname = \"off\"\nbox = [80, 80, 90, 90]\n")
                .find("grip 'off' holds no node"),
            std::string::npos);
}

TEST_F(Stack, IsSolvedByAQuarterOnlyWhereEveryPlyIs) {
  EXPECT_EQ(resolved(blank_lines + plies).symmetry.word(), "quarter");
  const Resolved turned = resolved(blank_lines + plies + "[[ply]]\nname = \"askew\"\nyarn_angle = 30\n");
  EXPECT_EQ(turned.symmetry.word(), "none");
  EXPECT_NE(turned.symmetry.why[0].find("ply 'askew'"), std::string::npos) << turned.symmetry.why[0];
  EXPECT_EQ(resolved(blank_lines + plies + "position = [4, 2, 9]\n").symmetry.word(), "half");
}

TEST_F(Stack, AroundItsMeshIsWhatTheSceneLeadsTo) {
  const Resolved model = resolved(blank_lines + plies + "[tools.die]\nshape = \"ring\"\nopening_radius = 25\n");
  const Resolved around = resolve_around(model.scene, model.card, model.mesh);
  ASSERT_EQ(around.ply.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    test::expect_same_mesh(around.ply[k].mesh, model.ply[k].mesh);
    EXPECT_EQ(around.ply[k].scene, model.ply[k].scene);
    EXPECT_EQ(around.ply[k].tools[0].offset, model.ply[k].tools[0].offset);
  }
  EXPECT_EQ(around.symmetry.word(), model.symmetry.word());
  Scene other = model.scene;
  other.ply[1].name = "another";
  EXPECT_THROW((void)resolve_around(other, model.card, model.mesh), InputError);
}

// Cells are chords of the dome, so that plies a thickness apart at their nodes would be inside each other between them.
TEST_F(Stack, DrapedPliesLieClearOfEachOther) {
  const Resolved model = resolved(
      "[blank]\nsize = [60, 60]\nyarn_angle = 0\ncoarsening = 2\n" + plies +
      "[tools.dome]\nshape = \"sphere\"\naxis = [0, 0, -1]\nradius = 50\nposition = [0, 0, -50]\n[drape]\ntool = "
      "\"dome\"\n");
  const auto height = [](const std::array<double, 3>& x) { return std::hypot(x[0], x[1], x[2] + 50.0) - 50.0; };
  const Mesh &lower = model.ply[0].mesh, &upper = model.ply[1].mesh;
  double highest = 0.0, lowest = 1e9;
  for (const auto& x : lower.nodes.position) highest = std::max(highest, height(x));
  for (int c = 0; c < upper.cells.size(); ++c)
    lowest = std::min(lowest, height(cell_centre(upper.cells, c, upper.nodes.position)));
  EXPECT_GE(lowest - highest, 0.5 * (lower.thickness + upper.thickness) - 1e-3);
  EXPECT_LE(lowest - highest, 0.5 * (lower.thickness + upper.thickness) + 0.01);
  test::expect_same_mesh(ply_mesh(model.mesh, 1), upper);
  // what 'weaveform drape' shows is that start
  Findings found;
  const Resolved flat = resolve(folder_.path() / "s.toml", {}, found, {}, ResolveTo::flat);
  const std::vector<DrapedPly> laid = drape_plies(flat);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(laid[k].drape.position, model.ply[k].mesh.nodes.position);
  EXPECT_DOUBLE_EQ(laid[0].off, 0.5 * lower.thickness);
  EXPECT_GT(laid[1].off, laid[0].off + 0.5 * (lower.thickness + upper.thickness));
}

TEST_F(Stack, ComplaintsNameThePly) {
  const std::string wrong = complaint(blank_lines + plies + "coarsening = 50\nmaterial = \"none.toml\"\n");
  EXPECT_NE(wrong.find("ply 'upper': "), std::string::npos) << wrong;
  EXPECT_EQ(wrong.find("ply 'lower'"), std::string::npos) << wrong;
  const std::string both = complaint(
      "[blank]\nsize = [60, 60]\n[[ply]]\nname = \"a\"\ncoarsening = 10\n[[ply]]\nname = \"b\"\ncoarsening = 11\n");
  EXPECT_NE(both.find("ply 'a': blank."), std::string::npos) << both;
  EXPECT_NE(both.find("ply 'b': blank."), std::string::npos) << both;
}

TEST_F(Stack, OfOnePlyIsThatPly) {
  const Resolved model = resolved(blank_lines + "[[ply]]\nname = \"only\"\n");
  const Resolved alone = resolved(blank_lines);
  test::expect_same_mesh(model.ply[0].mesh, alone.mesh);
  EXPECT_EQ(model.tools.size(), alone.tools.size());
}

}  // namespace
}  // namespace weaveform
