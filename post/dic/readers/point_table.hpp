// A point field as text: perhaps lines of header, a line that names the columns, then one row for each point. Only the
// columns asked for are turned into numbers, so that a file of 100,000 points is read in a fraction of a second.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/csv_format.hpp"

namespace weaveform::dic {

struct PointTable {
  bool found = false;  // the heading, or without one the first row
  std::string file;
  std::string text;                 // the whole file
  std::vector<std::string> header;  // lines before the column names, as they stand
  std::vector<std::string>
      heading;  // column names, without quotes, blanks and the '#' that begins the line; may be empty
  char delimiter = ',';
  bool decimal_comma = false;
  std::size_t body = 0;  // where the rows begin in `text`
  int body_line = 1;     // 1-based number of the first row's line
};

// Whether these cells name the columns.
using IsHeading = std::function<bool(const std::vector<std::string>&)>;

struct TableHints {
  std::string delimiter = "auto";  // "auto", "comma", "semicolon", "tab", "space", or one character
  DecimalSign decimal = DecimalSign::automatic;
  std::size_t columns = 0;  // > 0: there is no heading; the rows begin with the first that has so many numbers
};

// Finds the heading among the first 2000 lines by trying the delimiters, and the decimal sign from the rows. Throws
// FileError, or InputError for what is not text and for decimal signs that cannot be told apart.
[[nodiscard]] PointTable open_point_table(const std::filesystem::path& file, const TableHints& hints,
                                          const IsHeading& is_heading);

// Where the heading names it; -1 where it does not, and for an empty name.
[[nodiscard]] int column_of(const PointTable& table, const std::string& name);

// The numbers of the columns (0-based), column by column; not a number where a cell is empty or says that there is none
// ("NaN", "n/a", "-", or what .NET writes for it in a user's language, ...). Throws InputError with file and line of
// rows that have another number of cells than the heading, and of cells that are no numbers.
[[nodiscard]] std::vector<std::vector<double>> read_columns(const PointTable& table,
                                                            const std::vector<std::size_t>& columns);

// The character that [measurement] names: a Delimiter by its name, or the character itself. None: it is to be found.
[[nodiscard]] std::optional<char> delimiter_named(const std::string& name);

// The number a text is, not a number when it is none.
[[nodiscard]] double number_of(std::string_view text);

}  // namespace weaveform::dic
