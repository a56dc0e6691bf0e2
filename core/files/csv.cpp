#include "core/files/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/error.hpp"
#include "core/files/text_words.hpp"

namespace weaveform {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && is_csv_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_csv_blank(text.back())) text.remove_suffix(1);
  return text;
}

// Past the quote that ends a cell which begins with one at `from`; the end of the text when none does.
std::size_t past_quotes(std::string_view text, std::size_t from) {
  for (std::size_t at = from + 1; (at = text.find('"', at)) != std::string_view::npos; at += 2)
    if (at + 1 >= text.size() || text[at + 1] != '"') return at + 1;
  return text.size();
}

// Where a quote may begin the cell: past blanks, of which a delimiter is none.
std::size_t past_blanks(std::string_view text, std::size_t from, char delimiter) {
  while (from < text.size() && is_csv_blank(text[from]) && text[from] != delimiter) ++from;
  return from;
}

std::string single_quotes(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t k = 0; k < text.size(); ++k) {
    out += text[k];
    if (text[k] == '"' && k + 1 < text.size() && text[k + 1] == '"') ++k;
  }
  return out;
}

bool in_quotes(std::string_view cell) {
  const std::string_view text = without_blanks(cell);
  return text.size() > 1 && text.front() == '"' && past_quotes(text, 0) == text.size() && text.back() == '"';
}

// A cell as text: quotes are doubled within quotes only.
std::string cell_text(std::string_view cell) {
  const std::string_view bare = csv_cell(cell);
  return in_quotes(cell) ? single_quotes(bare) : std::string(bare);
}

}  // namespace

TextLines::TextLines(std::string_view text, std::size_t begin, int number)
    : text_(text), next_(begin), number_(number - 1) {
  if (begin == 0 && text.starts_with(byte_order_mark)) next_ = byte_order_mark.size();
}

bool TextLines::advance() {
  if (next_ >= text_.size()) return false;
  begin_ = next_;
  const std::size_t end = std::min(text_.find('\n', begin_), text_.size());
  next_ = std::min(end + 1, text_.size());
  line_ = text_.substr(begin_, end - begin_);
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  ++number_;
  return true;
}

std::size_t csv_cell_end(std::string_view line, char delimiter) {
  const std::size_t first = past_blanks(line, 0, delimiter);
  const std::size_t from = first < line.size() && line[first] == '"' ? past_quotes(line, first) : first;
  return std::min(line.find(delimiter, from), line.size());
}

std::string_view csv_cell(std::string_view text) {
  text = without_blanks(text);
  return in_quotes(text) ? without_blanks(text.substr(1, text.size() - 2)) : text;
}

std::vector<std::string> csv_cells(std::string_view line, char delimiter) {
  std::vector<std::string> cells;
  std::size_t begin = 0;
  while (true) {
    if (delimiter == ' ') {
      begin = std::min(line.find_first_not_of(" \t\r", begin), line.size());
      if (begin == line.size()) return cells;
    }
    const std::size_t size = csv_cell_end(line.substr(begin), delimiter);
    cells.push_back(cell_text(line.substr(begin, size)));
    begin += size + 1;
    if (begin > line.size()) return cells;
  }
}

std::optional<double> csv_number_in(std::string_view cell, bool decimal_comma) {
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
  const std::string word = lower(cell);
  constexpr std::array words = {"", "nan", "na", "n/a", "-", "--", "null", "none", "inf", "-inf", "-nan", "1.#qnan",
                                "-1.#ind",
                                // NaN of .NET in Italian, German, French, Spanish, Polish, Russian (small and capital)
                                "non un numero reale", "n. def.", "non num\xC3\xA9rique", "neun",
                                "nie jest liczb\xC4\x85", "\xD0\xBD\xD0\xB5 \xD1\x87\xD0\xB8\xD1\x81\xD0\xBB\xD0\xBE",
                                "\xD0\x9D\xD0\xB5 \xD1\x87\xD0\xB8\xD1\x81\xD0\xBB\xD0\xBE"};
  return std::find(words.begin(), words.end(), word) != words.end();
}

CsvReader::CsvReader(std::string_view text, std::string file, const CsvFormat& format)
    : text_(text), file_(std::move(file)), format_(format) {
  if (text_.starts_with(byte_order_mark)) text_.remove_prefix(byte_order_mark.size());
}

bool CsvReader::advance() {
  while (at_ < text_.size()) {
    const std::string_view rest = text_.substr(at_, text_.find('\n', at_) - at_);
    const std::string_view line = without_blanks(rest);
    if (!format_.remarks || !(line.empty() || line.front() == '#')) {
      take_record();
      return true;
    }
    at_ = line_begin_ = std::min(at_ + rest.size() + 1, text_.size());
    ++next_line_;
  }
  return false;
}

// A cell ends at the delimiter or the line's end, whichever comes first behind its quotes.
void CsvReader::take_record() {
  cells_.clear();
  begin_.clear();
  line_ = next_line_;
  while (true) {
    const std::size_t first = past_blanks(text_, at_, format_.delimiter);
    begin_.emplace_back(next_line_, first - line_begin_ + 1);
    std::size_t end = first;
    if (first < text_.size() && text_[first] == '"') {
      end = past_quotes(text_, first);
      for (std::size_t k = first; k < end; ++k)
        if (text_[k] == '\n') ++next_line_, line_begin_ = k + 1;
    }
    while (end < text_.size() && text_[end] != format_.delimiter && text_[end] != '\n') ++end;
    cells_.push_back(cell_text(text_.substr(at_, end - at_)));
    const bool more = end < text_.size() && text_[end] != '\n';
    at_ = std::min(end + 1, text_.size());
    if (more) continue;
    line_begin_ = at_;
    ++next_line_;
    return;
  }
}

std::string CsvReader::place() const {
  return fmt::format("{}:{}", file_, line_);
}

std::string CsvReader::place(std::size_t cell) const {
  return fmt::format("{}:{}:{}", file_, begin_[cell].first, begin_[cell].second);
}

double CsvReader::number(std::size_t cell, const std::string& advice) const {
  if (const auto value = csv_number_in(cells_[cell], format_.decimal_comma)) return *value;
  throw InputError(fmt::format("{}: '{}' is no number; {}", place(cell), cells_[cell], advice));
}

std::string csv_field(std::string_view text, char delimiter) {
  const std::array<char, 4> special = {delimiter, '"', '\n', '\r'};
  if (text.find_first_of({special.data(), special.size()}) == std::string_view::npos) return std::string(text);
  std::string field = "\"";
  for (const char c : text) {
    field += c;
    if (c == '"') field += c;
  }
  return field + "\"";
}

std::string csv_number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "";
}

std::string csv_line(const std::vector<std::string>& cells, char delimiter) {
  std::string line;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (k > 0) line += delimiter;
    line += csv_field(cells[k], delimiter);
  }
  return line + "\n";
}

}  // namespace weaveform
