#include "fabric/identify/raw_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string_view>

#include "core/error.hpp"
#include "core/files/csv.hpp"
#include "core/keys/nearest_name.hpp"
#include "core/log/plain_text.hpp"
#include "fabric/identify/table_layout.hpp"

namespace weaveform::identify {
namespace {

constexpr std::size_t complaints_shown = 5;   // of one file; more of the same helps nobody
constexpr std::ptrdiff_t sampled_lines = 20;  // looked at for the delimiter

struct Line {
  int number = 0;
  std::string text;
};

std::vector<Line> lines_of(std::string_view text, int skip) {
  std::vector<Line> lines;
  for (TextLines all(text); all.advance();) {
    const std::size_t first = all.line().find_first_not_of(" \t");
    if (all.number() > skip && first != std::string_view::npos && all.line()[first] != '#')
      lines.push_back({all.number(), std::string(all.line())});
  }
  return lines;
}

// Semicolons and tabs separate nothing but cells. A comma may also be a decimal one: where blanks separate as well and
// leave numbers with commas, blanks are the delimiter.
char guessed_delimiter(const std::vector<Line>& all) {
  // rows stand at the end of a file, other lines at its beginning
  const std::vector<Line> lines(all.end() - std::min(std::ssize(all), sampled_lines), all.end());
  const auto share = [&](char c) {
    const auto has = [c](const Line& line) { return line.text.find(c) != std::string::npos; };
    return 2 * std::count_if(lines.begin(), lines.end(), has) > std::ssize(lines);
  };
  for (const char candidate : {';', '\t'}) {
    if (share(candidate)) return candidate;
  }
  if (!share(',')) return ' ';
  const auto by_blanks = [](const Line& line) {
    const auto cells = csv_cells(line.text, ' ');
    return cells.size() > 1 &&
           std::all_of(cells.begin(), cells.end(), [](const auto& cell) { return number_in(cell, true).has_value(); });
  };
  return 2 * std::count_if(lines.begin(), lines.end(), by_blanks) > std::ssize(lines) ? ' ' : ',';
}

char delimiter_of(const TableFormat& format, const std::vector<Line>& lines) {
  const auto given = character_of(format.delimiter);
  return given ? *given : guessed_delimiter(lines);
}

bool has_decimal_commas(const TableFormat& format, char delimiter, const RawTable& table) {
  if (format.decimal == DecimalSign::comma && delimiter == ',')
    throw InputError(
        fmt::format("{}: the comma cannot be both delimiter and decimal sign; save the file with ';' "
                    "between columns, or correct 'delimiter' or 'decimal'",
                    table.file));
  if (format.decimal != DecimalSign::automatic) return format.decimal == DecimalSign::comma;
  bool comma = false;
  if (delimiter == ',') {
    // in quotes a comma separates nothing; but three digits after it may be thousands
    for (const auto& row : table.cells)
      for (const auto& cell : row) {
        if (cell.find('.') != std::string::npos) return false;
        const auto at = cell.find(',');
        comma = comma || (at != std::string::npos && number_in(cell, true) && cell.size() - at != 4);
      }
    return comma;
  }
  for (const auto& row : table.cells) {
    for (const auto& cell : row) {
      comma = comma || (cell.find(',') != std::string::npos && number_in(cell, true));
      if (cell.find('.') != std::string::npos && number_in(cell, false)) return false;
    }
  }
  return comma;
}

// "# time, force": the last comment above the rows when it has a name for every column; else none.
std::vector<std::string> commented_heading(std::string_view text, char delimiter, int first_row, std::size_t width) {
  std::vector<std::string> heading;
  for (TextLines all(text); all.advance() && all.number() < first_row;) {
    const std::size_t first = all.line().find_first_not_of(" \t");
    if (first == std::string_view::npos || all.line()[first] != '#') continue;
    const std::string_view words = all.line().substr(std::min(all.line().find_first_not_of("# \t"), all.line().size()));
    const SplitLine cells{all.number(), csv_cells(words, delimiter)};
    if (cells.cells.size() == width && can_head(cells, width)) heading = cells.cells;
  }
  return heading;
}

// A delimiter at the end of every row makes a column of nothing.
void drop_empty_last_column(RawTable& table) {
  const std::size_t width = table.cells.front().size();
  const auto ends_empty = [&](const auto& row) { return row.size() == width && row.back().empty(); };
  if (table.heading.size() == width + 1 && table.heading.back().empty()) table.heading.pop_back();
  if (width < 2 || table.heading.empty() || !std::all_of(table.cells.begin(), table.cells.end(), ends_empty)) return;
  if (table.heading.size() == width && !table.heading.back().empty()) return;  // a column whose values are missing
  for (auto& row : table.cells) row.pop_back();
  if (table.heading.size() == width) table.heading.pop_back();
  if (table.units.size() == width) table.units.pop_back();
}

// Every row must have as many cells as most rows have.
void check_widths(const RawTable& table, char delimiter) {
  std::map<std::size_t, std::size_t> rows_of_width;
  for (const auto& row : table.cells) ++rows_of_width[row.size()];
  const auto usual = std::max_element(rows_of_width.begin(), rows_of_width.end(), [](const auto& a, const auto& b) {
                       return a.second < b.second;
                     })->first;
  if (delimiter == ',' && !table.heading.empty() && usual == 2 * table.heading.size())
    throw InputError(
        fmt::format("{}:{}: the rows have twice as many cells as the heading: decimal commas between "
                    "commas cannot be told apart; save the file with ';' between columns",
                    table.file, table.line.front()));
  std::vector<std::string> complaints;
  for (std::size_t i = 0; i < table.cells.size() && complaints.size() < complaints_shown; ++i) {
    if (table.cells[i].size() == usual) continue;
    complaints.push_back(
        fmt::format("{}:{}: the row has {} cell(s) separated by '{}', most rows have {}; does the file "
                    "mix delimiters? correct the row",
                    table.file, table.line[i], table.cells[i].size(), delimiter, usual));
  }
  if (complaints.empty() && !table.heading.empty() && table.heading.size() != usual)
    complaints.push_back(
        fmt::format("{}: the heading names {} columns, the rows have {}; correct the heading, or "
                    "'skip_lines' if it is not the heading",
                    table.file, table.heading.size(), usual));
  if (!complaints.empty()) throw InputError(complaints);
}

}  // namespace

RawTable read_raw_table(const std::string& text, const std::string& file, const TableFormat& format) {
  const std::string plain = plain_text(text);
  if (plain.find('\0') != std::string::npos)
    throw InputError(fmt::format("{}: is not plain text; export the test as CSV (UTF-8)", file));
  const std::vector<Line> lines = lines_of(plain, format.skip_lines);
  if (lines.empty())
    throw InputError(fmt::format("{}: has no rows after its first {} lines; correct 'skip_lines' or the file", file,
                                 format.skip_lines));
  const char delimiter = delimiter_of(format, lines);
  std::vector<SplitLine> split_lines;
  for (const auto& line : lines) split_lines.push_back({line.number, csv_cells(line.text, delimiter)});
  const TableLayout layout = find_table(split_lines, delimiter, file);
  if (layout.begin == layout.end)
    throw InputError(
        fmt::format("{}: has a heading but no rows of numbers; correct 'skip_lines', 'delimiter' or the "
                    "file",
                    file));
  RawTable table;
  table.file = file;
  table.notes = lines_left_out(split_lines, layout);
  if (layout.heading)
    table.heading = std::move(split_lines[*layout.heading].cells);
  else
    table.heading = commented_heading(plain, delimiter, split_lines[layout.begin].number, layout.width);
  if (layout.units) table.units = std::move(split_lines[*layout.units].cells);
  for (std::size_t k = layout.begin; k < layout.end; ++k) {
    table.line.push_back(split_lines[k].number);
    table.cells.push_back(std::move(split_lines[k].cells));
  }
  drop_empty_last_column(table);
  check_widths(table, delimiter);
  table.decimal_comma = has_decimal_commas(format, delimiter, table);
  return table;
}

std::size_t column_of(const RawTable& table, const std::string& column, const std::string& key) {
  const auto found = std::find(table.heading.begin(), table.heading.end(), column);
  if (found != table.heading.end()) return static_cast<std::size_t>(found - table.heading.begin());
  const auto number = number_in(column, false);
  const std::size_t width = table.cells.front().size();
  if (number && *number >= 1.0 && *number <= static_cast<double>(width) && *number == std::floor(*number))
    return static_cast<std::size_t>(*number) - 1;
  const std::string there = table.heading.empty()
                                ? fmt::format("; the file has no heading, count its {} columns from \"1\"", width)
                                : did_you_mean(column, table.heading);
  throw InputError(fmt::format("{}: no column '{}' for '{}'{}", table.file, column, key, there));
}

std::vector<double> numbers_of(const RawTable& table, std::size_t column) {
  std::vector<double> numbers;
  std::vector<std::string> complaints;
  for (std::size_t i = 0; i < table.cells.size(); ++i) {
    const std::string& cell = table.cells[i][column];
    const auto number =
        says_missing(cell) ? std::numeric_limits<double>::quiet_NaN() : number_in(cell, table.decimal_comma);
    if (!number && complaints.size() < complaints_shown)
      complaints.push_back(
          fmt::format("{}:{}: '{}' is not a number with a decimal {}; correct the cell, or 'decimal' "
                      "and 'delimiter'",
                      table.file, table.line[i], cell, table.decimal_comma ? "comma" : "point"));
    numbers.push_back(number.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  if (!complaints.empty()) throw InputError(complaints);
  return numbers;
}

}  // namespace weaveform::identify
