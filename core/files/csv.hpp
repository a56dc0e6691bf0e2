// Delimited text as RFC 4180 (2005) has it, with any delimiter: a cell that begins with a quote ends at the next one
// that is not doubled, and what would separate cells or lines separates nothing in between. Blanks around a cell do not
// count, nor those within its quotes; with a blank as delimiter any number of them is one. A delimiter at a line's end
// leaves an empty cell. Lines end in \n or \r\n, a byte-order mark at the beginning is passed over (plain_text.hpp
// reads other encodings).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace weaveform {

// Walks the lines of a text that lives as long, from `begin` on, whose line has this number.
class TextLines {
public:
  explicit TextLines(std::string_view text, std::size_t begin = 0, int number = 1);
  bool advance();  // false at the end
  [[nodiscard]] std::string_view line() const { return line_; }
  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] std::size_t begin() const { return begin_; }  // where the line stands in the text,
  [[nodiscard]] std::size_t next() const { return next_; }    // and the one after

private:
  std::string_view text_, line_;
  std::size_t begin_ = 0, next_;
  int number_;
};

// What of a line is its first cell, in characters: the delimiter or the line's end comes after it.
[[nodiscard]] std::size_t csv_cell_end(std::string_view line, char delimiter);
// A cell without the blanks around it and the quotes it stands in; doubled quotes as they are.
[[nodiscard]] std::string_view csv_cell(std::string_view text);
[[nodiscard]] constexpr bool is_csv_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

// Calls use(index, cell) for the cells of a line and gives their number. Nothing is copied: for tables of many points.
template <class Use>
std::size_t for_csv_cells(std::string_view line, char delimiter, Use use) {
  std::size_t count = 0;
  while (true) {
    if (delimiter == ' ') {
      while (!line.empty() && is_csv_blank(line.front())) line.remove_prefix(1);
      if (line.empty()) return count;
    }
    const std::size_t end = csv_cell_end(line, delimiter);
    use(count++, csv_cell(line.substr(0, end)));
    if (end >= line.size()) return count;
    line.remove_prefix(end + 1);
  }
}

// The cells of a line, doubled quotes as one.
[[nodiscard]] std::vector<std::string> csv_cells(std::string_view line, char delimiter);

// The number a cell is, with a decimal comma or a point; nothing when it is none, as "1.234,5" with either.
[[nodiscard]] std::optional<double> csv_number_in(std::string_view cell, bool decimal_comma);
// Whether a cell says that there is no number: it is empty, or "NaN", "n/a", "-", ... in any case of letters, or what
// .NET writes for it in a user's language.
[[nodiscard]] bool says_missing(std::string_view cell);

struct CsvFormat {
  char delimiter = ',';
  bool decimal_comma = false;
  bool remarks = false;  // lines that are blank or begin with '#' are no records
};

// Walks the records of a text, which quotes may carry on over line ends. `file` stands for the text in messages.
class CsvReader {
public:
  CsvReader(std::string_view text, std::string file, const CsvFormat& format = {});
  bool advance();  // false at the end
  [[nodiscard]] const std::vector<std::string>& cells() const { return cells_; }
  [[nodiscard]] int line() const { return line_; }          // where the record begins
  [[nodiscard]] std::string place() const;                  // "file:line"
  [[nodiscard]] std::string place(std::size_t cell) const;  // "file:line:column", the column counted in bytes
  // Throws InputError "file:line:column: 'x' is no number; ADVICE".
  [[nodiscard]] double number(std::size_t cell, const std::string& advice) const;

private:
  void take_record();
  std::string_view text_;
  std::string file_;
  CsvFormat format_;
  std::size_t at_ = 0, line_begin_ = 0;
  int next_line_ = 1, line_ = 0;
  std::vector<std::string> cells_;
  std::vector<std::pair<int, std::size_t>> begin_;  // line and column of each cell
};

// A cell as it is written: quoted where it holds the delimiter, a quote or a line end.
[[nodiscard]] std::string csv_field(std::string_view text, char delimiter = ',');
// With `digits`; empty when it is not finite.
[[nodiscard]] std::string csv_number(double value, int digits = 10);
// A line of such cells, its end included.
[[nodiscard]] std::string csv_line(const std::vector<std::string>& cells, char delimiter = ',');

}  // namespace weaveform
