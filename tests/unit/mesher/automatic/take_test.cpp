// What is taken where a scene leaves mesh and elements open.
#include "mesher/automatic/take.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "mesher/scene/reader.hpp"
#include "mesher/scene/taken.hpp"
#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

const std::string open_blank = "coarsening = \"auto\"\n";
const std::string open_model = "[model]\nyarn = \"auto\"\ncell = \"auto\"\n";

const std::string drawn_part =
    "[blank]\nsize = [400, 400]\nyarn_angle = 0\n" + open_blank + open_model +
    "[tools.punch]\nshape = \"sphere\"\nradius = 75\ntravel = 90\n"
    "[tools.die]\nshape = \"ring\"\nopening_radius = 77\nfillet_radius = 15\n"
    "[tools.binder]\nshape = \"ring\"\naxis = [0, 0, -1]\nopening_radius = 77\nforce = 650\n";
const std::string bias = "[blank]\n" + open_blank + open_model +
                         "[[grip]]\nname = \"bottom\"\nedge = \"bottom\"\n"
                         "[[grip]]\nname = \"top\"\nedge = \"top\"\ntravel = 30\n";
const std::string hanging = "[blank]\nsize = [128, 60]\nyarn_angle = 0\n" + open_blank + open_model +
                            "[[grip]]\nname = \"clamp\"\nedge = \"left\"\n[analysis]\ngravity = [0, 0, -9810]\n";
const std::string framed = "[blank]\nsize = [120, 120]\nyarn_angle = 0\n" + open_blank + open_model + "[frame]\n";
const std::string free_blank = "[blank]\nsize = [100, 60]\n" + open_blank + open_model;
const std::string stacked = drawn_part + "[[ply]]\nname = \"lower\"\n[[ply]]\nname = \"upper\"\nyarn_angle = 45\n";
const std::string laid = "[blank]\nsize = [200, 200]\nyarn_angle = 0\n" + open_blank +
                         "[tools.dome]\nshape = \"revolved\"\nposition = [0, 0, -75]\n"
                         "profile = [[300, 0], [88.741196, 0], [73.950997, 12.5, 88.741196, 15], [0, 75, 0, 0]]\n"
                         "[drape]\ntool = \"dome\"\n";

Scene taken(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const auto file = test::scratch_file("scene.toml");
  test::write_text(text, file);
  return read_taken_scene(file, overrides);
}

double coarsening(const Scene& scene) {
  const BlankSpec& blank = scene.ply.empty() ? scene.blank : scene.ply.back().blank;
  return std::max(blank.coarsening[0], blank.coarsening[1]);
}

TEST(Automatic, NothingIsLeftOpen) {
  for (const std::string& text : {drawn_part, bias, hanging, framed, free_blank, stacked, laid}) {
    const Scene scene = taken(text);
    EXPECT_FALSE(leaves_open(scene)) << text;
    EXPECT_FALSE(scene.taken.empty()) << text;
    for (const TakenSpec& one : scene.taken) EXPECT_FALSE(one.why.empty()) << one.key;
  }
}

TEST(Automatic, WhatIsGivenStays) {
  const Scene scene = taken(drawn_part, {"blank.coarsening=[3, 5]", "model.cell=membrane"});
  EXPECT_EQ(scene.blank.coarsening, (std::array<double, 2>{3.0, 5.0}));
  EXPECT_EQ(scene.model.cell, CellElement::membrane);
  EXPECT_EQ(find_taken(scene, "blank.coarsening"), nullptr);
  EXPECT_EQ(find_taken(scene, "model.cell"), nullptr);
  EXPECT_NE(find_taken(scene, "model.yarn"), nullptr);
  EXPECT_TRUE(taken("[blank]\ncoarsening = 2\n").taken.empty());
}

TEST(Automatic, DoesNotHangOnTheOrderOfKeys) {
  const std::string other = "[tools.punch]\ntravel = 90\nradius = 75\nshape = \"sphere\"\n" + open_model +
                            "[tools.binder]\nforce = 650\nopening_radius = 77\naxis = [0, 0, -1]\nshape = \"ring\"\n"
                            "[tools.die]\nfillet_radius = 15\nopening_radius = 77\nshape = \"ring\"\n"
                            "[blank]\n" +
                            open_blank + "yarn_angle = 0\nsize = [400, 400]\n";
  EXPECT_EQ(taken(drawn_part), taken(other));
}

TEST(Automatic, FinerWantedIsNeverCoarser) {
  for (const std::string& text : {drawn_part, bias, hanging, framed, free_blank, stacked, laid})
    for (const char* key : {"accuracy.force", "accuracy.angle"}) {
      double before = 1e9;
      for (const double wanted : {0.3, 0.1, 0.05, 0.02, 0.01, 0.003, 0.0005}) {
        const double value = key == std::string("accuracy.angle") ? 50.0 * wanted : wanted;
        const double now = coarsening(taken(text, {std::string(key) + "=" + std::to_string(value)}));
        EXPECT_LE(now, before) << key << " = " << value << "\n" << text;
        before = now;
      }
    }
}

TEST(Automatic, FinerThanMeasuredIsMissedAndSaidSo) {
  const Scene scene = taken(drawn_part, {"accuracy.force=0.0005"});
  EXPECT_NEAR(coarsening(scene), 0.5, 0.001);  // mesh_rules.hpp: finest_coarsening
  ASSERT_EQ(missed_lines(scene).size(), 1u);
  EXPECT_TRUE(missed_lines(taken(drawn_part)).empty());
}

TEST(Automatic, BendsWhereFabricIsPressedOrHangs) {
  EXPECT_EQ(taken(drawn_part).model.cell, CellElement::rotation_free);
  EXPECT_EQ(taken(hanging).model.cell, CellElement::rotation_free);
  EXPECT_EQ(taken(stacked).ply[1].model.cell, CellElement::rotation_free);
  for (const std::string& text : {bias, framed, free_blank}) EXPECT_EQ(taken(text).model.cell, CellElement::membrane);
}

TEST(Automatic, BendsWhereTheSceneAsksForIt) {
  EXPECT_EQ(taken(bias, {"model.cell_bending=[1, 1, 0.3]"}).model.cell, CellElement::rotation_free);
  EXPECT_EQ(taken(framed, {"model.bending_friction=[0.04, 0.002]"}).model.cell, CellElement::rotation_free);
  EXPECT_EQ(taken(bias, {"model.transverse_shear=0.5"}).model.cell, CellElement::shell);
  EXPECT_EQ(taken(drawn_part, {"model.yarn_bending=[5, 5]"}).model.yarn, YarnElement::beam);
  EXPECT_EQ(taken(drawn_part, {"model.partner=compression"}).model.yarn, YarnElement::seatbelt);
}

TEST(Automatic, YarnsBendWherePulledFabricHasNoLimitWithout) {
  EXPECT_EQ(taken(bias).model.yarn, YarnElement::beam);
  for (const std::string& text : {drawn_part, hanging, framed, free_blank})
    EXPECT_EQ(taken(text).model.yarn, YarnElement::truss);
  EXPECT_EQ(taken(drawn_part + "[[grip]]\nname = \"l\"\nedge = \"left\"\n[[grip]]\nname = \"r\"\nedge = \"right\"\n")
                .model.yarn,
            YarnElement::beam);
  EXPECT_EQ(taken(bias, {"model.yarn_law=linear"}).model.yarn, YarnElement::truss);
  // and without them the mesh pays for it
  EXPECT_LT(coarsening(taken(bias, {"model.yarn=truss"})), 0.5 * coarsening(taken(bias)));
}

// Everything twice as large but the fabric (whose half thickness is 0.3 % of the die's radius): twice the coarsening.
TEST(Automatic, GrowsWithTheScene) {
  const double once = coarsening(taken(drawn_part));
  const double twice =
      coarsening(taken(drawn_part, {"blank.size=[800, 800]", "tools.punch.radius=150", "tools.die.fillet_radius=30",
                                    "tools.die.opening_radius=154", "tools.binder.opening_radius=154"}));
  EXPECT_NEAR(twice / once, 2.0, 0.05);
}

// Every family's cells as long as the other's, whatever the intervals (twill: 2.44 and 5.1 mm).
TEST(Automatic, CellsAreAsLongAsWide) {
  const Scene scene = taken(drawn_part, {"fabric.material=twintex-tw"});
  EXPECT_NEAR(scene.blank.coarsening[0] / scene.blank.coarsening[1], 5.1 / 2.44, 0.02);
}

TEST(Automatic, SmallBoxesHaveCells) {
  const Scene scene = taken(drawn_part + "[[measure]]\nname = \"spot\"\nbox = [0, 0, 6, 6]\n");
  EXPECT_LE(coarsening(scene) * 4.92, 4.0);  // 6 mm over sqrt(2) is 4.2
  EXPECT_NE(find_taken(scene, "blank.coarsening")->why.find("spot"), std::string::npos);
}

TEST(Automatic, AMeshThatWasTakenForTheSceneIsOnRecord) {
  const Scene scene = taken(stacked);
  ASSERT_NE(find_taken(scene, "ply.upper.coarsening"), nullptr);
  const Scene again = read_scene_text(scene_to_toml(scene), scene.file);
  EXPECT_EQ(again, scene);
  EXPECT_EQ(as_overrides(scene.taken, read_scene_text(stacked, "s.toml")).size(), 6u);
}

TEST(Automatic, WhatIsOverruledIsNoLongerOnRecord) {
  const std::string copy = scene_to_toml(taken(drawn_part));
  const Scene scene = read_scene_text(copy, "s.toml", {"blank.coarsening=4"});
  EXPECT_EQ(find_taken(scene, "blank.coarsening"), nullptr);
  EXPECT_NE(find_taken(scene, "model.cell"), nullptr);
}

}  // namespace
}  // namespace weaveform
