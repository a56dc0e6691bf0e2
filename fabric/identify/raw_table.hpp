// A test file as the machine wrote it: lines about specimen and test (table_layout.hpp), delimited text with a heading,
// perhaps a row of units, perhaps decimal commas, in any usual encoding (core/log/plain_text.hpp).
// Nothing is guessed silently: what cannot be read one way only is a complaint with file and line.
#pragma once

#include <string>
#include <vector>

#include "core/files/csv_format.hpp"

namespace weaveform::identify {

struct TableFormat {
  Delimiter delimiter = Delimiter::automatic;
  DecimalSign decimal = DecimalSign::automatic;
  int skip_lines = 0;  // before the heading; lines that begin with '#' and blank ones never count
};

struct RawTable {
  std::string file;
  std::vector<std::string> heading;             // empty when the file has none
  std::vector<std::string> units;               // a second row of text, as some machines write; else empty
  std::vector<int> line;                        // 1-based, of each row
  std::vector<std::vector<std::string>> cells;  // trimmed, without quotes; every row as long as the first
  bool decimal_comma = false;
  std::vector<std::string> notes;  // lines that are no part of the table, in sentences
};

// `file` stands for the text in messages. Throws InputError with every row that does not fit.
[[nodiscard]] RawTable read_raw_table(const std::string& text, const std::string& file, const TableFormat& format);

// Index of a column by its heading or by its number, "1" being the first. Throws InputError naming the columns there
// are; `key` is the key of the fit file that asked for it.
[[nodiscard]] std::size_t column_of(const RawTable& table, const std::string& column, const std::string& key);

// The column's numbers, not a number where the cell is empty or says that there is none ("NaN", "n/a", "-", ...).
// Throws InputError with file and line of text that is no number.
[[nodiscard]] std::vector<double> numbers_of(const RawTable& table, std::size_t column);

}  // namespace weaveform::identify
