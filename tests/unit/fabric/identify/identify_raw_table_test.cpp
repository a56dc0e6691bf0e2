// Raw test files: delimiters, decimal signs, headings, missing cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "fabric/identify/raw_table.hpp"
#include "fabric/identify/unit.hpp"

namespace weaveform::identify {
namespace {

RawTable table_of(const std::string& text, const TableFormat& format = {}) {
  return read_raw_table(text, "t.csv", format);
}

std::string table_complaint(const std::string& text, const TableFormat& format = {}) {
  try {
    const RawTable table = table_of(text, format);
    for (std::size_t i = 0; i < table.cells.front().size(); ++i) (void)numbers_of(table, i);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RawTable, SameRowsInEveryUsualSpelling) {
  const std::vector<double> x = {0.5, 1.25, 2.0}, y = {-1.5, 0.25, 100.0};
  for (const char* text : {
           "x,y\n0.5,-1.5\n1.25,0.25\n2,100\n",
           "x;y\r\n0,5;-1,5\r\n1,25;0,25\r\n2;1e2\r\n",
           "\xEF\xBB\xBF# comment\n\nx\ty\n0.5\t-1.5\n1.25\t+0.25\n2\t100\n",
           "x y\n 0.5   -1.5\n 1.25   0.25\n 2  100\n",
           "x y\n0,5 -1,5\n1,25 0,25\n2,0 100,0\n",
           "\"x\",\"y\"\n\"0.5\",\"-1.5\"\n\"1.25\",\"0.25\"\n\"2\",\"100\"\n",
           "x;y\n(mm);(N)\n0.5;-1.5\n1.25;0.25\n2;100\n",
       }) {
    const RawTable table = table_of(text);
    EXPECT_EQ(numbers_of(table, column_of(table, "x", "key")), x) << text;
    EXPECT_EQ(numbers_of(table, column_of(table, "2", "key")), y) << text;
  }
}

TEST(RawTable, WithoutAHeadingColumnsAreCounted) {
  const RawTable table = table_of("machine 4464\n1,2\n3,4\n", {.skip_lines = 1});
  EXPECT_TRUE(table.heading.empty());
  EXPECT_EQ(numbers_of(table, column_of(table, "2", "key")), (std::vector<double>{2, 4}));
  EXPECT_THROW((void)column_of(table, "force", "force_column"), InputError);
}

TEST(RawTable, MissingCellsAreNotANumber) {
  const auto numbers = numbers_of(table_of("x,y\n1,\n2,NaN\n3,n/a\n4,-\n5,7\n"), 1);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(std::isnan(numbers[i])) << i;
  EXPECT_EQ(numbers[4], 7.0);
}

TEST(RawTable, ComplainsWithFileAndLine) {
  EXPECT_NE(table_complaint("x;y\n1;2\n3,4\n5;6\n").find("t.csv:3: the row has 1 cell(s)"), std::string::npos);
  EXPECT_NE(table_complaint("x,y\n1,2\n3,4a\n").find("t.csv:3: '4a' is not a number"), std::string::npos);
  EXPECT_NE(table_complaint("x;y\n1.234,5;2\n1;2\n").find("t.csv:2: '1.234,5'"), std::string::npos);
  EXPECT_NE(table_complaint("x,y\n0,5,1,5\n1,5,2,5\n").find("twice as many cells"), std::string::npos);
  EXPECT_NE(table_complaint("x,y\n").find("no rows of numbers"), std::string::npos);
  EXPECT_NE(table_complaint("").find("has no rows"), std::string::npos);
  EXPECT_NE(table_complaint("x,y\n1,2\n", {.delimiter = Delimiter::comma, .decimal = DecimalSign::comma})
                .find("cannot be both"),
            std::string::npos);
  EXPECT_NE(table_complaint(std::string("PK\0\1", 4)).find("not plain text"), std::string::npos);
}

TEST(RawTable, AWrongColumnNameMeetsTheNearestOne) {
  const RawTable table = table_of("time,displacement,force\n1,2,3\n");
  try {
    (void)column_of(table, "dispalcement", "displacement_column");
    FAIL() << "no complaint";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "t.csv: no column 'dispalcement' for 'displacement_column'; did you mean 'displacement'?");
  }
}

// Rows 0..9 with x = k, y = 2 k after the lines of a machine, in its own separators.
std::string machine_file(const std::string& before, const std::string& delimiter, bool comma, const std::string& quote,
                         const std::string& after = "") {
  std::string text = before;
  for (int k = 0; k < 10; ++k) {
    std::string time = "0." + std::to_string(k), x = std::to_string(k) + ".50", y = std::to_string(2 * k) + ".25";
    for (std::string* cell : {&time, &x, &y})
      if (comma) std::replace(cell->begin(), cell->end(), '.', ',');
    text += quote + time + quote + delimiter + quote + x + quote + delimiter + quote + y + quote + "\n";
  }
  return text + after;
}

TEST(RawTable, FindsTheTableBehindAMachinesPreamble) {
  struct Case {
    const char* machine;
    std::string text, x;
    std::size_t units;
  };
  for (const Case& c : std::vector<Case>{
           {"Bluehill",
            machine_file("Specimen properties : Width,\"4.00000\",mm\nSpecimen properties : Thickness,\"0.3\",mm\n"
                         "Specimen label,\"Y1\"\n\nTime,Extension,Load\n(s),(mm),(N)\n",
                         ",", false, "\""),
            "Extension", 3},
           {"Bluehill with results",
            machine_file("\"Results Table 1\"\n,\"Maximum Load\",\"Modulus\"\n,\"(N)\",\"(MPa)\"\n1,25.0,2000.0\n"
                         "2,26.0,2010.0\n\n\"Time\",\"Extension\",\"Load\"\n\"(s)\",\"(mm)\",\"(N)\"\n",
                         ",", false, "\""),
            "Extension", 3},
           {"testXpert",
            machine_file("Pr\xFC"
                         "fer:\tM\xFCller\nBreite:\t4,00\tmm\n\nPr\xFC"
                         "fzeit\tStandardweg\tStandardkraft\ns\tmm\tN\n",
                         "\t", true, ""),
            "Standardweg", 3},
           {"TestSuite",
            machine_file("MTS793|MPT|ENU|1|2|.|/|:|1|0|0|A\n\nData Header:\tAcquisition\tTime:\t0.5\tSec\n"
                         "Running Time\tAxial Displacement\tAxial Force\nSec\tmm\tN\n",
                         "\t", false, ""),
            "Axial Displacement", 3},
           {"Trapezium",
            machine_file("\"Test Type\",\"Tensile\"\n\"Speed\",\"2mm/min\"\n\"1 _ 1\",\"1 _ 1\",\"1 _ 1\"\n"
                         "\"Time\",\"Stroke\",\"Force\"\n\"sec\",\"mm\",\"N\"\n",
                         ",", false, ""),
            "Stroke", 3},
           {"words after the rows", machine_file("t;x;y\n", ";", true, "", "\nEnd of test\nBreak at 9,5 mm\n"), "x", 0},
       }) {
    const RawTable table = table_of(c.text);
    const std::size_t x = column_of(table, c.x, "displacement_column");
    const auto xs = numbers_of(table, x), ys = numbers_of(table, x + 1);
    ASSERT_EQ(xs.size(), 10U) << c.machine;
    EXPECT_EQ(xs[3], 3.5) << c.machine;
    EXPECT_EQ(ys[9], 18.25) << c.machine;
    EXPECT_EQ(table.units.size(), c.units) << c.machine;
    ASSERT_EQ(table.notes.size(), 1U) << c.machine;
    EXPECT_NE(table.notes[0].find("skipped"), std::string::npos) << c.machine;
  }
}

TEST(RawTable, WhatPrecedesTheHeadingIsSaidWithItsLines) {
  const RawTable table = table_of("machine,7\noperator,me\n\nx,y\n1,2\n3,4\n5,6\n");
  EXPECT_EQ(table.notes, (std::vector<std::string>{"lines 1 to 2 before the heading in line 4 skipped"}));
  EXPECT_TRUE(table_of("x,y\n1,2\n3,4\n").notes.empty());
}

TEST(RawTable, ACommentCanBeTheHeading) {
  const RawTable table = table_of("# by me\n# time, force\n1,2\n3,4\n5,6\n");
  EXPECT_EQ(numbers_of(table, column_of(table, "force", "key")), (std::vector<double>{2, 4, 6}));
  EXPECT_TRUE(table_of("# a remark\n1,2\n3,4\n5,6\n").heading.empty());
}

TEST(RawTable, ThousandsAndQuotedDecimalCommasAreRead) {
  const std::vector<double> y = {999.5, 1000.25, 1234567.5};
  const RawTable thousands = table_of("x,y\n1,\"999.5\"\n2,\"1,000.25\"\n3,\"1,234,567.5\"\n");
  EXPECT_EQ(numbers_of(thousands, 1), y);
  const RawTable commas = table_of("x,y\n\"1,0\",\"999,5\"\n\"2,0\",\"1000,25\"\n\"3,0\",\"1234567,5\"\n");
  EXPECT_EQ(numbers_of(commas, 1), y);
  EXPECT_NE(table_complaint("x,y\n1,\"1,000\"\n2,\"2,000\"\n").find("'1,000' is not a number"), std::string::npos)
      << "one thousand, or one?";
}

TEST(RawTable, StatisticsBelowTheRowsAreNoRows) {
  const RawTable table = table_of("x,y\n1,2\n3,4\n5,6\nMaximum,5,6\nMean,3,4\n");
  EXPECT_EQ(numbers_of(table, 0), (std::vector<double>{1, 3, 5}));
  EXPECT_EQ(table.notes, (std::vector<std::string>{"lines 5 to 6 after the last row skipped"}));
}

TEST(RawTable, ASecondTableIsRefusedWithItsLine) {
  EXPECT_NE(table_complaint("x,y\n1,2\n3,4\n5,6\nspecimen two,\nx,y\n1,2\n3,4\n5,6\n").find("t.csv:7: after 3 rows"),
            std::string::npos);
}

TEST(RawTable, AFirstRowWithAWordInItIsNoPreamble) {
  EXPECT_NE(table_complaint("x,y\n1,four\n3,4\n5,6\n").find("t.csv:2: 'four' is not a number"), std::string::npos);
}

TEST(UnitInHeading, IsReadInTheUsualSpellings) {
  EXPECT_EQ(unit_in("Load (kN)", Quantity::force), "kN");
  EXPECT_EQ(unit_in("force [N]", Quantity::force), "N");
  EXPECT_EQ(unit_in("force_N", Quantity::force), "N");
  EXPECT_EQ(unit_in("normalised_shear_force_N_per_mm", Quantity::force_per_length), "N/mm");
  EXPECT_EQ(unit_in("shear_angle_deg", Quantity::angle), "deg");
  EXPECT_EQ(unit_in("Extension", Quantity::length), std::nullopt);
  EXPECT_EQ(unit_in("LOCATION", Quantity::force), std::nullopt) << "a word that ends in N names no unit";
}

}  // namespace
}  // namespace weaveform::identify
