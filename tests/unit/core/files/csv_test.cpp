// Delimited text: what is written reads back, and what others write reads as they mean it.
#include "core/files/csv.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "core/error.hpp"

namespace weaveform {
namespace {

using Cells = std::vector<std::string>;

Cells record_of(const std::string& text, const CsvFormat& format = {}) {
  CsvReader in(text, "t.csv", format);
  return in.advance() ? in.cells() : Cells{"nothing"};
}

// Both ways over one line: cell by cell without a copy, and as texts.
Cells cells_of(const std::string& line, char delimiter) {
  Cells views;
  const std::size_t count =
      for_csv_cells(line, delimiter, [&](std::size_t, std::string_view cell) { views.emplace_back(cell); });
  EXPECT_EQ(count, views.size());
  const Cells texts = csv_cells(line, delimiter);
  EXPECT_EQ(texts.size(), views.size()) << line;
  return texts;
}

TEST(Csv, CellsAreCutAtTheDelimiterAndNowhereElse) {
  EXPECT_EQ(cells_of("a,b", ','), (Cells{"a", "b"}));
  EXPECT_EQ(cells_of("", ','), (Cells{""}));
  EXPECT_EQ(cells_of(",", ','), (Cells{"", ""}));
  EXPECT_EQ(cells_of("a,,b,", ','), (Cells{"a", "", "b", ""}));
  EXPECT_EQ(cells_of(" a ,\tb\r", ','), (Cells{"a", "b"}));
  EXPECT_EQ(cells_of("a\t\tb\t", '\t'), (Cells{"a", "", "b", ""}));
  EXPECT_EQ(cells_of("  1,5   2,5 ", ' '), (Cells{"1,5", "2,5"}));
  EXPECT_EQ(cells_of("   ", ' '), (Cells{}));
  EXPECT_EQ(cells_of("\"Kraft, N\";\"Weg \"\"s\"\"\";x", ';'), (Cells{"Kraft, N", "Weg \"s\"", "x"}));
  EXPECT_EQ(cells_of("\"a,b\",c", ','), (Cells{"a,b", "c"}));
  EXPECT_EQ(cells_of("\"\",\"\"\"\"", ','), (Cells{"", "\""}));
  EXPECT_EQ(cells_of("a 5\",b", ','), (Cells{"a 5\"", "b"})) << "inches";
  EXPECT_EQ(cells_of("\"never closed,b", ','), (Cells{"\"never closed,b"}));
  EXPECT_EQ(cells_of("\" padded \",b", ','), (Cells{"padded", "b"}));
}

TEST(Csv, RecordsRunOnOverLineEndsInQuotesAndPlacesCountThem) {
  const std::string text = "\xEF\xBB\xBFname,value\r\n\"two\nlines\",1.5\r\n\"x, \"\"y\"\"\",oops\n";
  CsvReader in(text, "t.csv");
  ASSERT_TRUE(in.advance());
  EXPECT_EQ(in.cells(), (Cells{"name", "value"}));
  ASSERT_TRUE(in.advance());
  EXPECT_EQ(in.cells(), (Cells{"two\nlines", "1.5"}));
  EXPECT_EQ(in.place(), "t.csv:2");
  EXPECT_EQ(in.place(1), "t.csv:3:8");
  EXPECT_EQ(in.number(1, "no"), 1.5);
  ASSERT_TRUE(in.advance());
  EXPECT_EQ(in.place(1), "t.csv:4:12");
  try {
    static_cast<void>(in.number(1, "write it anew"));
    FAIL() << "a number";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "t.csv:4:12: 'oops' is no number; write it anew");
  }
  EXPECT_FALSE(in.advance());
}

TEST(Csv, RemarksAndBlankLinesAreRecordsOnlyWhereTheyAreAskedFor) {
  const std::string text = "# first\n\n  \t\n 1;2,5\n# last";
  CsvReader in(text, "t.csv", {.delimiter = ';', .decimal_comma = true, .remarks = true});
  ASSERT_TRUE(in.advance());
  EXPECT_EQ(in.line(), 4);
  EXPECT_EQ(in.number(1, "no"), 2.5);
  EXPECT_FALSE(in.advance());
  EXPECT_EQ(record_of("# first\n"), (Cells{"# first"}));
  EXPECT_EQ(record_of("\n1"), (Cells{""}));
  EXPECT_EQ(record_of(""), (Cells{"nothing"}));
  EXPECT_EQ(record_of("1,2,"), (Cells{"1", "2", ""})) << "the delimiter ends the text";
}

TEST(Csv, WhateverIsWrittenReadsBack) {
  std::mt19937 random(1);
  const std::string letters = "ab,;\t\"\n\r 1.";
  std::uniform_int_distribution<std::size_t> letter(0, letters.size() - 1), count(0, 6);
  for (const char delimiter : {',', ';', '\t'})
    for (int trial = 0; trial < 2000; ++trial) {
      Cells cells(1 + count(random));
      for (std::string& cell : cells) {
        for (std::size_t k = count(random); k > 0; --k) cell += letters[letter(random)];
        // blanks around a cell do not count
        while (!cell.empty() && is_csv_blank(cell.front())) cell.erase(0, 1);
        while (!cell.empty() && is_csv_blank(cell.back())) cell.pop_back();
      }
      const std::string line = csv_line(cells, delimiter);
      CsvReader in(line, "t.csv", {.delimiter = delimiter});
      ASSERT_TRUE(in.advance());
      EXPECT_EQ(in.cells(), cells) << line;
      EXPECT_FALSE(in.advance()) << line;
    }
}

TEST(Csv, NumbersHaveOneDecimalSignAndNoRest) {
  EXPECT_EQ(csv_number_in("1.5e3", false), 1500.0);
  EXPECT_EQ(csv_number_in("+2", false), 2.0);
  EXPECT_EQ(csv_number_in("1,5", true), 1.5);
  EXPECT_EQ(csv_number_in("1e30", false), 1e30);
  for (const char* text : {"", "1,5", "1.5 mm", "0x10", "--1", "1e999"})
    EXPECT_FALSE(csv_number_in(text, false)) << text;
  for (const char* text : {"1.5", "1.234,5", ""}) EXPECT_FALSE(csv_number_in(text, true)) << text;
  EXPECT_EQ(csv_number(1.0 / 3.0, 4), "0.3333");
  EXPECT_EQ(csv_number(std::numeric_limits<double>::quiet_NaN()), "");
  for (const char* text : {"", "NaN", "N/A", "-", "n. def."}) EXPECT_TRUE(says_missing(text)) << text;
  EXPECT_FALSE(says_missing("0"));
}

TEST(Csv, LinesKnowTheirNumberAndPlace) {
  const std::string text = "a\r\n\nlast";
  TextLines lines(text);
  ASSERT_TRUE(lines.advance());
  EXPECT_EQ(lines.line(), "a");
  ASSERT_TRUE(lines.advance());
  EXPECT_EQ(lines.line(), "");
  EXPECT_EQ(lines.number(), 2);
  ASSERT_TRUE(lines.advance());
  EXPECT_EQ(lines.begin(), 4U);
  EXPECT_EQ(lines.next(), text.size());
  EXPECT_FALSE(lines.advance());
}

}  // namespace
}  // namespace weaveform
