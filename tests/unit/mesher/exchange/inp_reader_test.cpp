// Abaqus decks as preprocessors and people write them: parts and instances, files within files, dialects.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "mesher/exchange/foreign_mesh.hpp"
#include "mesher/exchange/import.hpp"
#include "mesher/lattice/build.hpp"
#include "mesher/scene/reader.hpp"
#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

using test::TemporaryFolder;
using test::write_text;

class Deck : public testing::Test {
protected:
  [[nodiscard]] ForeignMesh read(const std::string& text, const std::string& name = "deck.inp") const {
    write_text(text, folder_.path() / name);
    return read_foreign_mesh(folder_.path() / name);
  }
  void beside(const std::string& name, const std::string& text) const { write_text(text, folder_.path() / name); }
  template <class Error>
  [[nodiscard]] std::string complaint(const std::string& text) const {
    try {
      (void)read(text);
    } catch (const Error& error) {
      return error.what();
    }
    return "no complaint";
  }
  TemporaryFolder folder_;
};

const NodeSet& node_set(const ForeignMesh& mesh, const std::string& name) {
  return *std::find_if(mesh.node_sets.begin(), mesh.node_sets.end(), [&](const auto& s) { return s.name == name; });
}

const std::string node_lines = "1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n";
const std::string square_lines = "*Node\n" + node_lines + "*Element, type=S4R\n1, 1, 2, 3, 4\n";

// Each part numbers from 1; what CAE calls the same in two parts stays two things.
TEST_F(Deck, PartsAreNumberedApart) {
  const ForeignMesh mesh = read(
      "*Heading\n*Part, name=A\n" + square_lines + "*Nset, nset=edge\n1, 2\n*End Part\n*Part, name=B\n" + square_lines +
      "*Nset, nset=edge\n3, 4\n*End Part\n*Assembly, name=Assembly\n"
      "*Instance, name=A-1, part=A\n*End Instance\n*Instance, name=B-1, part=B\n*End Instance\n"
      "*Nset, nset=both, instance=A-1\n1,\n*Nset, nset=both, instance=B-1\n1,\n"
      "*Elset, elset=_PickedSet1, internal, instance=B-1\n1,\n*End Assembly\n");
  ASSERT_EQ(mesh.position.size(), 8U);
  ASSERT_EQ(mesh.shells.size(), 2U);
  EXPECT_EQ(mesh.shells[1].number, 1);
  EXPECT_EQ(mesh.shells[1].node, (std::vector<int>{4, 5, 6, 7}));
  EXPECT_EQ(node_set(mesh, "both").node, (std::vector<int>{0, 4}));
  EXPECT_EQ(std::count_if(mesh.node_sets.begin(), mesh.node_sets.end(), [](const auto& s) { return s.name == "edge"; }),
            2);
  EXPECT_EQ(shells_named(mesh, "b"), (std::vector<int>{1}));
  EXPECT_EQ(shells_named(mesh, "A-1"), (std::vector<int>{0}));
  EXPECT_EQ(shells_named(mesh, "_pickedset1"), (std::vector<int>{1}));
  EXPECT_TRUE(shells_named(mesh, "c").empty());
}

// Translation first, then rotation by the right hand about the axis from the first point to the second.
TEST_F(Deck, AnInstanceStandsWhereTheAssemblyPutsIt) {
  const std::string part = "*PART, NAME=A\n" + square_lines + "*END PART\n*ASSEMBLY, NAME=M\n";
  const auto corner = [&](const std::string& lines) {
    return read(part + "*INSTANCE, NAME=A-1, PART=A\n" + lines + "*END INSTANCE\n*END ASSEMBLY\n").position[1];
  };
  EXPECT_EQ(corner("10., 20., 30.\n"), (std::array<double, 3>{11.0, 20.0, 30.0}));
  const auto turned = corner("10., 0., 0.\n10., 0., 0., 10., 0., 1., 90.\n");
  EXPECT_NEAR(turned[0], 10.0, 1e-12);
  EXPECT_NEAR(turned[1], 1.0, 1e-12);
  const auto about_origin = corner("10., 0., 0.\n0., 0., 0., 0., 5., 0., 90.\n");
  EXPECT_NEAR(about_origin[0], 0.0, 1e-12);
  EXPECT_NEAR(about_origin[2], -11.0, 1e-12);
}

// An independent instance has its mesh in its own block; the part's is empty.
TEST_F(Deck, AnInstanceMayHoldItsOwnMesh) {
  const ForeignMesh mesh =
      read("*Part, name=P\n*End Part\n*Assembly, name=A\n*Instance, name=P-1, part=P\n0., 0., 7.\n" + square_lines +
           "*Elset, elset=skin, generate\n1, 1, 1\n*End Instance\n*Node\n1, 5., 5., 5.\n"
           "*Nset, nset=RP\n1,\n*Nset, nset=mixed\nP-1.2, RP\n*End Assembly\n");
  ASSERT_EQ(mesh.position.size(), 5U);
  EXPECT_EQ(mesh.position[2][2], 7.0);
  EXPECT_EQ(node_set(mesh, "RP").node, (std::vector<int>{4}));
  EXPECT_EQ(node_set(mesh, "mixed").node, (std::vector<int>{1, 4}));
  EXPECT_EQ(shells_named(mesh, "skin"), (std::vector<int>{0}));
}

TEST_F(Deck, TwoInstancesOfAPartAreAskedFor) {
  const ForeignMesh mesh = read("*Part, name=PUNCH\n" + square_lines +
                                "*End Part\n*Assembly, name=A\n"
                                "*Instance, name=left, part=PUNCH\n*End Instance\n"
                                "*Instance, name=right, part=PUNCH\n9., 0., 0.\n*End Instance\n*End Assembly\n");
  EXPECT_EQ(shells_named(mesh, "right"), (std::vector<int>{1}));
  EXPECT_THROW((void)shells_named(mesh, "punch"), InputError);
}

// Case of letters, blanks, line ends, comments, continued lines, exponents, order of blocks: all as Abaqus takes them.
TEST_F(Deck, DialectsReadTheSame) {
  const ForeignMesh plain = read(
      "*NODE\n1, 10, 0, 0\n2, 0, 2.5, 0\n3, 0, 0, 1\n4, 1, 1, 0\n*ELEMENT, TYPE=S4, ELSET=SKIN\n"
      "1, 1, 2, 3, 4\n*NSET, NSET=edge\n1, 2\n");
  const ForeignMesh odd = read(
      "\xEF\xBB\xBF** a comment\r\n*nset ,\tNset = \"edge\"\r\n 1 , 2 ,\r\n\r\n* ELEMENT , TYPE = s4 ,\r\n"
      "  ELSET=SKIN\r\n1, 1, 2,\r\n** between\r\n3, 4\r\n*Node\r\n 1, 1.0E+01 , , \r\n"
      "2, 0., 25.D-1\r\n   3,0,0,+1,0.,0.,1.\r\n4,1,1\r\n*Step\r\n*Node Output\r\nU,\r\n*End Step");
  EXPECT_EQ(odd.position, plain.position);
  ASSERT_EQ(odd.shells.size(), 1U);
  EXPECT_EQ(odd.shells[0].node, plain.shells[0].node);
  EXPECT_EQ(node_set(odd, "edge").node, node_set(plain, "edge").node);
  EXPECT_EQ(shells_named(odd, "skin"), (std::vector<int>{0}));
}

TEST_F(Deck, ElementTypesAreReadByWhatTheyAre) {
  const auto shape = [&](const std::string& type, const std::string& element) {
    const ForeignMesh mesh =
        read("*NODE\n" + node_lines +
             "5,0,0,0\n6,0,0,0\n7,0,0,0\n8,0,0,0\n*ELEMENT, TYPE=T3D2\n90, 1, 2\n*ELEMENT, TYPE=" + type + "\n" +
             element + "\n");
    return std::pair{mesh.lines.size() - 1, mesh.shells.empty() ? 0U : mesh.shells[0].node.size()};
  };
  for (const char* type : {"T2D2", "T3D2H", "B21", "B31", "B31OS", "B33", "PIPE31", "t3d2"})
    EXPECT_EQ(shape(type, "1, 1, 2").first, 1U) << type;
  for (const char* type : {"S3", "S3R", "S3RS", "STRI3", "M3D3", "R3D3", "CPS3", "CPE3", "CPE3H", "SFM3D3"})
    EXPECT_EQ(shape(type, "1, 1, 2, 3").second, 3U) << type;
  for (const char* type : {"S4", "S4R", "S4RS", "S4RSW", "S4R5", "M3D4", "M3D4R", "R3D4", "CPS4", "CPS4R", "CPS4I",
                           "CPE4RH", "SFM3D4R", "CAX4P"})
    EXPECT_EQ(shape(type, "1, 1, 2, 3, 4").second, 4U) << type;
  for (const char* type : {"S8R", "S8R5", "M3D8", "CPS8", "CPE8R"})
    EXPECT_EQ(shape(type, "1, 1, 2, 3, 4, 5, 6,\n7, 8").second, 4U) << type;
  for (const char* type : {"S6", "STRI65", "M3D6", "CPS6M"})
    EXPECT_EQ(shape(type, "1, 1, 2, 3, 4, 5, 6").second, 3U) << type;
  for (const char* type : {"MASS", "SPRINGA", "CONN3D2", "C3D8R", "COH3D8", "U1"})
    EXPECT_EQ(shape(type, "1, 1, 2, 3, 4, 5, 6, 7, 8").second, 0U) << type;
}

TEST_F(Deck, FilesThatItNamesAreReadBesideIt) {
  beside("points.txt", "** x y z\n" + node_lines);
  beside("shells.txt", "1, 1, 2, 3, 4\n");
  beside("inner.inp", "*Node, input=points.txt\n");
  beside("members.txt", "1, 2\n");
  const ForeignMesh mesh = read(
      "*Include, input=inner.inp\n*Element, type=S4, elset=skin, input=\"shells.txt\"\n"
      "*Nset, nset=edge, input=members.txt\n4\n");
  EXPECT_EQ(mesh.position.size(), 4U);
  EXPECT_EQ(mesh.shells.size(), 1U);
  EXPECT_EQ(node_set(mesh, "edge").node, (std::vector<int>{0, 1, 3}));
  EXPECT_EQ(mesh.files.size(), 5U) << "what was read is known, and not overwritten";
  // data lines alone, under a keyword of the deck
  EXPECT_EQ(read("*Node\n*Include, input=points.txt\n*Element, type=S4\n1, 1, 2, 3, 4\n").position.size(), 4U);
}

TEST_F(Deck, FilesThatCannotBeReadAreNamedWithTheirLine) {
  const std::string missing = complaint<FileError>("*HEADING\n*NODE, INPUT=none.txt\n");
  EXPECT_NE(missing.find("deck.inp:2: *NODE, INPUT=none.txt"), std::string::npos) << missing;
  EXPECT_NE(complaint<FileError>("*INCLUDE, INPUT=none.inp\n").find("deck.inp:1: *INCLUDE"), std::string::npos);
  EXPECT_NE(complaint<FileError>("*INCLUDE, INPUT=/dev/zero\n").find("no such file"), std::string::npos);
  EXPECT_NE(complaint<InputError>("*INCLUDE\n").find("names no file"), std::string::npos);
  EXPECT_NE(complaint<InputError>("*INCLUDE, INPUT=deck.inp\n").find("includes itself"), std::string::npos);
  beside("a.inp", "*INCLUDE, INPUT=b.inp\n");
  beside("b.inp", "*NODE\n1, 0, 0, 0\n*INCLUDE, INPUT=a.inp\n");
  const std::string circle = complaint<InputError>("*INCLUDE, INPUT=a.inp\n");
  EXPECT_NE(circle.find("b.inp:3: "), std::string::npos) << circle;
  beside("words.txt", "1, 0, zero, 0\n");
  const std::string wrong = complaint<InputError>("*NODE, INPUT=words.txt\n");
  EXPECT_NE(wrong.find("words.txt:1: 'zero'"), std::string::npos) << wrong;
  for (int k = 0; k < 20; ++k)
    beside("deep" + std::to_string(k), "*INCLUDE, INPUT=deep" + std::to_string(k + 1) + "\n");
  EXPECT_NE(complaint<InputError>("*INCLUDE, INPUT=deep0\n").find("deep"), std::string::npos);
  beside("many.inp", std::string([] {
           std::string text;
           for (int k = 0; k < 2000; ++k) text += "*INCLUDE, INPUT=empty.inp\n";
           return text;
         }()));
  beside("empty.inp", "** nothing\n");
  EXPECT_NE(complaint<InputError>("*INCLUDE, INPUT=many.inp\n").find("more than"), std::string::npos);
}

// What would make another mesh if it were passed over.
TEST_F(Deck, WhatMakesOrMovesNodesIsRefusedByName) {
  for (const std::string word : {"*NGEN", "*NFILL", "*ELGEN", "*NCOPY", "*SYSTEM", "*NMAP"}) {
    const std::string what = complaint<InputError>(square_lines + word + "\n1, 5, 1\n");
    EXPECT_NE(what.find("deck.inp:8: " + word), std::string::npos) << what;
  }
  EXPECT_NE(complaint<InputError>("*Part, name=A\n" + square_lines +
                                  "*End Part\n*Assembly, name=M\n*Instance, name=I, part=B\n")
                .find("no part is named 'B'"),
            std::string::npos);
  EXPECT_NE(complaint<InputError>("*NODE\n1,0,0,0\n2,0,0,0\n*ELEMENT, TYPE=T3D3\n1, 1, 2, 1\n").find("'T3D3'"),
            std::string::npos);
  EXPECT_NE(complaint<InputError>("*NODE\n1,0,0,0\n*ELEMENT, TYPE=C3D4\n1, 1, 1, 1, 1\n").find("1 C3D4"),
            std::string::npos);
}

// An even lattice of a x b cells of 10 mm: yarns along both directions and a shell in each cell.
struct Lattice {
  int a = 6, b = 8;
  double z = 0.0, noise = 0.0;
  [[nodiscard]] int node(int i, int j) const { return j * (a + 1) + i + 1; }
  [[nodiscard]] std::string node_lines() const {
    std::string text = "*Node\n";
    char line[100];
    for (int j = 0; j <= b; ++j)
      for (int i = 0; i <= a; ++i) {
        std::snprintf(line, sizeof line, "%d, %.9g, %.9g, %.9g\n", node(i, j),
                      static_cast<double>(static_cast<float>(9.84 * i)),
                      static_cast<double>(static_cast<float>(9.84 * j)), z + noise * ((i + j) % 2 == 0 ? 1.0 : -1.0));
        text += line;
      }
    return text;
  }
  [[nodiscard]] std::string elements() const {
    std::string warp = "*Element, type=T3D2, elset=warp\n", weft = "*Element, type=T3D2, elset=weft\n",
                cells = "*Element, type=M3D4R, elset=cells\n";
    int number = 0;
    const auto with = [&](std::initializer_list<int> ends) {
      std::string line = std::to_string(++number);
      for (const int n : ends) line += ", " + std::to_string(n);
      return line + "\n";
    };
    for (int j = 0; j <= b; ++j)
      for (int i = 0; i < a; ++i) warp += with({node(i, j), node(i + 1, j)});
    for (int j = 0; j < b; ++j)
      for (int i = 0; i <= a; ++i) weft += with({node(i, j), node(i, j + 1)});
    for (int j = 0; j < b; ++j)
      for (int i = 0; i < a; ++i) cells += with({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
    return warp + weft + cells;
  }
  [[nodiscard]] std::string set(const std::string& name, int j, const std::string& more = "") const {
    return "*Nset, nset=" + name + more + ", generate\n" + std::to_string(node(0, j)) + ", " +
           std::to_string(node(a, j)) + ", 1\n";
  }
  [[nodiscard]] std::string mesh() const { return node_lines() + elements(); }
  [[nodiscard]] std::string flat_deck() const { return "*Heading\n" + mesh() + set("bottom", 0) + set("top", b); }
};

Scene lattice_scene(const std::string& tool = "") {
  std::string text =
      "[fabric]\nmaterial = \"twintex-pw\"\n[blank]\nshape = \"rectangle\"\nsize = [59.04, 78.72]\nyarn_angle = 0.0\n"
      "[[grip]]\nname = \"bottom\"\nedge = \"bottom\"\n[[grip]]\nname = \"top\"\nedge = \"top\"\ntravel = 1.0\n"
      "[analysis]\nduration = 0.02\n";
  if (!tool.empty())
    text += "[tools." + tool + "]\nshape = \"triangles\"\nfile = \"deck.inp\"\ndirection = [0, 0, -1]\ntravel = 1.0\n";
  return read_scene_text(text, "scene.toml", {});
}

class FabricDeck : public Deck {
protected:
  [[nodiscard]] ImportedMesh import(const std::string& text, const std::string& tool = "",
                                    const std::string& part = "") const {
    const Scene scene = lattice_scene(tool);
    return import_foreign(read(text), scene, load_card(scene.fabric.material, scene.file), part);
  }
  [[nodiscard]] std::string refusal(const std::string& text, const std::string& part = "") const {
    try {
      (void)import(text, "", part);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no complaint";
  }
};

const std::string punch =
    "*Part, name=PUNCH\n*Node\n1, -9., -9., 5.\n2, 9., -9., 5.\n3, 9., 9., 5.\n4, -9., 9., 5.\n"
    "*Element, type=R3D4\n1, 1, 2, 3, 4\n*End Part\n";

TEST_F(FabricDeck, TheFabricIsImportedFromItsPartAsFromAFlatFile) {
  const Lattice lattice;
  const Mesh flat = import(lattice.flat_deck()).mesh;
  EXPECT_EQ(flat.cells.size(), 48);
  const std::string in = ", instance=FABRIC-1";
  const std::string parts = "*Heading\n" + punch + "*Part, name=FABRIC\n" + lattice.mesh() +
                            "*End Part\n"
                            "*Assembly, name=Assembly\n*Instance, name=PUNCH-1, part=PUNCH\n0., 0., 2.\n*End Instance\n"
                            "*Instance, name=FABRIC-1, part=FABRIC\n*End Instance\n" +
                            lattice.set("bottom", 0, in) + lattice.set("top", lattice.b, in) +
                            "*Nset, nset=_PickedSet7, internal, instance=PUNCH-1\n1,\n*End Assembly\n";
  const ImportedMesh found = import(parts, "punch");
  EXPECT_EQ(found.mesh.nodes.position, flat.nodes.position);
  EXPECT_EQ(found.mesh.nodes.mass, flat.nodes.mass);
  EXPECT_EQ(found.mesh.yarns.node, flat.yarns.node);
  EXPECT_EQ(found.mesh.yarns.section, flat.yarns.section);
  EXPECT_EQ(found.mesh.cells.node, flat.cells.node);
  ASSERT_EQ(found.mesh.sets.size(), flat.sets.size());
  for (std::size_t s = 0; s < flat.sets.size(); ++s) EXPECT_EQ(found.mesh.sets[s].node, flat.sets[s].node);
  const auto surface = tool_surface(read(parts), "punch");
  ASSERT_TRUE(surface.has_value());
  EXPECT_NE(surface->find("vertex -9 -9 7"), std::string::npos) << *surface;
  // a part that is no tool of the scene is left out, and said
  const ImportedMesh without = import(parts);
  EXPECT_EQ(without.mesh.cells.size(), 48);
  EXPECT_NE(without.notes.front().find("'PUNCH-1'"), std::string::npos);
}

TEST_F(FabricDeck, WhichPartIsTheFabricIsAsked) {
  const Lattice lattice;
  const std::string part =
      "*Part, name=PLY\n" + lattice.mesh() + lattice.set("bottom", 0) + lattice.set("top", lattice.b) + "*End Part\n";
  const std::string both = part +
                           "*Assembly, name=A\n*Instance, name=lower, part=PLY\n*End Instance\n"
                           "*Instance, name=upper, part=PLY\n0., 0., 3.\n*End Instance\n*End Assembly\n";
  const std::string what = refusal(both);
  EXPECT_NE(what.find("--part"), std::string::npos) << what;
  EXPECT_NE(what.find("'upper'"), std::string::npos) << what;
  EXPECT_EQ(import(both, "", "upper").mesh.nodes.position.front()[2], 3.0);
  EXPECT_NE(refusal(both, "PLY").find("2 instances"), std::string::npos);
  EXPECT_NE(refusal(both, "middle").find("no part or instance"), std::string::npos);
  const std::string apart =
      "*Part, name=YARNS\n*Node\n1,0,0,0\n2,9,0,0\n*Element, type=T3D2\n1,1,2\n*End Part\n" + punch;
  EXPECT_NE(refusal(apart).find("no part has both"), std::string::npos) << refusal(apart);
}

// CAE keeps coordinates in single precision; rounding at any height is taken out, a tenth of a percent of a cell is
// not.
TEST_F(FabricDeck, SinglePrecisionIsFlatAtAnyHeight) {
  Lattice lattice;
  const Mesh exact = import(lattice.flat_deck()).mesh;
  for (const auto& [z, noise] : {std::pair{0.0, 2.2e-7}, std::pair{50.0, 3.8e-6}, std::pair{-3000.0, 2.4e-4}}) {
    lattice.z = z;
    lattice.noise = noise;
    const Mesh mesh = import(lattice.flat_deck()).mesh;
    EXPECT_EQ(mesh.nodes.mass, exact.nodes.mass) << z;
    for (const auto& x : mesh.nodes.position) EXPECT_EQ(x[2], mesh.nodes.position.front()[2]) << z;
    EXPECT_NEAR(mesh.nodes.position.front()[2], z, noise) << z;
  }
  lattice.z = 50.0;
  lattice.noise = 0.01;
  const std::string what = refusal(lattice.flat_deck());
  EXPECT_NE(what.find("z from 49.99 to 50.01 mm, 0.02 mm apart"), std::string::npos) << what;
}

TEST_F(FabricDeck, UnmergedNodesAreNamed) {
  const Lattice lattice;
  std::string text = lattice.flat_deck();
  text +=
      "*Node\n9001, 0., 0., 0.\n9002, 9.84, 0., 0.\n9003, 0., 9.84, 0.\n*Element, type=T3D2, elset=warp\n9001, 9001, "
      "9002\n"
      "*Element, type=T3D2, elset=weft\n9002, 9001, 9003\n*Element, type=S3\n9003, 9001, 9002, 9003\n";
  const std::string what = refusal(text);
  EXPECT_NE(what.find("nodes 1 and 9001"), std::string::npos) << what;
}

TEST_F(FabricDeck, AGripMayNotMeanTwoSets) {
  const Lattice lattice;
  const std::string deck = "*Part, name=FABRIC\n" + lattice.mesh() + lattice.set("bottom", 0) +
                           lattice.set("top", lattice.b) +
                           "*End Part\n*Assembly, name=A\n*Instance, name=F, part=FABRIC\n*End Instance\n" +
                           lattice.set("top", 3, ", instance=F") + "*End Assembly\n";
  const std::string what = refusal(deck);
  EXPECT_NE(what.find("grip 'top': two node sets"), std::string::npos) << what;
}

}  // namespace
}  // namespace weaveform
