// LS-DYNA and OpenRadioss files read back column by column by readers of their own, written from the formats' public
// descriptions (LS-DYNA keyword manual: *NODE I8, 3E16, *ELEMENT_* I8, cards of eight fields of 10; Radioss block
// format: integers of 10, reals of 20 columns): counts, coordinates, connectivity, sections, sets and motions.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "mesher/exchange/gathered.hpp"
#include "tests/support/deck_blocks.hpp"
#include "tests/support/exported_example.hpp"

namespace weaveform {
namespace {

using test::deck_blocks;
using test::DeckBlock;
using Case = test::ExportedExample;

// Cut cells of up to six nodes, jaws, ties.
const std::vector<std::string> cut = {"blank.coarsening=4", "blank.fit=none"};

// A field of fixed columns; must be there whole and must be a number and nothing else.
double field(const std::string& line, std::size_t from, std::size_t width) {
  EXPECT_GE(line.size(), from + width) << line;
  if (line.size() < from + width) return 0.0;
  const std::string text = line.substr(from, width);
  std::size_t used = 0;
  const double value = std::stod(text, &used);
  EXPECT_EQ(text.find_first_not_of(' ', used), std::string::npos) << "'" << text << "' in " << line;
  return value;
}
long whole(const std::string& line, std::size_t from, std::size_t width) {
  const double value = field(line, from, width);
  EXPECT_EQ(value, std::floor(value)) << line;
  return std::lround(value);
}

std::set<long> numbers_of(const std::vector<std::string>& lines, std::size_t first) {
  std::set<long> numbers;
  for (std::size_t k = first; k < lines.size(); ++k) {
    EXPECT_EQ(lines[k].size() % 10, 0U) << lines[k];
    for (std::size_t at = 0; at < lines[k].size(); at += 10) numbers.insert(whole(lines[k], at, 10));
  }
  return numbers;
}
std::set<long> numbers_of(const NodeSet& set) {
  std::set<long> numbers;
  for (const int n : set.node) numbers.insert(n + 1);
  return numbers;
}

struct ReadBack {
  std::map<long, std::array<double, 3>> node;
  std::map<long, std::pair<long, std::vector<long>>> line, shell;  // part, nodes
  std::map<long, double> part_area;                                // of lines' parts
  std::map<std::string, std::set<long>> set;
};

// Coordinates keep 10 digits or more in 16 or 19 characters.
void expect_is_mesh(const ReadBack& read, const Mesh& mesh) {
  ASSERT_EQ(read.node.size(), mesh.nodes.position.size());
  for (int n = 0; n < mesh.node_count(); ++n)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(read.node.at(n + 1)[c], mesh.nodes.position[n][c], 1e-9 * 115.0) << n;
  ASSERT_EQ(static_cast<int>(read.line.size()), mesh.yarn_count());
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const auto& [part, node] = read.line.at(e + 1);
    EXPECT_EQ(node, (std::vector<long>{mesh.yarns.node[e][0] + 1, mesh.yarns.node[e][1] + 1}));
    const double softening = mesh.yarns.softening[e] > 0.0 ? mesh.yarns.softening[e] : foreign::idle_share;
    // ten characters leave at least five digits
    EXPECT_NEAR(read.part_area.at(part), mesh.yarns.section[e] * softening, 1e-5 * mesh.yarns.section[e] * softening);
  }
  // The shells of a cell cover it: their areas add up to the polygon's, their corners are its nodes.
  const auto shells = foreign::shells_of(mesh.cells);
  ASSERT_EQ(read.shell.size(), shells.size());
  std::vector<std::set<long>> corners(mesh.cells.size());
  std::vector<double> area(mesh.cells.size(), 0.0);
  const auto polygon = [&](const std::vector<long>& node) {
    double sum = 0.0;
    for (std::size_t k = 0; k < node.size(); ++k) {
      const auto& a = read.node.at(node[k]);
      const auto& b = read.node.at(node[(k + 1) % node.size()]);
      sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    return sum;
  };
  for (std::size_t k = 0; k < shells.size(); ++k) {
    const auto& node = read.shell.at(mesh.yarn_count() + 1 + static_cast<long>(k)).second;
    corners[shells[k].cell].insert(node.begin(), node.end());
    EXPECT_GT(polygon(node), 0.0) << "counter-clockwise, and not degenerate";
    area[shells[k].cell] += polygon(node);
  }
  for (int c = 0; c < mesh.cells.size(); ++c) {
    std::vector<long> node;
    for (int k = mesh.cells.offset[c]; k < mesh.cells.offset[c + 1]; ++k) node.push_back(mesh.cells.node[k] + 1);
    EXPECT_EQ(corners[c], std::set<long>(node.begin(), node.end()));
    EXPECT_NEAR(area[c], polygon(node), 1e-9 * polygon(node));
  }
  for (const auto& set : mesh.sets) EXPECT_EQ(read.set.at(set.name), numbers_of(set)) << set.name;
}

ReadBack read_lsdyna(const std::string& text) {
  ReadBack read;
  std::map<long, long> section_of;  // of a part
  std::map<long, double> area;      // of a section
  const auto blocks = deck_blocks(text, '*', '$');
  EXPECT_EQ(blocks.front().keyword, "*KEYWORD");
  EXPECT_EQ(blocks.back().keyword, "*END");
  for (const auto& block : blocks) {
    const auto& lines = block.line;
    if (block.keyword == "*NODE") {
      for (const auto& line : lines) {
        EXPECT_EQ(line.size(), 56U) << line;
        read.node[whole(line, 0, 8)] = {field(line, 8, 16), field(line, 24, 16), field(line, 40, 16)};
      }
    } else if (block.keyword == "*ELEMENT_DISCRETE" || block.keyword == "*ELEMENT_SEATBELT") {
      for (const auto& line : lines) {
        read.line[whole(line, 0, 8)] = {whole(line, 8, 8), {whole(line, 16, 8), whole(line, 24, 8)}};
        if (block.keyword == "*ELEMENT_DISCRETE") read.part_area[whole(line, 8, 8)] = field(line, 40, 16);
      }
    } else if (block.keyword == "*ELEMENT_SHELL") {
      for (const auto& line : lines) {
        EXPECT_EQ(line.size(), 48U) << line;
        std::vector<long> node;
        for (std::size_t k = 2; k < 6; ++k) node.push_back(whole(line, 8 * k, 8));
        if (node[2] == node[3]) node.pop_back();
        read.shell[whole(line, 0, 8)] = {whole(line, 8, 8), node};
      }
    } else if (block.keyword == "*PART") {
      section_of[whole(lines.at(1), 0, 10)] = whole(lines.at(1), 10, 10);
    } else if (block.keyword == "*SECTION_SEATBELT") {
      area[whole(lines.at(0), 0, 10)] = field(lines.at(0), 10, 10);
    } else if (block.keyword == "*SET_NODE_LIST_TITLE" || block.keyword == "*SET_DISCRETE_TITLE") {
      read.set[lines.at(0)] = numbers_of(lines, 2);
    }
  }
  for (const auto& [part, section] : section_of)
    if (area.count(section) != 0) read.part_area[part] = area[section];
  return read;
}

ReadBack read_openradioss(const std::string& text) {
  ReadBack read;
  std::map<long, long> property_of;
  std::map<long, double> area;
  EXPECT_EQ(text.rfind("#RADIOSS STARTER\n", 0), 0U);
  const auto blocks = deck_blocks(text, '/', '#');
  EXPECT_EQ(blocks.back().keyword, "/END");
  for (const auto& block : blocks) {
    const auto& lines = block.line;
    const auto id = [&] { return std::stol(block.keyword.substr(block.keyword.rfind('/') + 1)); };
    const auto is = [&](const std::string& word) { return block.keyword.rfind(word + "/", 0) == 0; };
    if (block.keyword == "/NODE") {
      for (const auto& line : lines) {
        EXPECT_EQ(line.size(), 70U) << line;
        read.node[whole(line, 0, 10)] = {field(line, 10, 20), field(line, 30, 20), field(line, 50, 20)};
      }
    } else if (is("/SPRING")) {
      for (const auto& line : lines) read.line[whole(line, 0, 10)] = {id(), {whole(line, 10, 10), whole(line, 20, 10)}};
    } else if (is("/SHELL") || is("/SH3N")) {
      for (const auto& line : lines) {
        std::vector<long> node;
        for (std::size_t k = 1; k <= (is("/SHELL") ? 4U : 3U); ++k) node.push_back(whole(line, 10 * k, 10));
        EXPECT_EQ(line.size(), 10 * (node.size() + 1)) << line;
        read.shell[whole(line, 0, 10)] = {id(), node};
      }
    } else if (is("/PART")) {
      property_of[id()] = whole(lines.at(1), 0, 10);
    } else if (is("/PROP/SPRING")) {
      area[id()] = field(lines.at(2), 40, 20);  // field A
    } else if (is("/GRNOD/NODE")) {
      read.set[lines.at(0)] = numbers_of(lines, 1);
    }
  }
  for (const auto& [part, property] : property_of)
    if (area.count(property) != 0) read.part_area[part] = area[property];
  return read;
}

TEST(ExportColumns, LsdynaHoldsTheMesh) {
  const Case model(cut);
  const ReadBack read = read_lsdyna(model.written(MeshFormat::lsdyna).text);
  expect_is_mesh(read, model.mesh);
  for (int e = 0; e < model.mesh.yarn_count(); ++e)
    EXPECT_EQ(read.set.at(model.mesh.yarns.family[e] == Family::warp ? "warp" : "weft").count(e + 1), 1U) << e;
}

TEST(ExportColumns, LsdynaSeatbeltsCarryTheCardsForce) {
  std::vector<std::string> overrides = cut;
  overrides.push_back("model.yarn=seatbelt");
  const Case model(overrides);
  const std::string text = model.written(MeshFormat::lsdyna).text;
  expect_is_mesh(read_lsdyna(text), model.mesh);
  // Force by engineering strain of the first group: N = s(ln(1 + x)) A / (1 + x).
  const auto blocks = deck_blocks(text, '*', '$');
  const auto curve = std::find_if(blocks.begin(), blocks.end(), [](const DeckBlock& block) {
    return block.keyword == "*DEFINE_CURVE" && whole(block.line[0], 0, 10) == 101;
  });
  ASSERT_NE(curve, blocks.end());
  const double section = read_lsdyna(text).part_area.at(1);
  for (std::size_t k = 1; k < curve->line.size(); ++k) {
    const double x = field(curve->line[k], 0, 20), force = field(curve->line[k], 20, 20);
    const double expected = model.card.yarn[0].tension.stress(std::log1p(x)) * section / (1.0 + x);
    EXPECT_NEAR(force, expected, 1e-6 * expected + 1e-9);
  }
}

TEST(ExportColumns, OpenRadiossHoldsTheMesh) {
  const Case model(cut);
  const ReadBack read = read_openradioss(model.written(MeshFormat::openradioss).text);
  expect_is_mesh(read, model.mesh);
  EXPECT_EQ(static_cast<int>(read.set.at("all_nodes").size()), model.mesh.node_count());
}

// sum of alpha times position is zero at the start: the tied end lies where its tie says.
TEST(ExportColumns, TiesHoldAtTheStart) {
  const Case model(cut);
  ASSERT_GT(model.mesh.tie.size(), 0U);
  const auto& x = model.mesh.nodes.position;
  std::size_t dyna = 0, radioss = 0;
  const auto check = [&](const std::vector<std::string>& lines, std::size_t first, std::size_t at) {
    std::array<double, 3> sum{};
    ASSERT_EQ(lines.size(), first + 3);
    for (std::size_t k = first; k < lines.size(); ++k) {
      const long node = whole(lines[k], 0, 10), axis = whole(lines[k], 10, 10);
      sum[axis - 1] += field(lines[k], at, at == 20 ? 10 : 20) * x[node - 1][axis - 1];
    }
    // ten characters of a coefficient near 1 are eight digits, times 115 mm
    for (const double s : sum) EXPECT_NEAR(s, 0.0, 1e-5);
  };
  for (const auto& block : deck_blocks(model.written(MeshFormat::lsdyna).text, '*', '$'))
    if (block.keyword == "*CONSTRAINED_LINEAR_GLOBAL") ++dyna, check(block.line, 1, 20);
  for (const auto& block : deck_blocks(model.written(MeshFormat::openradioss).text, '/', '#'))
    if (block.keyword.rfind("/MPC/", 0) == 0) ++radioss, check(block.line, 1, 30);
  EXPECT_EQ(dyna, 3 * model.mesh.tie.size());
  EXPECT_EQ(radioss, 3 * model.mesh.tie.size());
}

TEST(ExportColumns, GripsMoveByTheirTravelAndToolsByTheirs) {
  const Case model(cut);
  const std::string dyna = model.written(MeshFormat::lsdyna).text;
  double travel = 0.0;
  int motions = 0;
  for (const auto& block : deck_blocks(dyna, '*', '$')) {
    if (block.keyword != "*BOUNDARY_PRESCRIBED_MOTION_SET") continue;
    ++motions;
    const auto& line = block.line.at(0);
    EXPECT_EQ(whole(line, 20, 10), 2) << "displacement";
    if (whole(line, 0, 10) == 2 && whole(line, 10, 10) == 2) travel = field(line, 40, 10);
  }
  EXPECT_EQ(motions, 6);
  EXPECT_EQ(travel, 30.0);
  for (const auto& block : deck_blocks(model.written(MeshFormat::openradioss).text, '/', '#'))
    if (block.keyword.rfind("/IMPDISP/", 0) == 0) {
      EXPECT_EQ(block.line.at(1).substr(10, 10), "         Y");
      EXPECT_EQ(field(block.line.at(2), 20, 20), 30.0);
    }
  const Case formed({"blank.coarsening=8"}, "hemisphere_pw");
  int walls = 0;
  for (const auto& block : deck_blocks(formed.written(MeshFormat::lsdyna).text, '*', '$'))
    if (block.keyword == "*RIGIDWALL_GEOMETRIC_SPHERE_MOTION_ID") {
      ++walls;
      EXPECT_EQ(field(block.line.at(3), 0, 10), 75.0) << "radius";
    }
  EXPECT_EQ(walls, 1);
}

// What a format leaves out is said in the file and handed to the caller for the log.
TEST(ExportColumns, NothingIsDroppedSilently) {
  const Case model(cut);
  const Case formed({"blank.coarsening=8"}, "hemisphere_pw");
  for (const auto format : {MeshFormat::abaqus, MeshFormat::lsdyna, MeshFormat::openradioss, MeshFormat::gmsh}) {
    const ExportedMesh file = model.written(format);
    for (const std::string word : {"jaws:", "free ends:", "cut cells:", "areas:", "masses:"}) {
      const bool listed = std::any_of(file.not_carried.begin(), file.not_carried.end(),
                                      [&](const std::string& line) { return line.rfind(word, 0) == 0; });
      EXPECT_TRUE(listed) << word;
    }
    for (const auto& line : file.not_carried) EXPECT_NE(file.text.find("- " + line), std::string::npos) << line;
  }
  for (const auto format : {MeshFormat::lsdyna, MeshFormat::openradioss}) {
    const ExportedMesh file = formed.written(format);
    for (const std::string tool : {"die", "binder", "punch"})
      EXPECT_TRUE(std::any_of(file.not_carried.begin(), file.not_carried.end(), [&](const std::string& line) {
        return line.rfind("tool '" + tool, 0) == 0;
      })) << tool;
  }
}

TEST(ExportColumns, NumbersKeepTheDigitsThatFit) {
  EXPECT_EQ(foreign::fit(0.1, 10), "0.1");
  EXPECT_EQ(foreign::fit(-0.0, 10), "0");
  for (const double value : {1.0 / 3.0, -1.0 / 3.0, 1.07e9, -123456.789012345, 1.2345678901e-12, -9.87654321e-101}) {
    const std::string text = foreign::fit(value, 10);
    EXPECT_LE(text.size(), 10U);
    EXPECT_NEAR(std::stod(text), value, 1e-3 * std::abs(value)) << text;
    EXPECT_NEAR(std::stod(foreign::fit(value, 16)), value, 1e-8 * std::abs(value));
  }
}

}  // namespace
}  // namespace weaveform
