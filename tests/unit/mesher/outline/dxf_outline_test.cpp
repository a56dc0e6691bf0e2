// DXF drawings as blanks' outlines: every kind of curve by its closed-form area, units, layers, blocks, and what is
// refused by its name.
#include "mesher/outline/dxf_outline.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "mesher/outline/dxf_shapes.hpp"
#include "mesher/outline/loops.hpp"
#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

using std::numbers::pi;
using test::TemporaryFolder;
using test::write_text;

// "10 1.5 20 2" as the lines of a DXF file.
std::string pairs(const std::string& words) {
  std::string text;
  std::size_t at = 0;
  while (at < words.size()) {
    const std::size_t end = std::min(words.find(' ', at), words.size());
    text += words.substr(at, end - at) + "\n";
    at = end + 1;
  }
  return text;
}

std::string dxf_drawing(const std::string& entities, const std::string& header = "9 $INSUNITS 70 4",
                        const std::string& more = "") {
  return pairs("0 SECTION 2 HEADER " + header + " 0 ENDSEC") + more +
         pairs("0 SECTION 2 ENTITIES " + entities + " 0 ENDSEC 0 EOF");
}

struct Read {
  DxfOutline outline;
  std::vector<std::string> complaints;
  [[nodiscard]] double area() {
    double sum = 0.0;
    for (const auto& loop : sound_loops(outline.loops, "drawing", complaints)) sum += signed_area(loop.point);
    EXPECT_TRUE(complaints.empty()) << complaints.front();
    return sum;
  }
  [[nodiscard]] std::string complaint() const { return complaints.empty() ? "" : complaints.front(); }
};

Read read(const std::string& text, const DxfAsked& asked = {}) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "plate.dxf";
  write_text(text, file);
  Read result;
  result.outline = read_dxf_outline(file.string(), asked, result.complaints);
  return result;
}

std::string refusal(const std::string& text) {
  try {
    (void)read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

const std::string square = "0 LWPOLYLINE 8 0 90 4 70 1 10 -60 20 -40 10 60 20 -40 10 60 20 40 10 -60 20 40";

// Chords lie within 0.01 mm of the curve, so an area misses no more than that times the length.
TEST(DxfOutline, CurvesEncloseTheirArea) {
  EXPECT_NEAR(read(dxf_drawing(square)).area(), 120.0 * 80.0, 1e-9);
  EXPECT_NEAR(read(dxf_drawing("0 CIRCLE 8 0 10 5 20 5 40 50")).area(), pi * 2500.0, 0.01 * 2.0 * pi * 50.0);
  // a stadium: two bulges of 1 are half circles
  EXPECT_NEAR(
      read(dxf_drawing("0 LWPOLYLINE 8 0 90 4 70 1 10 0 20 0 10 80 20 0 42 1 10 80 20 40 10 0 20 40 42 1")).area(),
      80.0 * 40.0 + pi * 400.0, 0.01 * 400.0);
  // the same with the arcs inward
  EXPECT_NEAR(read(dxf_drawing("0 LWPOLYLINE 8 0 90 4 70 1 10 0 20 0 10 80 20 0 42 -.5 10 80 20 40 10 0 20 40")).area(),
              80.0 * 40.0 - (625.0 * (2.0 * std::atan(0.5)) - 15.0 * 20.0), 0.01 * 60.0);
  EXPECT_NEAR(read(dxf_drawing("0 ELLIPSE 8 0 10 1 20 2 11 0 21 30 40 .5 41 0 42 6.283185")).area(), pi * 30.0 * 15.0,
              2.0);
  // lines and an arc in any order and direction
  EXPECT_NEAR(
      read(dxf_drawing(
               "0 LINE 8 0 10 0 20 0 11 50 21 0 0 ARC 8 0 10 0 20 0 40 50 50 0 51 90 0 LINE 8 0 10 0 20 0 11 0 21 50"))
          .area(),
      0.25 * pi * 2500.0, 0.01 * 80.0);
  // an old polyline with a bulge, and one of three dimensions
  EXPECT_NEAR(
      read(dxf_drawing(
               "0 POLYLINE 8 0 66 1 70 1 0 VERTEX 8 0 10 0 20 0 0 VERTEX 8 0 10 20 20 0 42 1 0 VERTEX 8 0 10 20 20 20 "
               "0 VERTEX 8 0 10 0 20 20 0 SEQEND 8 0"))
          .area(),
      400.0 + 0.5 * pi * 100.0, 0.01 * 60.0);
  EXPECT_NEAR(
      read(dxf_drawing("0 POLYLINE 8 0 66 1 70 9 0 VERTEX 8 0 70 32 10 0 20 0 30 5 0 VERTEX 8 0 70 32 10 9 20 0 30 "
                       "5 0 VERTEX 8 0 "
                       "70 32 10 9 20 9 30 5 0 SEQEND 8 0"))
          .area(),
      40.5, 1e-9);
}

// A quarter circle is a rational spline of degree 2 with a middle weight of cos 45 deg.
TEST(DxfOutline, SplinesAreRationalToo) {
  const std::string quarter =
      "0 SPLINE 8 0 70 12 71 2 72 6 73 3 40 0 40 0 40 0 40 1 40 1 40 1 10 30 20 0 10 30 20 30 10 0 20 30 "
      "41 1 41 0.70710678118654752 41 1";
  EXPECT_NEAR(read(dxf_drawing(quarter + " 0 LINE 8 0 10 0 20 0 11 30 21 0 0 LINE 8 0 10 0 20 0 11 0 21 30")).area(),
              0.25 * pi * 900.0, 0.01 * 50.0);
  const Spline circle{2, {0, 0, 0, 1, 1, 1}, {{1, 0}, {1, 1}, {0, 1}}, {1, std::sqrt(0.5), 1}};
  for (double t = 0.0; t <= 1.0; t += 0.125) {
    const auto p = point_on(circle, t);
    EXPECT_NEAR(std::hypot(p[0], p[1]), 1.0, 1e-14);
  }
  // a parabola y = x^2 with a knot in between: points on it at any parameter
  const Spline parabola{2, {0, 0, 0, 1, 2, 2, 2}, {{0, 0}, {0.5, 0}, {1.5, 2}, {2, 4}}, {1, 1, 1, 1}};
  for (double t = 0.0; t <= 2.0; t += 0.25) EXPECT_NEAR(point_on(parabola, t)[1], t * t, 1e-14) << t;
}

TEST(DxfOutline, UnitsAreTheDrawings) {
  const double area = 120.0 * 80.0;
  const std::vector<std::pair<int, double>> units = {{1, 25.4},   {2, 304.8},  {4, 1.0},   {5, 10.0},
                                                     {6, 1000.0}, {9, 0.0254}, {14, 100.0}};
  for (const auto& [number, mm] : units) {
    Read inch = read(dxf_drawing(square, fmt::format("9 $MEASUREMENT 70 1 9 $INSUNITS 70 {}", number)));
    EXPECT_NEAR(inch.area(), area * mm * mm, 1e-6 * area * mm * mm) << number;
    EXPECT_TRUE(inch.outline.notes.empty());
  }
  Read none = read(dxf_drawing(square, "9 $INSUNITS 70 0"));
  EXPECT_NEAR(none.area(), area, 1e-9);
  ASSERT_EQ(none.outline.notes.size(), 1U);
  EXPECT_NE(none.outline.notes[0].find("taken for mm"), std::string::npos);
  DxfAsked asked;
  asked.unit = LengthUnit::cm;
  Read told = read(dxf_drawing(square, "9 $INSUNITS 70 0"), asked);
  EXPECT_NEAR(told.area(), 100.0 * area, 1e-6);
  EXPECT_TRUE(told.outline.notes.empty());
  EXPECT_NE(refusal(dxf_drawing(square, "9 $INSUNITS 70 17")).find("$INSUNITS 17"), std::string::npos);
}

TEST(DxfOutline, LayersAreChosenOrTold) {
  const std::string cut = "0 LWPOLYLINE 8 Cut 90 4 70 1 10 0 20 0 10 50 20 0 10 50 20 50 10 0 20 50";
  const std::string hole = " 0 CIRCLE 8 HOLES 10 25 20 25 40 10", mark = " 0 LINE 8 MARK 10 5 20 5 11 9 21 9";
  const std::string text = " 0 TEXT 8 NOTES 10 0 20 0 40 5 1 grain 0 POINT 8 NOTES 10 1 20 1";
  const double ring = 2500.0 - pi * 100.0;
  Read all = read(dxf_drawing(cut + hole + text));
  EXPECT_NEAR(all.area(), ring, 1.0);
  ASSERT_EQ(all.outline.notes.size(), 1U);
  EXPECT_NE(all.outline.notes[0].find("'Cut' (1 curve), 'HOLES' (1 curve)"), std::string::npos) << all.outline.notes[0];
  DxfAsked asked;
  asked.layers = {"CUT"};
  EXPECT_NEAR(read(dxf_drawing(cut + hole + mark), asked).area(), 2500.0, 1e-9);
  asked.layers = {"cut", "holes"};
  EXPECT_NEAR(read(dxf_drawing(cut + hole + mark), asked).area(), ring, 1.0);
  const Read open = read(dxf_drawing(cut + mark));
  ASSERT_FALSE(open.complaints.empty());
  EXPECT_NE(open.complaints.back().find("blank.outline_layers"), std::string::npos) << open.complaints.back();
  asked.layers = {"OUTLINE"};
  EXPECT_NE(read(dxf_drawing(cut), asked).complaint().find("no curve on layer 'OUTLINE'"), std::string::npos);
  // layers that are off or frozen are not seen
  const std::string tables =
      pairs("0 SECTION 2 TABLES 0 TABLE 2 LAYER 0 LAYER 2 HOLES 70 0 62 -7 0 LAYER 2 MARK 70 1 62 7 0 ENDTAB 0 ENDSEC");
  EXPECT_NEAR(read(dxf_drawing(cut + hole + mark, "9 $INSUNITS 70 4", tables)).area(), 2500.0, 1e-9);
}

TEST(DxfOutline, BlocksArePlacedTurnedAndStretched) {
  const std::string block = pairs(
      "0 SECTION 2 BLOCKS 0 BLOCK 2 piece 10 1 20 1 0 LWPOLYLINE 8 0 90 3 70 1 10 1 20 1 10 11 20 1 10 1 20 "
      "11 0 ENDBLK 0 ENDSEC");
  Read turned = read(dxf_drawing("0 INSERT 8 CUT 2 PIECE 10 100 20 0 41 2 42 3 50 90", "9 $INSUNITS 70 4", block));
  EXPECT_NEAR(turned.area(), 50.0 * 6.0, 1e-9);
  double high = 0.0, low = 200.0;
  for (const auto& p : turned.outline.loops.at(0).point) high = std::max(high, p[1]), low = std::min(low, p[0]);
  EXPECT_NEAR(high, 20.0, 1e-9) << "2 times 10 along x, turned by 90 deg";
  EXPECT_NEAR(low, 70.0, 1e-9) << "the base point lies at the place of insertion";
  // seen from behind x runs the other way
  Read behind = read(dxf_drawing("0 LWPOLYLINE 8 0 90 3 70 1 10 0 20 0 10 10 20 0 10 0 20 10 210 0 220 0 230 -1"));
  EXPECT_NEAR(behind.area(), 50.0, 1e-9);
  for (const auto& p : behind.outline.loops.at(0).point) EXPECT_LE(p[0], 1e-12);
  const Read array = read(dxf_drawing("0 INSERT 8 CUT 2 PIECE 70 3 10 0 20 0", "9 $INSUNITS 70 4", block));
  EXPECT_NE(array.complaint().find("rows and columns"), std::string::npos);
  EXPECT_NE(read(dxf_drawing("0 INSERT 8 CUT 2 OTHER 10 0 20 0")).complaint().find("block 'OTHER'"), std::string::npos);
  const std::string itself = pairs("0 SECTION 2 BLOCKS 0 BLOCK 2 A 0 INSERT 2 A 0 INSERT 2 A 0 ENDBLK 0 ENDSEC");
  EXPECT_NE(refusal(dxf_drawing("0 INSERT 8 0 2 A", "9 $INSUNITS 70 4", itself)).find("deep"), std::string::npos);
}

TEST(DxfOutline, WhatIsNotReadIsNamedOnce) {
  std::string solids;
  for (int k = 0; k < 500; ++k) solids += " 0 3DFACE 8 SKIN 10 0 20 0";
  const Read faces = read(dxf_drawing(square + solids + " 0 REGION 8 0"));
  ASSERT_EQ(faces.complaints.size(), 2U) << "one for each kind";
  EXPECT_NE(faces.complaints[0].find("3DFACE"), std::string::npos);
  EXPECT_NE(faces.complaints[0].find("and 499 more"), std::string::npos) << faces.complaints[0];
  const std::string gap =
      read(dxf_drawing(
               "0 LINE 8 0 10 0 20 0 11 50 21 0 0 LINE 8 0 10 50.5 20 0 11 0 21 50 0 LINE 8 0 10 0 20 50 11 0 21 0"))
          .complaint();
  EXPECT_NE(gap.find("open at (50, 0); close it: 0.5 mm"), std::string::npos) << gap;
  const std::string branch =
      read(dxf_drawing(square +
                       " 0 LINE 8 0 10 0 20 0 11 9 21 0 0 LINE 8 0 10 9 20 0 11 0 21 9 0 LINE 8 0 10 0 20 9 11 "
                       "0 21 0 0 LINE 8 0 10 0 20 0 11 5 21 5"))
          .complaint();
  EXPECT_NE(branch.find("3 curves meet at (0, 0)"), std::string::npos) << branch;
  EXPECT_NE(read(dxf_drawing("0 LINE 8 0 10 0 20 0 30 0 11 50 21 0 31 9")).complaint().find("leaves the plane"),
            std::string::npos);
  EXPECT_NE(read(dxf_drawing("0 CIRCLE 8 0 10 0 20 0 40 5 210 1 220 0 230 0")).complaint().find("another plane"),
            std::string::npos);
  EXPECT_NE(
      read(dxf_drawing("0 SPLINE 8 0 70 8 71 3 11 0 21 0 11 5 21 5 11 9 21 0")).complaint().find("fit points alone"),
      std::string::npos);
  EXPECT_NE(read(dxf_drawing("0 TEXT 8 0 1 nothing")).complaint().find("no curve in it"), std::string::npos);
}

TEST(DxfOutline, DamagedFilesAreRefusedWithTheirLine) {
  const std::string whole = dxf_drawing(square);
  EXPECT_NE(refusal(whole.substr(0, whole.size() / 2)).find("cut short"), std::string::npos);
  EXPECT_NE(refusal("x,y\n0,0\n").find("plate.dxf:1: 'x,y' where a group code"), std::string::npos);
  EXPECT_NE(refusal("AutoCAD Binary DXF\r\n\x1a").find("save it as text"), std::string::npos);
  EXPECT_NE(refusal("AC1032 something").find("DWG"), std::string::npos);
  EXPECT_NE(refusal(dxf_drawing("0 LINE 8 0 10 zero 20 0 11 1 21 1")).find("'zero' is no finite number"),
            std::string::npos);
  EXPECT_NE(refusal(dxf_drawing("0 CIRCLE 8 0 10 0 20 0 40 -5")).find("radius -5"), std::string::npos);
  EXPECT_NE(
      refusal(dxf_drawing("0 SPLINE 8 0 71 3 40 0 40 1 10 0 20 0 10 1 20 0")).find("SPLINE of degree 3 with 2 control"),
      std::string::npos);
  EXPECT_NE(refusal(dxf_drawing("0 LINE 8 0 10 0 20 0 11 1e20 21 0")).find("lengths of an outline"), std::string::npos);
}

// A line drawn twice, and one of no length, bound nothing more.
TEST(DxfOutline, DoublesCountOnce) {
  const std::string triangle =
      "0 LINE 8 0 10 0 20 0 11 8 21 0 0 LINE 8 0 10 8 20 0 11 0 21 8 0 LINE 8 0 10 0 20 8 11 0 21 0";
  EXPECT_NEAR(
      read(dxf_drawing(
               triangle +
               " 0 LINE 8 0 10 8 20 0 11 0 21 0 0 LINE 8 0 10 8 20 0 11 8 21 0 0 CIRCLE 8 0 10 2 20 2 40 1 0 CIRCLE "
               "8 0 10 2 20 2 40 1"))
          .area(),
      32.0 - pi, 0.1);
}

}  // namespace
}  // namespace weaveform
