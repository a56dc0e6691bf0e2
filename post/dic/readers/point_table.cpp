#include "post/dic/readers/point_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "core/files/csv.hpp"
#include "core/files/files.hpp"
#include "core/keys/toml_document.hpp"
#include "core/log/plain_text.hpp"
#include "core/missing.hpp"
#include "post/dic/readers/convention.hpp"

namespace weaveform::dic {
namespace {

constexpr int heading_lines = 2000;          // looked at for column names
constexpr int sampled_rows = 200;            // looked at for the decimal sign
constexpr std::size_t complaints_shown = 5;  // of one file; more of the same helps nobody

std::vector<char> delimiters_of(const TableHints& hints) {
  if (const auto given = delimiter_named(hints.delimiter)) return {*given};
  return {';', '\t', ',', ' '};
}

// A row holds no words: it is empty, a comment, or numbers and signs for missing ones.
bool is_comment(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t\"");
  if (first == std::string_view::npos) return true;
  return line[first] == '#' || line.substr(first).starts_with("***");
}

std::string delimiter_words(char delimiter) {
  if (delimiter == '\t') return "tabs";
  if (delimiter == ' ') return "blanks";
  return fmt::format("'{}'", delimiter);
}

void find_decimal_sign(PointTable& table, const TableHints& hints) {
  if (hints.decimal == DecimalSign::comma && table.delimiter == ',')
    throw InputError(
        fmt::format("{}: the comma cannot be both delimiter and decimal sign; correct 'delimiter' or 'decimal' of "
                    "[measurement], or export with ';' between the columns",
                    table.file));
  table.decimal_comma = hints.decimal == DecimalSign::comma;
  if (hints.decimal != DecimalSign::automatic || table.delimiter == ',') return;
  bool comma = false, point = false;
  TextLines lines(table.text, table.body, table.body_line);
  for (int row = 0; row < sampled_rows && lines.advance();) {
    if (is_comment(lines.line())) continue;
    ++row;
    for_csv_cells(lines.line(), table.delimiter, [&](std::size_t, std::string_view cell) {
      comma = comma || (cell.find(',') != std::string_view::npos && csv_number_in(cell, true));
      point = point || (cell.find('.') != std::string_view::npos && csv_number_in(cell, false));
    });
  }
  if (comma && point)
    throw InputError(
        fmt::format("{}:{}: some numbers have a comma and some a point: which is the decimal sign? set 'decimal' of "
                    "[measurement], or export the file anew",
                    table.file, table.body_line));
  table.decimal_comma = comma;
}

bool all_numbers(const std::vector<std::string>& cells, std::size_t wanted) {
  return cells.size() >= wanted && std::all_of(cells.begin(), cells.end(), [](const std::string& cell) {
           return csv_number_in(cell, false) || csv_number_in(cell, true) || says_missing(cell);
         });
}

}  // namespace

std::optional<char> delimiter_named(const std::string& name) {
  const auto named = choice_named<Delimiter>(name);
  return named ? character_of(*named) : name.front();
}

double number_of(std::string_view text) {
  text = csv_cell(text);
  const auto point = csv_number_in(text, false);
  return point ? *point : csv_number_in(text, true).value_or(missing);
}

int column_of(const PointTable& table, const std::string& name) {
  const auto column = name.empty() ? std::nullopt : find_column(table.heading, name);
  return column ? static_cast<int>(*column) : -1;
}

PointTable open_point_table(const std::filesystem::path& file, const TableHints& hints, const IsHeading& is_heading) {
  PointTable table;
  table.file = file.string();
  table.text = plain_text(read_text_file(file));
  if (table.text.find('\0') != std::string::npos)
    throw InputError(fmt::format("{}: is not plain text; export the points as text (CSV)", table.file));
  TextLines lines(table.text, 0, 1);
  while (lines.advance() && lines.number() <= heading_lines) {
    std::string_view line = lines.line();
    const bool comment = is_comment(line);
    while (!line.empty() && (line.front() == '#' || is_csv_blank(line.front()))) line.remove_prefix(1);
    for (const char delimiter : delimiters_of(hints)) {
      if (line.find(delimiter) == line.npos) continue;  // points have more than one column
      auto cells = csv_cells(line, delimiter);
      const bool row = hints.columns > 0 && !comment && all_numbers(cells, hints.columns);
      if (!row && !(hints.columns == 0 && is_heading(cells))) continue;
      table.found = true;
      table.delimiter = delimiter;
      table.body = row ? lines.begin() : lines.next();
      table.body_line = row ? lines.number() : lines.number() + 1;
      if (!row) table.heading = std::move(cells);
      find_decimal_sign(table, hints);
      return table;
    }
    table.header.emplace_back(lines.line());
  }
  return table;
}

std::vector<std::vector<double>> read_columns(const PointTable& table, const std::vector<std::size_t>& columns) {
  std::vector<std::vector<double>> numbers(columns.size());
  std::vector<int> wanted(columns.empty() ? 0 : *std::max_element(columns.begin(), columns.end()) + 1, -1);
  for (std::size_t k = 0; k < columns.size(); ++k) wanted[columns[k]] = static_cast<int>(k);
  std::vector<std::string> complaints;
  std::size_t width = table.heading.size();
  TextLines lines(table.text, table.body, table.body_line);
  const auto complain = [&](const std::string& what) {
    complaints.push_back(fmt::format("{}:{}: {}", table.file, lines.number(), what));
  };
  while (lines.advance() && complaints.size() < complaints_shown) {
    if (is_comment(lines.line())) continue;
    bool filled_past_the_heading = false;
    const std::size_t count =
        for_csv_cells(lines.line(), table.delimiter, [&](std::size_t index, std::string_view cell) {
          filled_past_the_heading = filled_past_the_heading || (width > 0 && index >= width && !cell.empty());
          if (index >= wanted.size() || wanted[index] < 0) return;
          double value = missing;
          if (const auto number = csv_number_in(cell, table.decimal_comma)) {
            value = std::isfinite(*number) ? *number : missing;
          } else if (!says_missing(cell)) {
            complain(
                fmt::format("'{}' is not a number with a decimal {}; correct the cell, or 'decimal' and 'delimiter' "
                            "of [measurement]",
                            cell, table.decimal_comma ? "comma" : "point"));
          }
          numbers[static_cast<std::size_t>(wanted[index])].push_back(value);
        });
    if (width == 0) width = count;
    if (table.delimiter == ',' && count == 2 * width) {
      complain(
          "the row has twice as many cells as there are columns: are these decimal commas between commas? they "
          "cannot be told apart; export with ';' between the columns");
      break;
    }
    if (count < width || (count > width && filled_past_the_heading))
      complain(
          fmt::format("the row has {} cell(s) separated by {}, there are {} columns; is the file cut off, or the "
                      "delimiter another one? correct the row or 'delimiter' of [measurement]",
                      count, delimiter_words(table.delimiter), width));
  }
  if (!complaints.empty()) throw InputError(complaints);
  return numbers;
}

}  // namespace weaveform::dic
