#include "post/dic/readers/point_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/keys/toml_document.hpp"
#include "core/log/plain_text.hpp"

namespace weaveform::dic {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr int heading_lines = 2000;          // looked at for column names
constexpr int sampled_rows = 200;            // looked at for the decimal sign
constexpr std::size_t complaints_shown = 5;  // of one file; more of the same helps nobody

bool blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (blank(text.front()) || text.front() == '"')) text.remove_prefix(1);
  while (!text.empty() && (blank(text.back()) || text.back() == '"')) text.remove_suffix(1);
  return text;
}

// Walks the lines of a text.
class Lines {
public:
  Lines(std::string_view text, std::size_t begin, int number) : text_(text), next_(begin), number_(number - 1) {}
  bool advance() {
    if (next_ >= text_.size()) return false;
    begin_ = next_;
    const std::size_t end = text_.find('\n', begin_);
    next_ = end == std::string_view::npos ? text_.size() : end + 1;
    line_ = text_.substr(begin_, (end == std::string_view::npos ? text_.size() : end) - begin_);
    if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
    ++number_;
    return true;
  }
  [[nodiscard]] std::string_view line() const { return line_; }
  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] std::size_t begin() const { return begin_; }
  [[nodiscard]] std::size_t next() const { return next_; }

private:
  std::string_view text_, line_;
  std::size_t begin_ = 0, next_;
  int number_;
};

std::vector<char> delimiters_of(const TableHints& hints) {
  if (const auto given = delimiter_named(hints.delimiter)) return {*given};
  return {';', '\t', ',', ' '};
}

// A row holds no words: it is empty, a comment, or numbers and signs for missing ones.
bool is_comment(std::string_view line) {
  const std::string_view text = trimmed(line);
  return text.empty() || text.front() == '#' || text.starts_with("***");
}

std::optional<double> parsed(std::string_view cell, bool decimal_comma) {
  std::array<char, 64> copy{};
  if (decimal_comma) {
    if (cell.size() >= copy.size() || cell.find('.') != std::string_view::npos) return std::nullopt;
    std::replace_copy(cell.begin(), cell.end(), copy.begin(), ',', '.');
    cell = {copy.data(), cell.size()};
  }
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

bool says_missing(std::string_view cell) {
  std::string word(cell);
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  constexpr std::array words = {"", "nan", "na", "n/a", "-", "--", "null", "none", "-nan", "1.#qnan", "-1.#ind",
                                // NaN of .NET in Italian, German, French, Spanish, Polish, Russian (small and capital)
                                "non un numero reale", "n. def.", "non num\xC3\xA9rique", "neun",
                                "nie jest liczb\xC4\x85", "\xD0\xBD\xD0\xB5 \xD1\x87\xD0\xB8\xD1\x81\xD0\xBB\xD0\xBE",
                                "\xD0\x9D\xD0\xB5 \xD1\x87\xD0\xB8\xD1\x81\xD0\xBB\xD0\xBE"};
  return std::find(words.begin(), words.end(), word) != words.end();
}

// Calls use(index, cell) for the cells of a line and gives their number; cells are trimmed.
template <class Use>
std::size_t for_cells(std::string_view line, char delimiter, Use use) {
  std::size_t count = 0;
  while (true) {
    if (delimiter == ' ') {
      while (!line.empty() && blank(line.front())) line.remove_prefix(1);
      if (line.empty()) return count;
    }
    std::size_t end = 0;
    bool quoted = false;
    for (; end < line.size() && (quoted || line[end] != delimiter); ++end) quoted = quoted != (line[end] == '"');
    use(count++, trimmed(line.substr(0, end)));
    if (end >= line.size()) return count;
    line.remove_prefix(end + 1);
    if (line.empty()) {  // a delimiter at the end of the line leaves an empty cell
      if (delimiter == ' ') return count;
      use(count++, line);
      return count;
    }
  }
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
  Lines lines(table.text, table.body, table.body_line);
  for (int row = 0; row < sampled_rows && lines.advance();) {
    if (is_comment(lines.line())) continue;
    ++row;
    for_cells(lines.line(), table.delimiter, [&](std::size_t, std::string_view cell) {
      comma = comma || (cell.find(',') != std::string_view::npos && parsed(cell, true));
      point = point || (cell.find('.') != std::string_view::npos && parsed(cell, false));
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
           return parsed(cell, false) || parsed(cell, true) || says_missing(cell);
         });
}

}  // namespace

std::optional<char> delimiter_named(const std::string& name) {
  const auto named = choice_named<Delimiter>(name);
  return named ? character_of(*named) : name.front();
}

std::vector<std::string> split_cells(std::string_view line, char delimiter) {
  std::vector<std::string> cells;
  for_cells(line, delimiter, [&](std::size_t, std::string_view cell) { cells.emplace_back(cell); });
  return cells;
}

double number_of(std::string_view text) {
  text = trimmed(text);
  const auto point = parsed(text, false);
  return point ? *point : parsed(text, true).value_or(none);
}

PointTable open_point_table(const std::filesystem::path& file, const TableHints& hints, const IsHeading& is_heading) {
  PointTable table;
  table.file = file.string();
  table.text = plain_text(read_text_file(file));
  if (table.text.find('\0') != std::string::npos)
    throw InputError(fmt::format("{}: is not plain text; export the points as text (CSV)", table.file));
  Lines lines(table.text, 0, 1);
  while (lines.advance() && lines.number() <= heading_lines) {
    std::string_view line = lines.line();
    const bool comment = is_comment(line);
    while (!line.empty() && (line.front() == '#' || blank(line.front()))) line.remove_prefix(1);
    for (const char delimiter : delimiters_of(hints)) {
      if (line.find(delimiter) == line.npos) continue;  // points have more than one column
      auto cells = split_cells(line, delimiter);
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
  Lines lines(table.text, table.body, table.body_line);
  const auto complain = [&](const std::string& what) {
    complaints.push_back(fmt::format("{}:{}: {}", table.file, lines.number(), what));
  };
  while (lines.advance() && complaints.size() < complaints_shown) {
    if (is_comment(lines.line())) continue;
    bool filled_past_the_heading = false;
    const std::size_t count = for_cells(lines.line(), table.delimiter, [&](std::size_t index, std::string_view cell) {
      filled_past_the_heading = filled_past_the_heading || (width > 0 && index >= width && !cell.empty());
      if (index >= wanted.size() || wanted[index] < 0) return;
      double value = none;
      if (const auto number = parsed(cell, table.decimal_comma)) {
        value = std::isfinite(*number) ? *number : none;
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
