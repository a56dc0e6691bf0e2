// Meshes read back: our own bit for bit, others' recovered from their geometry; wrong files refused with line and
// reason.
#include "mesher/exchange/import.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "mesher/exchange/export.hpp"
#include "mesher/lattice/build.hpp"
#include "mesher/scene/reader.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/same_mesh.hpp"

namespace weaveform {
namespace {

using test::TemporaryFolder;
using test::write_text;

struct ImportCase {
  Scene scene;
  Card card;
  Mesh mesh;
  explicit ImportCase(const std::vector<std::string>& overrides, const std::string& example = "bias_extension_pw")
      : scene(read_scene(std::string(WEAVEFORM_SOURCE_DIR) + "/examples/" + example + ".toml", overrides)),
        card(load_card(scene.fabric.material, scene.file)),
        mesh(build_mesh(scene, card)) {}
  [[nodiscard]] std::string written(MeshFormat format) const {
    return export_mesh(format, scene, card, mesh, make_tools(scene, mesh), 0.5, "test").text;
  }
};

// As another program would write it.
std::string without_weave_lines(const std::string& text) {
  std::string kept;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at) + 1;
    const std::string line = text.substr(at, end - at);
    if (line.rfind("** weaveform", 0) != 0) kept += line;
    at = end;
  }
  const std::size_t from = kept.find("$Weaveform\n"), to = kept.find("$EndWeaveform\n");
  if (from != std::string::npos) kept.erase(from, to + 14 - from);
  return kept;
}

ForeignMesh read_text_as(const std::string& text, const std::string& ending) {
  const TemporaryFolder folder;
  const auto file = folder.path() / ("mesh" + ending);
  write_text(text, file);
  return read_foreign_mesh(file);
}

const std::vector<std::string> cut_at_45 = {"blank.coarsening=4", "blank.fit=none"};

TEST(ImportOwn, ComesBackBitForBit) {
  const ImportCase blank(cut_at_45), frame({"blank.coarsening=4"}, "shear_frame_tw"),
      formed({"blank.coarsening=8"}, "hemisphere_pw");
  for (const ImportCase* model : {&blank, &frame, &formed})
    for (const auto& [format, ending] : {std::pair{MeshFormat::abaqus, ".inp"}, std::pair{MeshFormat::gmsh, ".msh"}}) {
      const ImportedMesh back = import_own(read_text_as(model->written(format), ending));
      test::expect_same_mesh(back.mesh, model->mesh);
      EXPECT_EQ(back.scene, scene_to_toml(with_absolute_paths(model->scene)));
    }
}

// A file edited after Weaveform wrote it must not be taken for what it was.
TEST(ImportOwn, RefusesAFileThatWasChanged) {
  const ImportCase model({"blank.coarsening=4"});
  const std::string text = model.written(MeshFormat::abaqus);
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string other = text;
    const std::size_t at = other.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    other.replace(at, from.size(), to);
    return other;
  };
  const std::vector<std::array<std::string, 2>> edits = {
      {"\n4, 0, -115.00000000000001, 0\n", "\n4, 0.5, -115.00000000000001, 0\n"},  // a node moved
      {"*NSET, NSET=top\n", "*NSET, NSET=head\n"},                                 // a set renamed
      {"** weaveform tie", "** weaveform knot"},
      {"** weaveform size 77", "** weaveform size 78"},
      {"** weaveform end", "** weaveform"}};
  for (const auto& [from, to] : edits) {
    if (text.find(from) == std::string::npos) continue;  // this mesh has no tie
    EXPECT_THROW((void)import_own(read_text_as(changed(from, to), ".inp")), InputError) << from;
  }
  EXPECT_THROW((void)import_own(read_text_as(without_weave_lines(text), ".inp")), InputError);
}

// A rectangle along its yarns whose outline lies on yarns has only whole cells: everything of it can be recovered.
// Text keeps at least 13 digits, so lengths come back to 1e-10 of a spacing.
TEST(ImportForeign, RecoversAWholeLattice) {
  const ImportCase model({"blank.coarsening=4", "blank.yarn_angle=0", "blank.size=[98.4,196.8]"});
  for (const auto& [format, ending] : {std::pair{MeshFormat::abaqus, ".inp"}, std::pair{MeshFormat::gmsh, ".msh"}}) {
    const ForeignMesh file = read_text_as(without_weave_lines(model.written(format)), ending);
    const Mesh mesh = import_foreign(file, model.scene, model.card).mesh;
    ASSERT_EQ(mesh.node_count(), model.mesh.node_count());
    ASSERT_EQ(mesh.cells.size(), model.mesh.cells.size());
    EXPECT_EQ(mesh.lattice_size, model.mesh.lattice_size);
    const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-10 * std::max(std::abs(a), 1e-300); };
    EXPECT_TRUE(same(mesh.spacing[0], model.mesh.spacing[0]) && same(mesh.spacing[1], model.mesh.spacing[1]));
    const auto total = [](const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); };
    EXPECT_NEAR(total(mesh.nodes.mass), total(model.mesh.nodes.mass), 1e-10 * total(model.mesh.nodes.mass));
    EXPECT_NEAR(total(mesh.yarns.section), total(model.mesh.yarns.section), 1e-9 * total(model.mesh.yarns.section));
    for (const auto& grip : {"bottom", "top"}) {
      const auto of = [&](const Mesh& m) {
        return std::find_if(m.sets.begin(), m.sets.end(), [&](const NodeSet& s) { return s.name == grip; })
            ->node.size();
      };
      EXPECT_EQ(of(mesh), of(model.mesh));
    }
  }
}

// Yarn rows and families do not hang on the order, the direction or the numbers of the file's elements.
TEST(ImportForeign, TakesElementsInAnyOrderAndDirection) {
  const ImportCase model({"blank.coarsening=4"});
  ForeignMesh file = read_text_as(without_weave_lines(model.written(MeshFormat::abaqus)), ".inp");
  const ImportedMesh as_written = import_foreign(file, model.scene, model.card);
  file.element_sets.clear();  // families from the lines' directions alone
  std::reverse(file.lines.begin(), file.lines.end());
  std::reverse(file.shells.begin(), file.shells.end());
  for (std::size_t k = 0; k < file.lines.size(); k += 2) std::swap(file.lines[k].node[0], file.lines[k].node[1]);
  for (std::size_t k = 0; k < file.shells.size(); k += 3)
    std::reverse(file.shells[k].node.begin(), file.shells[k].node.end());
  const ImportedMesh turned = import_foreign(file, model.scene, model.card);
  EXPECT_EQ(turned.mesh.nodes.crossing, as_written.mesh.nodes.crossing);
  ASSERT_EQ(turned.mesh.yarn_count(), as_written.mesh.yarn_count());
  const int last = turned.mesh.yarn_count() - 1;
  for (int e = 0; e <= last; ++e) {
    EXPECT_EQ(turned.mesh.yarns.node[last - e], as_written.mesh.yarns.node[e]);
    EXPECT_EQ(turned.mesh.yarns.family[last - e], as_written.mesh.yarns.family[e]);
    EXPECT_NEAR(turned.mesh.yarns.yarns[last - e], as_written.mesh.yarns.yarns[e], 1e-9);
  }
}

// Totals that the mechanics hang on, whatever the outline: area of the shells, yarn length = area / interval.
TEST(ImportForeign, KeepsAreaAndYarnLengthOfCutBlanks) {
  const ImportCase model(cut_at_45);
  const ForeignMesh file = read_text_as(without_weave_lines(model.written(MeshFormat::gmsh)), ".msh");
  const Mesh mesh = import_foreign(file, model.scene, model.card).mesh;
  const double area = std::accumulate(mesh.cells.area.begin(), mesh.cells.area.end(), 0.0);
  EXPECT_LT(std::abs(area / (115.0 * 230.0) - 1.0), 0.02) << "corners without a node are cut_at_45 off";
  for (const Family family : {Family::warp, Family::weft}) {
    double length = 0.0;
    for (int e = 0; e < mesh.yarn_count(); ++e)
      if (mesh.yarns.family[e] == family) length += mesh.yarns.yarns[e] * mesh.yarns.rest_length[e];
    EXPECT_NEAR(length, area / model.card.yarn[0].interval, 1e-9 * length);
  }
}

TEST(ImportForeign, SaysWhatDoesNotFit) {
  const ImportCase model({"blank.coarsening=4"});
  const ForeignMesh file = read_text_as(without_weave_lines(model.written(MeshFormat::abaqus)), ".inp");
  const auto complaint = [&](const ForeignMesh& mesh, const Scene& scene) -> std::string {
    try {
      (void)import_foreign(mesh, scene, model.card);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto says = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_EQ(complaint(file, model.scene), "");
  ForeignMesh other = file;
  other.position[20][2] = 1.0;
  EXPECT_TRUE(says(complaint(other, model.scene), "not flat"));
  other = file;
  other.position[36][0] += 1.0;
  EXPECT_TRUE(says(complaint(other, model.scene), "off"));
  other = file;
  other.lines.clear();
  EXPECT_TRUE(says(complaint(other, model.scene), "no yarns"));
  other = file;
  other.shells.clear();
  EXPECT_TRUE(says(complaint(other, model.scene), "no cells"));
  other = file;
  other.lines.push_back(other.lines.front());
  for (auto& set : other.element_sets)
    if (set.name == "WARP") set.line.push_back(static_cast<int>(other.lines.size()) - 1);
  EXPECT_TRUE(says(complaint(other, model.scene), "lies on another line"));
  Scene scene = model.scene;
  scene.grip[0].name = "foot";
  EXPECT_TRUE(says(complaint(file, scene), "'foot': the mesh has no node set"));
}

// A hybrid file written by hand: two warp and two weft yarns... and a tool beside them, in one .inp.
TEST(ImportForeign, LeavesTheToolsShellsOutAndGivesThemAsASurface) {
  const ImportCase model({"blank.coarsening=4"});
  std::string text = without_weave_lines(model.written(MeshFormat::abaqus));
  const std::string tool =
      "*NODE\n9001, 0, 0, 50\n9002, 10, 0, 50\n9003, 10, 10, 50\n9004, 0, 10, 50\n"
      "*ELEMENT, TYPE=R3D4, ELSET=Punch\n9001, 9001, 9002, 9003, 9004\n";
  text.insert(text.find("*ELSET, ELSET=WARP"), tool);
  const ForeignMesh file = read_text_as(text, ".inp");
  Scene scene = model.scene;
  ToolSpec punch;
  punch.name = "punch";
  punch.shape = ToolShape::triangles;
  scene.tools.push_back(punch);
  EXPECT_EQ(import_foreign(file, scene, model.card).mesh.cells.size(), model.mesh.cells.size());
  const auto surface = tool_surface(file, "punch");
  ASSERT_TRUE(surface.has_value());
  std::size_t facets = 0;
  for (std::size_t at = 0; (at = surface->find("endfacet", at)) != std::string::npos; ++at) ++facets;
  EXPECT_EQ(facets, 2U);
  EXPECT_FALSE(tool_surface(file, "die").has_value());
}

struct Malformed {
  std::string name, ending, text;
  int line;            // that the complaint names
  std::string reason;  // part of it
};

class MalformedFile : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedFile, IsRefusedWithLineAndReason) {
  const Malformed& wrong = GetParam();
  try {
    (void)read_text_as(wrong.text, wrong.ending);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find(":" + std::to_string(wrong.line) + ": "), std::string::npos) << what;
    EXPECT_NE(what.find(wrong.reason), std::string::npos) << what;
  }
}

const std::string msh = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string nodes = "$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n";  // lines 4 to 13
const std::string inp = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n";

INSTANTIATE_TEST_SUITE_P(
    Msh, MalformedFile,
    testing::Values(
        Malformed{"NotMsh", ".msh", "hello\n", 1, "section"},
        Malformed{"VersionBetween", ".msh", "$MeshFormat\n4 0 8\n$EndMeshFormat\n", 2, "2.2 and 4.1"},
        Malformed{"VersionOne", ".msh", "$NOD\n1\n1 0 0 0\n$ENDNOD\n", 1, "version 1"},
        Malformed{"NoFormat", ".msh", "$Nodes\n", 1, "$MeshFormat"},
        Malformed{"CutShort", ".msh", msh + "$Nodes\n1 3 1 3\n2 1 0 3\n1\n", 7, "too early"},
        Malformed{"WordForNumber", ".msh", msh + "$Nodes\n1 1 1 1\n2 1 0 1\n1\n0 zero 0\n$EndNodes\n", 8, "'zero'"},
        Malformed{"NotFinite", ".msh", msh + "$Nodes\n1 1 1 1\n2 1 0 1\n1\n0 nan 0\n$EndNodes\n", 8, "finite"},
        Malformed{"NodeTwice", ".msh", msh + "$Nodes\n1 2 1 2\n2 1 0 2\n1\n1\n0 0 0\n1 0 0\n$EndNodes\n", 10, "twice"},
        Malformed{"SecondOrder", ".msh", msh + nodes + "$Elements\n1 1 1 1\n2 1 21 1\n", 16, "type 21"},
        Malformed{"MissingNode", ".msh", msh + nodes + "$Elements\n1 1 1 1\n2 1 2 1\n1 1 2 7\n$EndElements\n", 17,
                  "node 7"},
        Malformed{"TooFewNodes", ".msh", msh + nodes + "$Elements\n1 1 1 1\n2 1 2 1\n1 1 2\n$EndElements\n", 17,
                  "expected"},
        Malformed{"WrongCount", ".msh", msh + nodes + "$Elements\n1 2 1 2\n2 1 2 1\n1 1 2 3\n$EndElements\n", 17,
                  "announced"},
        Malformed{"SectionWithoutEnd", ".msh", msh + nodes + "$Weaveform\nweave 1\n", 15, "(line 14) has no end"}),
    [](const auto& instance) { return instance.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Inp, MalformedFile,
    testing::Values(Malformed{"NotInp", ".inp", "hello\n", 1, "keyword"},
                    Malformed{"OneField", ".inp", "*NODE\n1\n", 2, "its coordinates"},
                    Malformed{"WordForNumber", ".inp", "*NODE\n1, 0, x, 0\n", 2, "'x'"},
                    Malformed{"NodeTwice", ".inp", inp + "3, 1, 1, 0\n", 5, "twice"},
                    Malformed{"UnknownType", ".inp", inp + "*ELEMENT, TYPE=B32\n", 5, "B32"},
                    Malformed{"MissingNode", ".inp", inp + "*ELEMENT, TYPE=T3D2\n1, 1, 9\n", 6, "node 9"},
                    Malformed{"WrongNumberOfNodes", ".inp", inp + "*ELEMENT, TYPE=M3D4\n1, 1, 2, 3\n", 6, "4 nodes"},
                    Malformed{"ElementTwice", ".inp", inp + "*ELEMENT, TYPE=T3D2\n1, 1, 2\n1, 2, 3\n", 7, "twice"},
                    Malformed{"SetOfNothing", ".inp", inp + "*NSET, NSET=a\nb\n", 6, "'b'"},
                    Malformed{"SetMissingNode", ".inp", inp + "*NSET, NSET=a\n1, 8\n", 6, "node 8"},
                    Malformed{"Generate", ".inp", inp + "*NSET, NSET=a, GENERATE\n3, 1, 1\n", 6, "not below"},
                    Malformed{"InstanceOfNothing", ".inp", inp + "*INSTANCE, NAME=a, PART=b\n0, 0, 1\n", 5,
                              "*INSTANCE"}),
    [](const auto& instance) { return instance.param.name; });

// Bytes of a binary file.
template <class... Value>
std::string bytes(Value... value) {
  std::string text;
  (text.append(reinterpret_cast<const char*>(&value), sizeof value), ...);
  return text;
}
std::string turned(std::string text) {
  std::reverse(text.begin(), text.end());
  return text;
}

// A square and its edge in a group, the edge in a second group too: in every version and encoding the same mesh.
TEST(MshFile, VersionsAndEncodingsReadTheSame) {
  const std::string names = "$PhysicalNames\n3\n1 1 \"edge\"\n1 2 \"side\"\n2 3 \"skin\"\n$EndPhysicalNames\n";
  const std::string text_2 = "$MeshFormat\r\n2.2 0 8\r\n$EndMeshFormat\r\n" + names +
                             "$Nodes\n4\n10 0 0 0\n11 1 0 0\n12 1 1 0\n13 0 1 0.5\n$EndNodes\n$Elements\n3\n"
                             "1 1 2 1 1 10 11\n1 1 2 2 1 10 11\n2 3 2 3 1 10 11 12 13\n$EndElements\n";
  const std::string binary_2 = "$MeshFormat\n2.2 1 8\n" + bytes(1) + "\n$EndMeshFormat\n" + names + "$Nodes\n4\n" +
                               bytes(10) + bytes(0.0, 0.0, 0.0) + bytes(11) + bytes(1.0, 0.0, 0.0) + bytes(12) +
                               bytes(1.0, 1.0, 0.0) + bytes(13) + bytes(0.0, 1.0, 0.5) + "\n$EndNodes\n$Elements\n3\n" +
                               bytes(1, 2, 2, 1, 1, 1, 10, 11, 1, 2, 1, 10, 11) +
                               bytes(3, 1, 2, 2, 3, 1, 10, 11, 12, 13) + "\n$EndElements\n";
  using Size = std::uint64_t;
  const auto four = [&](bool swap) {
    const auto order = [&](auto... value) { return swap ? (turned(bytes(value)) + ...) : (bytes(value) + ...); };
    return "$MeshFormat\n4.1 1 8\n" + order(1) + "\n$EndMeshFormat\n" + names + "$Entities\n" +
           order(Size{0}, Size{1}, Size{1}, Size{0}) + order(1, 0., 0., 0., 1., 0., 0., Size{2}, 1, 2, Size{2}, 1, -2) +
           order(1, 0., 0., 0., 1., 1., 0., Size{1}, 3, Size{1}, 1) + "\n$EndEntities\n$Nodes\n" +
           order(Size{1}, Size{4}, Size{10}, Size{13}) + order(2, 1, 0, Size{4}) +
           order(Size{10}, Size{11}, Size{12}, Size{13}) + order(0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.5) +
           "\n$EndNodes\n$Elements\n" + order(Size{2}, Size{2}, Size{1}, Size{2}) +
           order(1, 1, 1, Size{1}, Size{1}, Size{10}, Size{11}) +
           order(2, 1, 3, Size{1}, Size{2}, Size{10}, Size{11}, Size{12}, Size{13}) + "\n$EndElements\n";
  };
  for (const std::string& text : {text_2, binary_2, four(false), four(true)}) {
    const ForeignMesh mesh = read_text_as(text, ".msh");
    EXPECT_EQ(mesh.number, (std::vector<long>{10, 11, 12, 13}));
    EXPECT_EQ(mesh.position[3], (std::array<double, 3>{0.0, 1.0, 0.5}));
    ASSERT_EQ(mesh.lines.size(), 1U) << "an element of two groups is one element";
    ASSERT_EQ(mesh.shells.size(), 1U);
    EXPECT_EQ(mesh.shells[0].node, (std::vector<int>{0, 1, 2, 3}));
    ASSERT_EQ(mesh.element_sets.size(), 3U);
    EXPECT_EQ(mesh.element_sets[0].name, "edge");
    EXPECT_EQ(mesh.element_sets[1].name, "side");
    EXPECT_EQ(mesh.element_sets[1].line, std::vector<int>{0});
    EXPECT_EQ(shells_named(mesh, "skin"), std::vector<int>{0});
    for (std::size_t part = 30; part < text.size() - 20; part += 7)
      EXPECT_THROW((void)read_text_as(text.substr(0, part), ".msh"), InputError) << part;
  }
}

TEST(MshFile, SecondOrderGivesItsCornersAndVolumesAreLeftOut) {
  const ForeignMesh mesh = read_text_as(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 .5 0 0\n5 .5 .5 0\n6 0 .5 0\n"
      "$EndNodes\n$Elements\n3\n1 9 0 1 2 3 4 5 6\n2 8 0 1 2 4\n3 4 0 1 2 3 6\n$EndElements\n",
      ".MSH");
  EXPECT_EQ(mesh.shells.at(0).node, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(mesh.lines.at(0).node, (std::vector<int>{0, 1}));
  EXPECT_EQ(mesh.notes.size(), 2U);
}

TEST(ForeignFile, OtherEndingsAndMissingFilesAreNamed) {
  EXPECT_THROW((void)read_foreign_mesh("mesh.stl"), InputError);
  EXPECT_THROW((void)read_foreign_mesh("nowhere.msh"), FileError);
}

}  // namespace
}  // namespace weaveform
