// The laws that decks of other codes carry, evaluated from the decks and compared with the solver's own: forces of yarn
// elements, stress power of sheared cells.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "mesher/exchange/cell_springs.hpp"
#include "mesher/exchange/gathered.hpp"
#include "solver/element/yarn_law.hpp"
#include "tests/support/deck_blocks.hpp"
#include "tests/support/exported_example.hpp"

namespace weaveform {
namespace {

using test::deck_blocks;
using test::deck_curve;
using test::deck_real;
using test::deck_whole;
using test::DeckCurve;

struct LawCase : test::ExportedExample {
  using ExportedExample::ExportedExample;
  [[nodiscard]] std::string written(MeshFormat format) const { return ExportedExample::written(format).text; }
  // N; of yarn element e at length L, from the solver's law and the mesh (mesher/mesh/mesh.hpp).
  [[nodiscard]] double yarn_force(int e, double length) const {
    const auto& yarns = mesh.yarns;
    const double rest = yarns.rest_length[e] + yarns.jaw[e], whole = length + yarns.jaw[e];
    const auto law = yarn_laws(card, scene.model)[static_cast<std::size_t>(yarns.family[e])];
    const double area = yarns.section[e] * yarns.softening[e];
    return law.stress(std::log(whole / rest)) * area *
           (scene.model.section == Section::incompressible ? rest / whole : 1.0);
  }
};

// Cells of up to six nodes, jaws, softened and tied ends; slack, seatbelts, compression laws, another fabric.
std::vector<std::vector<std::string>> models() {
  const std::vector<std::string> cut = {"blank.coarsening=4", "blank.fit=none"};
  std::vector<std::vector<std::string>> all;
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
           {},
           {"model.yarn_law=linear", "model.section=constant"},
           {"model.yarn_law=slack"},
           {"fabric.material=twintex-tw", "model.compression_modulus=40", "model.yarn_stiffness_scale=3"}}) {
    all.push_back(cut);
    all.back().insert(all.back().end(), more.begin(), more.end());
  }
  return all;
}

// A force is right to the tables' error, and to 1e-5 of the force at 1 % of strain where it is nearly none.
void expect_force(double found, double expected, double typical, const std::string& where) {
  EXPECT_NEAR(found, expected, 3e-4 * std::abs(expected) + 1e-5 * typical) << where;
}

TEST(ExportLaws, OpenRadiossSpringsPullAsTheYarnsDo) {
  for (const auto& overrides : models()) {
    const LawCase model(overrides);
    std::map<int, std::vector<int>> elements;  // of a part
    std::map<int, int> function;
    std::map<int, double> factor, stretch;
    std::map<int, DeckCurve> curve;
    for (const auto& block : deck_blocks(model.written(MeshFormat::openradioss), '/', '#')) {
      if (block.is("/SPRING/"))
        for (const auto& line : block.line)
          elements[block.id()].push_back(static_cast<int>(deck_whole(line, 0, 10)) - 1);
      if (block.is("/PROP/SPRING/")) {
        EXPECT_EQ(deck_whole(block.line.at(1), 70, 10), 1) << "Ileng";
        EXPECT_GT(deck_real(block.line.at(1), 0, 20), 1e-15) << "a mass below 1e-15 is refused";
        factor[block.id()] = deck_real(block.line.at(2), 40, 20);
        function[block.id()] = static_cast<int>(deck_whole(block.line.at(3), 0, 10));
        stretch[block.id()] = deck_real(block.line.at(4), 40, 20);
      }
      if (block.is("/FUNCT/")) curve[block.id()] = deck_curve(block.line, 1);
    }
    int seen = 0;
    for (const auto& [part, own] : elements)
      for (const int e : own) {
        ++seen;
        const double rest = model.mesh.yarns.rest_length[e];
        const double typical = model.yarn_force(e, 1.01 * rest);
        if (model.mesh.yarns.softening[e] <= 0.0) {
          EXPECT_LT(factor[part], 1e-5 * model.mesh.yarns.section[e]) << "a tied free end bears nothing";
          continue;
        }
        for (const double x : {-0.1, -0.01, 0.0, 0.002, 0.01, 0.03, 0.06})
          expect_force(factor[part] * curve[function[part]].at(x / stretch[part]),
                       model.yarn_force(e, (1.0 + x) * rest), typical,
                       "element " + std::to_string(e) + " at " + std::to_string(x));
      }
    EXPECT_EQ(seen, model.mesh.yarn_count());
  }
}

TEST(ExportLaws, LsdynaSpringsPullAsTheYarnsDo) {
  for (const auto& overrides : models()) {
    const LawCase model(overrides);
    const auto blocks = deck_blocks(model.written(MeshFormat::lsdyna), '*', '$');
    std::map<long, long> material_of, curve_of;
    std::map<long, DeckCurve> curve;
    for (const auto& block : blocks) {
      if (block.is("*PART")) material_of[deck_whole(block.line.at(1), 0, 10)] = deck_whole(block.line.at(1), 20, 10);
      if (block.is("*MAT_SPRING_NONLINEAR_ELASTIC"))
        curve_of[deck_whole(block.line.at(0), 0, 10)] = deck_whole(block.line.at(0), 10, 10);
      if (block.is("*DEFINE_CURVE")) curve[deck_whole(block.line.at(0), 0, 10)] = deck_curve(block.line, 1);
    }
    int seen = 0;
    for (const auto& block : blocks) {
      if (!block.is("*ELEMENT_DISCRETE")) continue;
      for (const auto& line : block.line) {
        const int e = static_cast<int>(deck_whole(line, 0, 8)) - 1;
        ++seen;
        if (model.mesh.yarns.softening[e] <= 0.0) continue;
        const double rest = model.mesh.yarns.rest_length[e];
        const DeckCurve& law = curve[curve_of[material_of[deck_whole(line, 8, 8)]]];
        for (const double x : {-0.1, -0.01, 0.0, 0.002, 0.01, 0.03, 0.06})
          expect_force(deck_real(line, 40, 16) * law.at(x * rest), model.yarn_force(e, (1.0 + x) * rest),
                       model.yarn_force(e, 1.01 * rest), "element " + std::to_string(e) + " at " + std::to_string(x));
      }
    }
    EXPECT_EQ(seen, model.mesh.yarn_count());
  }
}

// Seatbelts and their partners are laws of the same springs.
TEST(ExportLaws, SpringsOfSeatbeltsBearNoCompressionWithoutAPartner) {
  for (const std::string partner : {"none", "compression"}) {
    const LawCase model({"blank.coarsening=4", "model.yarn=seatbelt", "model.partner=" + partner});
    for (const auto& block : deck_blocks(model.written(MeshFormat::openradioss), '/', '#'))
      if (block.is("/FUNCT/2")) {
        const double pressed = deck_curve(block.line, 1).at(-0.05);
        EXPECT_EQ(pressed < 0.0, partner == "compression") << pressed;
      }
  }
}

// N/mm of thickness: stress power of the solver's cell per flat area and thickness, d(w)/d(gamma) = S cos gamma.
double cell_power(const LawCase& model, double gamma) {
  const double share = model.scene.model.thickness == Thickness::constant ? std::cos(gamma) : 1.0;
  return share * shear_stress(model.card.shear, log_shear_strain(gamma)) * std::cos(gamma);
}

// A square of yarns of constant length, sheared by gamma: columns are the two directions.
Eigen::Matrix2d directions(double gamma) {
  Eigen::Matrix2d g;
  g << std::cos(0.5 * gamma), std::sin(0.5 * gamma), std::sin(0.5 * gamma), std::cos(0.5 * gamma);
  return g;
}

std::vector<std::vector<std::string>> fabrics() {
  return {{"blank.coarsening=4"},
          {"blank.coarsening=4", "fabric.material=twintex-tw"},
          {"blank.coarsening=4", "model.thickness=constant"}};
}

// LAW58 puts the stress t(angle) along m m - n n, m the bisector of the yarns, in a shell that keeps its thickness, so
// that its volume per flat area is t cos gamma; its power is that times stress : velocity gradient.
TEST(ExportLaws, OpenRadiossFabricShearsAsTheCellsDo) {
  for (const auto& overrides : fabrics()) {
    const LawCase model(overrides);
    DeckCurve table;
    int function = 0;
    double fibre = 0.0;
    const auto blocks = deck_blocks(model.written(MeshFormat::openradioss), '/', '#');
    for (const auto& block : blocks)
      if (block.is("/MAT/FABR_A/")) {
        fibre = deck_real(block.line.at(2), 0, 20);
        ASSERT_EQ(block.line.size(), 9U);
        function = static_cast<int>(deck_whole(block.line.at(8), 0, 10));
        EXPECT_EQ(deck_whole(block.line.at(6), 0, 10), 0) << "no function of the warp fibres";
      }
    for (const auto& block : blocks)
      if (block.is("/FUNCT/" + std::to_string(function))) table = deck_curve(block.line, 1);
    EXPECT_GT(fibre, 0.0);
    EXPECT_LT(fibre, 2e-3 * shear_tangent(model.card.shear, 0.0));
    for (const double degrees : {-60.0, -20.0, -1.0, 0.5, 5.0, 30.0, 45.0, 60.0}) {
      const double gamma = degrees * std::numbers::pi / 180.0, h = 1e-5;
      const Eigen::Matrix2d rate = (directions(gamma + h) - directions(gamma - h)) / (2.0 * h);
      const Eigen::Matrix2d velocity = rate * directions(gamma).inverse();
      const Eigen::Vector2d m = directions(gamma).rowwise().sum().normalized(), n(-m[1], m[0]);
      const Eigen::Matrix2d stress = table.at(degrees) * (m * m.transpose() - n * n.transpose());
      const double power = std::cos(gamma) * stress.cwiseProduct(velocity).sum();
      EXPECT_NEAR(power, cell_power(model, gamma), 2e-4 * std::abs(cell_power(model, gamma)) + 1e-6) << degrees;
    }
  }
}

// The starter refuses a fabric whose shear curve falls anywhere (error 1583). Where a card's own falls, the deck says
// by how much it was changed.
TEST(ExportLaws, OpenRadiossShearCurvesRise) {
  for (const auto& overrides : fabrics()) {
    LawCase model(overrides);
    for (const bool falling : {false, true}) {
      if (falling) model.card.shear.tangent = TangentLaw({{0.0, 0.3, {0.3}}, {0.3, 0.6, {-0.1}}, {0.6, 2.0, {0.3}}});
      const ExportedMesh file = export_mesh(MeshFormat::openradioss, model.scene, model.card, model.mesh,
                                            make_tools(model.scene, model.mesh), 0.5, "test");
      for (const auto& block : deck_blocks(file.text, '/', '#')) {
        if (!block.is("/FUNCT/4")) continue;
        const DeckCurve curve = deck_curve(block.line, 1);
        for (std::size_t k = 1; k < curve.point.size(); ++k)
          EXPECT_GT(curve.point[k][1], curve.point[k - 1][1]) << curve.point[k][0] << " deg";
      }
      EXPECT_EQ(
          std::any_of(file.not_carried.begin(), file.not_carried.end(),
                      [](const std::string& line) { return line.find("shear curve falls") != std::string::npos; }),
          falling);
    }
  }
}

// Second Piola-Kirchhoff stress S12 on the flat axes over s = 2 E12: power per flat volume S12 d(2 E12)/d gamma.
TEST(ExportLaws, LsdynaFabricShearsAsTheCellsDo) {
  for (const auto& overrides : fabrics()) {
    const LawCase model(overrides);
    DeckCurve table;
    long curve = 0;
    const auto blocks = deck_blocks(model.written(MeshFormat::lsdyna), '*', '$');
    for (const auto& block : blocks)
      if (block.is("*MAT_FABRIC")) {
        EXPECT_EQ(deck_real(block.line.at(2), 0, 10), 2.0) << "AOPT";
        EXPECT_EQ(deck_real(block.line.at(2), 50, 10), 14.0) << "FORM";
        EXPECT_NEAR(deck_real(block.line.at(3), 30, 10), std::sqrt(0.5), 1e-7) << "A1, warp at 45 deg";
        EXPECT_NEAR(deck_real(block.line.at(4), 30, 10), -std::sqrt(0.5), 1e-6) << "D1, weft at 135 deg";
        curve = deck_whole(block.line.at(5), 20, 10);
      }
    for (const auto& block : blocks)
      if (block.is("*DEFINE_CURVE") && deck_whole(block.line.at(0), 0, 10) == curve) table = deck_curve(block.line, 1);
    for (const double degrees : {-60.0, -20.0, -1.0, 0.5, 5.0, 30.0, 45.0, 60.0, 70.0}) {
      const double gamma = degrees * std::numbers::pi / 180.0, h = 1e-5;
      const Eigen::Matrix2d g = directions(gamma);
      EXPECT_NEAR(g.col(0).dot(g.col(1)), std::sin(gamma), 1e-12);
      const double rate = (std::sin(gamma + h) - std::sin(gamma - h)) / (2.0 * h);  // of 2 E12
      EXPECT_NEAR(table.at(std::sin(gamma)) * rate, cell_power(model, gamma),
                  2e-4 * std::abs(cell_power(model, gamma)) + 1e-6)
          << degrees;
    }
  }
}

// Springs across cells of three to six nodes, all sheared alike with yarns of constant length: their power is the
// cells'.
TEST(ExportLaws, CellSpringsStoreTheCellsEnergy) {
  for (const auto& overrides : fabrics())
    for (const std::string fit : {"blank.fit=grips", "blank.fit=none"}) {
      auto all = overrides;
      all.push_back(fit);
      const LawCase model(all);
      const auto gathered =
          foreign::gather(model.scene, model.card, model.mesh, make_tools(model.scene, model.mesh), 0.5, "test");
      double volume = 0.0;
      for (const double area : model.mesh.cells.area) volume += area * model.mesh.thickness;
      const foreign::CellSprings springs = foreign::cell_springs(gathered);
      for (const double degrees : {-40.0, -5.0, 5.0, 20.0, 45.0}) {
        const double gamma = degrees * std::numbers::pi / 180.0, s = std::sin(gamma);
        double power = 0.0;
        for (const auto& group : springs.group) {
          const DeckCurve law{foreign::spring_points(gathered, group, 2000)};
          const double product = group.along * group.across;
          const double d = std::sqrt(group.along * group.along + group.across * group.across + 2.0 * product * s);
          power += static_cast<double>(group.node.size()) * law.at(d - group.start) * product * std::cos(gamma) / d;
        }
        const double expected = volume * cell_power(model, gamma);
        EXPECT_NEAR(power, expected, 1e-3 * std::abs(expected)) << degrees << " deg, " << fit;
      }
    }
}

// CalculiX reads 200 points of a table and no more, without a word.
TEST(ExportLaws, CalculixTablesAreShortEnoughAndRight) {
  for (const auto& overrides : models()) {
    const LawCase model(overrides);
    std::map<std::string, DeckCurve> table;
    const auto blocks = deck_blocks(model.written(MeshFormat::calculix), '*', '\1');
    for (const auto& block : blocks) {
      if (!block.is("*SPRING, ELSET=") || block.keyword.find("NONLINEAR") == std::string::npos) continue;
      DeckCurve curve;
      for (std::size_t k = 1; k < block.line.size(); ++k) {
        const auto comma = block.line[k].find(',');
        curve.point.push_back({std::stod(block.line[k].substr(comma + 1)), std::stod(block.line[k].substr(0, comma))});
      }
      EXPECT_LE(curve.point.size(), 200U);
      EXPECT_TRUE(std::is_sorted(curve.point.begin(), curve.point.end()));
      table[block.keyword.substr(15, block.keyword.find(',', 15) - 15)] = curve;
    }
    int seen = 0;
    for (const auto& block : blocks) {
      if (!block.is("*ELEMENT, TYPE=SPRINGA, ELSET=w")) continue;
      const DeckCurve& law = table.at(block.keyword.substr(30));
      for (const auto& line : block.line) {
        const int e = std::stoi(line) - 1;
        ++seen;
        const double rest = model.mesh.yarns.rest_length[e], typical = model.yarn_force(e, 1.01 * rest);
        for (const double x : {-0.1, -0.01, 0.0, 0.002, 0.01, 0.03, 0.05})
          EXPECT_NEAR(law.at(x * rest), model.yarn_force(e, (1.0 + x) * rest),
                      2e-3 * std::abs(model.yarn_force(e, (1.0 + x) * rest)) + 1e-4 * typical + 1e-9)
              << "element " << e << " at " << x;
      }
    }
    const auto idle = std::count(model.mesh.yarns.softening.begin(), model.mesh.yarns.softening.end(), 0.0);
    EXPECT_EQ(seen, model.mesh.yarn_count() - idle);
  }
}

}  // namespace
}  // namespace weaveform
