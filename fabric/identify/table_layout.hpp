// Where the table stands in a machine's file: Instron Bluehill, Zwick testXpert, MTS, Shimadzu Trapezium and others
// write lines about specimen and test before its heading, a row of units below it, and perhaps words after the last
// row.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace weaveform::identify {

// A line that is neither blank nor a comment, cut at the delimiter.
struct SplitLine {
  int number = 0;  // 1-based, in the file
  std::vector<std::string> cells;
};

// Indices into the lines.
struct TableLayout {
  std::optional<std::size_t> heading, units;
  std::size_t begin = 0, end = 0;  // rows [begin, end)
  std::size_t width = 0;           // cells of most rows
};

// The number a cell is, with a decimal comma, or with a point and perhaps commas between thousands ("1,234.5"); nothing
// when it is none.
[[nodiscard]] std::optional<double> number_in(std::string cell, bool decimal_comma);

// The rows are the largest block of lines that have numbers where the last lines of the file have them; the heading is
// the last line without numbers above it, or the last but one when the last names units. Rows with words where numbers
// should be stay part of the block, to be complained about. No rows: begin == end. Throws InputError when two blocks of
// rows are of like size and under one heading (`file` in messages).
[[nodiscard]] TableLayout find_table(const std::vector<SplitLine>& lines, char delimiter, const std::string& file);

// Whether a line of words can name the columns of rows of so many cells.
[[nodiscard]] bool can_head(const SplitLine& line, std::size_t width);

// "lines 1 to 3 before the heading in line 5 skipped ..."; what of the file is no part of the table, in sentences.
[[nodiscard]] std::vector<std::string> lines_left_out(const std::vector<SplitLine>& lines, const TableLayout& layout);

}  // namespace weaveform::identify
