// What kept decks from starting in other codes, read from the decks: no mass, no load, nodes in two constraints,
// foreign routines, stiff beams, walls without nodes, tools left out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "mesher/exchange/gathered.hpp"
#include "mesher/exchange/tool_mesh.hpp"
#include "tests/support/chosen.hpp"
#include "tests/support/deck_blocks.hpp"
#include "tests/support/exported_example.hpp"

namespace weaveform {
namespace {

using test::deck_blocks;
using test::deck_real;
using test::deck_whole;
using test::DeckBlock;

struct DeckCase : test::ExportedExample {
  using ExportedExample::ExportedExample;
  [[nodiscard]] std::vector<DeckBlock> radioss(Materials materials = Materials::built_in) const {
    return deck_blocks(written(MeshFormat::openradioss, {.materials = materials}).text, '/', '#');
  }
  [[nodiscard]] std::vector<DeckBlock> dyna(Materials materials = Materials::built_in) const {
    return deck_blocks(written(MeshFormat::lsdyna, {.materials = materials}).text, '*', '$');
  }
};

DeckCase frame() {
  return DeckCase({"blank.coarsening=6"}, "shear_frame_pw");
}
DeckCase hemisphere(const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides = {"blank.coarsening=8"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return DeckCase(overrides, "hemisphere_pw");
}

std::set<long> ids(const std::vector<std::string>& lines, std::size_t first) {
  std::set<long> found;
  for (std::size_t k = first; k < lines.size(); ++k)
    for (std::size_t at = 0; at + 10 <= lines[k].size(); at += 10) found.insert(deck_whole(lines[k], at, 10));
  return found;
}

// Nodes that elements weigh on, and those under constraints.
struct RadiossNodes {
  std::set<long> heavy, constrained, bound;
};
RadiossNodes nodes_of(const std::vector<DeckBlock>& blocks) {
  RadiossNodes nodes;
  std::map<long, std::set<long>> group;
  for (const auto& block : blocks)
    if (block.is("/GRNOD/NODE/")) group[block.id()] = ids(block.line, 1);
  for (const auto& block : blocks) {
    if (block.is("/SPRING/") || block.is("/SHELL/") || block.is("/SH3N/"))
      for (const auto& line : block.line)
        for (std::size_t at = 10; at + 10 <= line.size(); at += 10) nodes.heavy.insert(deck_whole(line, at, 10));
    if (block.is("/MPC/"))
      for (std::size_t k = 1; k < block.line.size(); ++k) nodes.constrained.insert(deck_whole(block.line[k], 0, 10));
    if (block.is("/BCS/")) nodes.bound.merge(std::set<long>(group[deck_whole(block.line.at(1), 20, 10)]));
    if (block.is("/IMPDISP/")) nodes.bound.merge(std::set<long>(group[deck_whole(block.line.at(1), 40, 10)]));
  }
  return nodes;
}

// Errors 535 (a node of a constraint without mass) and 312 (a node in a constraint and under a condition) of the
// starter.
TEST(ExportDecks, NodesOfConstraintsHaveMassAndNoConditions) {
  std::vector<DeckCase> cases;
  cases.push_back(frame());
  cases.push_back(DeckCase({"blank.coarsening=4", "blank.fit=none"}));
  cases.push_back(DeckCase({"blank.coarsening=1", "blank.fit=none"}));  // free yarn ends tied to crossings in the grips
  cases.push_back(hemisphere());
  for (const DeckCase& model : cases) {
    const RadiossNodes nodes = nodes_of(model.radioss());
    EXPECT_EQ(nodes.constrained.empty(), model.mesh.tie.empty());
    for (const long node : nodes.constrained) {
      EXPECT_EQ(nodes.heavy.count(node), 1U) << "node " << node << " has no mass";
      EXPECT_EQ(nodes.bound.count(node), 0U) << "node " << node << " is in a constraint and under a condition";
    }
  }
}

TEST(ExportDecks, TheShearFrameIsLoadedInEveryDeck) {
  const DeckCase model = frame();
  const auto& corner = model.mesh.frame.corner;
  std::set<long> corners;
  for (const int n : corner) corners.insert(n + 1);
  bool moved = false, held = false;
  std::set<long> named, members;
  const auto radioss = model.radioss();
  for (const auto& block : radioss) {
    if (block.is("/GRNOD/NODE/") && block.line.at(0) == "frame_corners") named = ids(block.line, 1);
    if (block.is("/IMPDISP/")) moved = moved || deck_real(block.line.at(2), 20, 20) == 102.0;
    if (block.is("/BCS/")) held = held || (block.line.at(0) == "frame_base" && block.line.at(1).find("111") == 3);
    if (block.is("/PART/") && block.line.at(0) == "frame_members") members = {block.id()};
  }
  EXPECT_TRUE(moved && held);
  EXPECT_EQ(named, corners);
  ASSERT_EQ(members.size(), 1U);
  for (const auto& block : radioss)
    if (block.is("/SPRING/" + std::to_string(*members.begin()))) {
      EXPECT_EQ(block.line.size(), 4U);
    }

  bool pulled = false;
  std::set<std::string> sets;
  std::map<long, double> mass;
  for (const auto& block : model.dyna()) {
    if (block.is("*SET_NODE_LIST_TITLE")) sets.insert(block.line.at(0));
    if (block.is("*BOUNDARY_PRESCRIBED_MOTION_SET")) pulled = pulled || deck_real(block.line.at(0), 40, 10) == 102.0;
    if (block.is("*ELEMENT_MASS"))
      for (const auto& line : block.line) mass[deck_whole(line, 8, 8)] = deck_real(line, 16, 16);
  }
  EXPECT_TRUE(pulled);
  EXPECT_EQ(sets.count("frame_corners"), 1U);
  for (const int n : corner) EXPECT_NEAR(mass[n + 1], model.mesh.nodes.mass[n], 1e-9 * model.mesh.nodes.mass[n]);

  for (const auto format : {MeshFormat::abaqus, MeshFormat::calculix}) {
    const std::string text = model.written(format).text;
    EXPECT_NE(text.find("*NSET, NSET=frame_corners\n"), std::string::npos);
    EXPECT_NE(text.find("crosshead, 2, 2, 102\n"), std::string::npos);
    EXPECT_NE(text.find("frame_base, 3, 3, 0\n"), std::string::npos);
  }
  for (const auto format :
       {MeshFormat::abaqus, MeshFormat::calculix, MeshFormat::lsdyna, MeshFormat::openradioss, MeshFormat::gmsh}) {
    const std::string text = model.written(format).text;
    const std::string header = text.substr(0, text.find("*HEADING"));
    if (header.find("frame_corners") == std::string::npos) continue;
    EXPECT_NE(
        text.find("\nframe_corners\n") == std::string::npos && text.find("NSET=frame_corners") == std::string::npos,
        true)
        << "the header names a set that is not there";
  }
}

TEST(ExportDecks, NoRoutineOfTheUsersIsNeededUnlessAskedFor) {
  const DeckCase model({"blank.coarsening=4"});
  for (const auto materials : {Materials::built_in, Materials::user}) {
    const auto asks = [&](const std::vector<DeckBlock>& blocks, const std::string& word) {
      return std::any_of(blocks.begin(), blocks.end(), [&](const DeckBlock& block) { return block.is(word); });
    };
    EXPECT_EQ(asks(model.radioss(materials), "/MAT/USER"), materials == Materials::user);
    EXPECT_EQ(asks(model.radioss(materials), "/MAT/FABR_A"), materials == Materials::built_in);
    EXPECT_EQ(asks(model.dyna(materials), "*MAT_USER"), materials == Materials::user);
  }
  EXPECT_THROW((void)model.written(MeshFormat::calculix, {.materials = Materials::user}), InputError);
  EXPECT_THROW((void)model.written(MeshFormat::lsdyna, {.is_static = true}), InputError);
}

// I = EI/E, not that of a solid round section.
TEST(ExportDecks, BeamsBendAsTheCardsYarnsDo) {
  for (const std::vector<std::string>& more :
       std::vector<std::vector<std::string>>{{}, {"model.yarn_bending=[3, 8]", "model.yarn_stiffness_scale=2"}}) {
    std::vector<std::string> overrides = {"blank.coarsening=4", "model.yarn=beam"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    const DeckCase model(overrides);
    const double scale = more.empty() ? 1.0 : 2.0, in_plane = more.empty() ? 5.0 : 3.0, out = more.empty() ? 5.0 : 8.0;
    const double modulus = 19800.0 * scale;
    int beams = 0;
    for (const auto& block : model.radioss()) {
      if (block.is("/PROP/BEAM/")) {
        ++beams;
        const double yarns = deck_real(block.line.at(3), 0, 20) / 1.25;
        EXPECT_NEAR(deck_real(block.line.at(3), 20, 20) * modulus, yarns * out, 1e-9 * yarns * out) << "Iyy";
        EXPECT_NEAR(deck_real(block.line.at(3), 40, 20) * modulus, yarns * in_plane, 1e-9 * yarns * in_plane) << "Izz";
      }
      if (block.is("/MAT/ELAST/1")) {
        EXPECT_EQ(deck_real(block.line.at(2), 0, 20), modulus);
      }
    }
    EXPECT_GT(beams, 1);
    for (const auto& block : model.dyna()) {
      if (!block.is("*SECTION_BEAM")) continue;
      EXPECT_EQ(deck_whole(block.line.at(0), 10, 10), 2) << "a resultant beam";
      const double yarns = deck_real(block.line.at(1), 0, 10) / 1.25;
      EXPECT_NEAR(deck_real(block.line.at(1), 10, 10) * modulus, yarns * out, 1e-4 * yarns * out);
    }
  }
}

// A wave takes no less time through an idle end than through a yarn's element, and it weighs what it should.
TEST(ExportDecks, IdleEndsSetNoStep) {
  const DeckCase model({"blank.coarsening=4", "blank.fit=none"});
  const auto blocks = model.radioss(Materials::user);
  std::map<long, std::pair<double, double>> material;  // density, modulus
  std::map<long, double> area;
  std::map<long, std::pair<long, std::string>> part;
  for (const auto& block : blocks) {
    if (block.is("/MAT/ELAST/"))
      material[block.id()] = {deck_real(block.line.at(1), 0, 20), deck_real(block.line.at(2), 0, 20)};
    if (block.is("/PROP/TRUSS/")) area[block.id()] = deck_real(block.line.at(1), 0, 20);
    if (block.is("/PART/")) part[block.id()] = {deck_whole(block.line.at(1), 10, 10), block.line.at(0)};
  }
  int idle = 0;
  for (const auto& [id, named] : part) {
    if (named.second.find("idle") == std::string::npos) continue;
    ++idle;
    const auto [density, modulus] = material.at(named.first);
    EXPECT_NE(named.first, 1) << "a material of its own";
    EXPECT_LT(std::sqrt(modulus / density), 0.01 * std::sqrt(19800.0 / material.at(1).first));
    EXPECT_NEAR(density * area.at(id), material.at(1).first * area.at(id) / foreign::idle_share, 1e-9 * density);
  }
  EXPECT_GT(idle, 0);
  // springs: a mass a length of the whole section and next to no stiffness
  for (const auto& block : model.radioss())
    if (block.is("/PROP/SPRING/") && block.line.at(0).find("idle") != std::string::npos) {
      EXPECT_GT(deck_real(block.line.at(1), 0, 20), 1e-9);
      EXPECT_LT(deck_real(block.line.at(2), 0, 20), 1.0);
    }
  const std::string abaqus = model.written(MeshFormat::abaqus).text;
  EXPECT_NE(abaqus.find("*MATERIAL, NAME=YARN_WARP_IDLE\n"), std::string::npos);
  EXPECT_NE(abaqus.find("ELSET=warp_idle_1, MATERIAL=YARN_WARP_IDLE"), std::string::npos);
}

TEST(ExportDecks, RigidWallsNameTheFabricsNodes) {
  const DeckCase model = hemisphere();
  std::map<long, std::set<long>> set;
  int walls = 0;
  const auto blocks = model.dyna();
  for (const auto& block : blocks)
    if (block.is("*SET_NODE_LIST_TITLE")) set[deck_whole(block.line.at(1), 0, 10)] = ids(block.line, 2);
  for (const auto& block : blocks) {
    if (!block.is("*RIGIDWALL")) continue;
    ++walls;
    const auto& nodes = set[deck_whole(block.line.at(1), 0, 10)];
    EXPECT_EQ(static_cast<int>(nodes.size()), model.mesh.node_count());
    EXPECT_EQ(nodes.empty() ? 0 : *nodes.rbegin(), model.mesh.node_count());
  }
  EXPECT_EQ(walls, 1);
}

TEST(ExportDecks, TheEngineFileRunsTheStarters) {
  const DeckCase model({"blank.coarsening=4"});
  const ExportedMesh file = model.written(MeshFormat::openradioss, {.run_name = "cloth"});
  for (const auto& block : deck_blocks(file.text, '/', '#'))
    if (block.is("/BEGIN")) {
      EXPECT_EQ(block.line.at(0), "cloth");
    }
  std::map<std::string, std::string> engine;
  for (const auto& block : deck_blocks(file.engine, '/', '#'))
    engine[block.keyword] = block.line.empty() ? "" : block.line.at(0);
  EXPECT_EQ(std::stod(engine.at("/RUN/cloth/1")), 0.5);
  EXPECT_EQ(engine.count("/VERS/2021"), 1U);
  EXPECT_EQ(std::stod(engine.at("/DT/NODA")), 0.9);
  EXPECT_NEAR(std::stod(engine.at("/TFILE")), 0.5 / 200, 1e-12);
  EXPECT_NEAR(std::stod(engine.at("/ANIM/DT").substr(2)), 0.5 / 20, 1e-12);
  for (const auto format : {MeshFormat::abaqus, MeshFormat::calculix, MeshFormat::lsdyna, MeshFormat::gmsh})
    EXPECT_TRUE(model.written(format).engine.empty());
}

TEST(ExportDecks, ToolsAreRigidBodiesWithContactFrictionAndForce) {
  const DeckCase model = hemisphere();
  std::map<std::string, std::set<std::string>> has;  // of a tool
  std::map<long, std::string> title_of_group;
  const auto blocks = model.radioss();
  for (const auto& block : blocks)
    if (block.is("/GRNOD/NODE/")) title_of_group[block.id()] = block.line.at(0);
  for (const auto& block : blocks) {
    for (const std::string word : {"/RBODY/", "/SURF/PART/", "/INTER/TYPE7/", "/CLOAD/", "/IMPDISP/", "/BCS/"})
      if (block.is(word)) has[block.line.at(0)].insert(word);
    if (block.is("/INTER/TYPE7/")) {
      EXPECT_EQ(title_of_group[deck_whole(block.line.at(1), 0, 10)], "all_nodes");
      EXPECT_EQ(deck_real(block.line.at(4), 20, 20), 0.3) << "friction";
      EXPECT_EQ(deck_real(block.line.at(4), 40, 20), 0.25) << "half the thickness";
      EXPECT_GT(deck_real(block.line.at(4), 0, 20), 0.0) << "stiffness";
    }
    if (block.is("/CLOAD/")) {
      EXPECT_EQ(deck_real(block.line.at(1), 80, 20), -650.0);
      EXPECT_EQ(block.line.at(1).substr(10, 10), "         Z");
    }
    if (block.is("/RBODY/")) {
      EXPECT_GT(deck_real(block.line.at(1), 40, 20), 0.0) << "mass";
    }
  }
  const std::set<std::string> body = {"/RBODY/", "/SURF/PART/", "/INTER/TYPE7/", "/BCS/"};
  for (const auto& [tool, extra] :
       {std::pair{"die", ""}, std::pair{"binder", "/CLOAD/"}, std::pair{"punch", "/IMPDISP/"}}) {
    std::set<std::string> expected = body;
    if (*extra != '\0') expected.insert(extra);
    EXPECT_EQ(has[tool], expected) << tool;
  }
  std::map<std::string, int> dyna;
  for (const auto& block : model.dyna()) {
    ++dyna[block.keyword];
    if (block.is("*LOAD_RIGID_BODY")) {
      EXPECT_EQ(deck_real(block.line.at(0), 30, 10), -650.0);
    }
    if (block.is("*CONTACT")) {
      EXPECT_EQ(deck_real(block.line.at(2), 0, 10), 0.3);
    }
  }
  EXPECT_EQ(dyna["*MAT_RIGID"], 2);
  EXPECT_EQ(dyna["*CONTACT_AUTOMATIC_NODES_TO_SURFACE_ID"], 2);
  EXPECT_EQ(dyna["*LOAD_RIGID_BODY"], 1);
}

// Corners on the tool's own surface, facets within the stated distance and turned outward, for every shape.
TEST(ExportDecks, ToolMeshesLieOnTheirTools) {
  for (const std::string shape : {"sphere", "plane", "cylinder", "revolved"}) {
    DeckCase model = hemisphere();
    ToolSpec& punch = model.scene.tools[2];
    ASSERT_EQ(punch.name, "punch");
    punch.shape = test::chosen(shape);
    if (shape == "cylinder") punch.axis = {1.0, 0.5, 0.0}, punch.position = {0.0, 0.0, 80.0};
    if (shape == "revolved") punch.profile = {{0, -10}, {40, -10, 8}, {60, 30}};
    const auto gathered =
        foreign::gather(model.scene, model.card, model.mesh, make_tools(model.scene, model.mesh), 0.5, "test");
    for (const auto& motion : gathered.tools) {
      const foreign::ToolMesh mesh = foreign::mesh_of_tool(gathered, motion);
      ASSERT_GT(mesh.face.size(), 10U);
      const auto distance = [&](const std::array<double, 3>& x, std::array<double, 3>& normal) {
        Distances out;
        tool_distances(motion.tool, motion.tool.start, {&x[0], &x[1], &x[2]}, 1, nullptr, out);
        for (std::size_t c = 0; c < 3; ++c) normal[c] = out.normal[c][0];
        return out.distance[0];
      };
      std::array<double, 3> normal{};
      for (const auto& x : mesh.node) EXPECT_NEAR(distance(x, normal), 0.0, 1e-9) << motion.tool.name;
      for (const auto& face : mesh.face) {
        const int size = face[3] < 0 ? 3 : 4;
        std::array<double, 3> middle = {0, 0, 0}, a{}, b{};
        for (int k = 0; k < size; ++k)
          for (std::size_t c = 0; c < 3; ++c) middle[c] += mesh.node[face[k]][c] / size;
        EXPECT_NEAR(distance(middle, normal), 0.0, foreign::tool_sagitta) << motion.tool.name;
        for (std::size_t c = 0; c < 3; ++c) {
          a[c] = mesh.node[face[1]][c] - mesh.node[face[0]][c];
          b[c] = mesh.node[face[2]][c] - mesh.node[face[0]][c];
        }
        EXPECT_GT(normal[0] * (a[1] * b[2] - a[2] * b[1]) + normal[1] * (a[2] * b[0] - a[0] * b[2]) +
                      normal[2] * (a[0] * b[1] - a[1] * b[0]),
                  0.0)
            << motion.tool.name << ": inward";
      }
    }
  }
}

TEST(ExportDecks, WeightIsCarried) {
  const DeckCase model({"blank.coarsening=4", "analysis.gravity=[0, 0, -9810]"});
  for (const auto& block : model.radioss())
    if (block.is("/GRAV/")) {
      EXPECT_EQ(deck_real(block.line.at(1), 80, 20), -9810.0);
    }
  int loads = 0;
  for (const auto& block : model.dyna())
    if (block.is("*LOAD_BODY_Z")) {
      ++loads;
      EXPECT_EQ(deck_real(block.line.at(0), 10, 10), 9810.0) << "of the base";
    }
  EXPECT_EQ(loads, 1);
  EXPECT_NE(model.written(MeshFormat::abaqus).text.find("*DLOAD\nWARP, GRAV, 9810, 0, 0, -9810\n"), std::string::npos);
  EXPECT_NE(model.written(MeshFormat::calculix).text.find("*CLOAD\n"), std::string::npos);
}

}  // namespace
}  // namespace weaveform
