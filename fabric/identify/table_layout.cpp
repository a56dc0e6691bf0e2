#include "fabric/identify/table_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "core/files/csv.hpp"

namespace weaveform::identify {
namespace {

constexpr std::size_t sampled_rows = 20;  // at the end of the file, where only rows are
constexpr std::size_t like_size = 5;      // a block of rows so many times smaller is no second table

bool is_number(const std::string& cell) {
  return number_in(cell, false) || number_in(cell, true);
}

bool any_number(const SplitLine& line) {
  return std::any_of(line.cells.begin(), line.cells.end(), is_number);
}

bool has_letter(const std::string& cell) {
  return std::any_of(cell.begin(), cell.end(),
                     [](unsigned char c) { return c >= 0x80 || std::isalpha(c) != 0 || c == '%'; });
}

// A line of words: a heading, units, a title or a remark, but no row whose numbers are missing.
bool is_words(const SplitLine& line) {
  return !any_number(line) && std::any_of(line.cells.begin(), line.cells.end(), [](const std::string& cell) {
    return has_letter(cell) && !says_missing(cell);
  });
}

// What a row of this file looks like: its number of cells, and which of them are numbers.
struct RowShape {
  std::size_t width = 0;
  std::vector<std::size_t> numbers;
};

RowShape shape_of_rows(const std::vector<SplitLine>& lines) {
  std::vector<const SplitLine*> sample;
  for (std::size_t k = lines.size(); k-- > 0 && sample.size() < sampled_rows;)
    if (any_number(lines[k])) sample.push_back(&lines[k]);
  std::map<std::size_t, std::size_t> lines_of_width;
  for (const SplitLine* line : sample) ++lines_of_width[line->cells.size()];
  RowShape shape;
  std::size_t most = 0;
  for (const auto& [width, count] : lines_of_width)
    if (count >= most) shape.width = width, most = count;
  for (std::size_t c = 0; c < shape.width; ++c) {
    std::size_t numbers = 0, words = 0;
    for (const SplitLine* line : sample) {
      if (line->cells.size() != shape.width) continue;
      if (is_number(line->cells[c]))
        ++numbers;
      else if (!says_missing(line->cells[c]))
        ++words;
    }
    if (numbers > 0 && numbers >= words) shape.numbers.push_back(c);
  }
  return shape;
}

bool is_row(const SplitLine& line, const RowShape& shape) {
  if (line.cells.size() != shape.width) return false;
  const auto fits = [&](std::size_t c) { return is_number(line.cells[c]) || says_missing(line.cells[c]); };
  return std::all_of(shape.numbers.begin(), shape.numbers.end(), fits) &&
         std::any_of(shape.numbers.begin(), shape.numbers.end(),
                     [&](std::size_t c) { return is_number(line.cells[c]); });
}

// A line below the rows that begins with a word where they have a number: "Mean;2.4;60".
bool is_footer(const SplitLine& line, const RowShape& shape) {
  if (shape.numbers.empty() || shape.numbers.front() >= line.cells.size()) return false;
  const std::string& cell = line.cells[shape.numbers.front()];
  return has_letter(cell) && !says_missing(cell) && cell.find_first_of("0123456789") == std::string::npos;
}

struct Block {
  std::size_t begin = 0, end = 0, rows = 0;  // [begin, end) up to the next line of words
};

std::vector<Block> blocks_of(const std::vector<SplitLine>& lines, const RowShape& shape) {
  std::vector<Block> blocks;
  bool open = false;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (is_words(lines[k])) {
      open = false;
    } else if (open || is_row(lines[k], shape)) {
      if (!open) blocks.push_back({k, k, 0});
      open = true;
      blocks.back().end = k + 1;
      blocks.back().rows += is_row(lines[k], shape) ? 1 : 0;
    }
  }
  return blocks;
}

// A unit alone in its cell, perhaps in brackets.
bool names_unit(const std::string& cell) {
  if (cell.size() > 2 && (cell.front() == '(' || cell.front() == '[') && (cell.back() == ')' || cell.back() == ']'))
    return true;
  // °C in octal: its C would be taken for a third digit of a hexadecimal number
  static const std::vector<std::string> units = {
      "s",        "sec",   "ms",        "min",    "h",      "mm",           "cm",     "m",     "um",     "\xC2\xB5m",
      "in",       "inch",  "inches",    "N",      "kN",     "cN",           "mN",     "lbf",   "kgf",    "gf",
      "kg",       "g",     "MPa",       "GPa",    "kPa",    "Pa",           "%",      "1",     "deg",    "rad",
      "\xC2\xB0", "mm/mm", "m/m",       "in/in",  "N/mm",   "N/mm\xC2\xB2", "N/mm^2", "N/mm2", "mm/min", "V",
      "Hz",       "J",     "\302\260C", "strain", "cycles", "segments",     "um/m"};
  return std::find(units.begin(), units.end(), cell) != units.end();
}

bool names_units(const SplitLine& line) {
  std::size_t units = 0, filled = 0;
  for (const std::string& cell : line.cells) {
    filled += cell.empty() ? 0 : 1;
    units += names_unit(cell) ? 1 : 0;
  }
  return units > 0 && 2 * units >= filled;
}

// The line that names a block's columns; null when there is none.
const SplitLine* heading_of(const std::vector<SplitLine>& lines, const Block& block, std::size_t width) {
  std::size_t k = block.begin;
  if (k > 1 && can_head(lines[k - 1], width) && names_units(lines[k - 1]) && can_head(lines[k - 2], width)) --k;
  return k > 0 && can_head(lines[k - 1], width) ? &lines[k - 1] : nullptr;
}

// A block under another heading is another table, such as the results that a machine writes first; one without a
// heading, or under the same, is a second specimen.
void refuse_second_table(const std::vector<SplitLine>& lines, const std::vector<Block>& blocks, const Block& table,
                         const RowShape& shape, const std::string& file) {
  const SplitLine* heading = heading_of(lines, table, shape.width);
  for (const Block& block : blocks) {
    if (block.begin == table.begin || block.rows < 2 || block.rows * like_size < table.rows) continue;
    const SplitLine* other = heading_of(lines, block, shape.width);
    if (heading != nullptr && other != nullptr && heading->cells != other->cells) continue;
    const auto& [first, second] = block.begin < table.begin ? std::pair(block, table) : std::pair(table, block);
    throw InputError(fmt::format(
        "{}:{}: after {} rows of numbers and a line of words a second block of {} rows begins; is it another "
        "table? keep one in the file, or cut off the first with skip_lines = {}",
        file, lines[second.begin].number, first.rows, second.rows, lines[first.end - 1].number));
  }
}

void find_heading(const std::vector<SplitLine>& lines, char delimiter, TableLayout& layout) {
  if (layout.begin == 0) return;
  const std::size_t last = layout.begin - 1;
  if (!is_words(lines[last])) return;
  // Another number of cells is a mistake that check_widths names, unless the line is one title.
  const bool comma_twice = delimiter == ',' && layout.width == 2 * lines[last].cells.size();
  if (!can_head(lines[last], layout.width)) {
    if (comma_twice || lines[last].cells.size() > 1) layout.heading = last;
    return;
  }
  layout.heading = last;
  if (last == 0 || !can_head(lines[last - 1], layout.width) || !names_units(lines[last])) return;
  layout.heading = last - 1;
  layout.units = last;
}

// A first row with a word where a number should be is a row all the same when a heading stands above it.
void take_bad_first_rows(const std::vector<SplitLine>& lines, const RowShape& shape, TableLayout& layout) {
  std::size_t first = layout.begin;
  while (first > 0 && !is_words(lines[first - 1]) && lines[first - 1].cells.size() == shape.width) --first;
  if (first < layout.begin && first > 0 && can_head(lines[first - 1], shape.width)) layout.begin = first;
}

// "1,234.5" to "1234.5"; without a point, or with groups of other than three digits, the commas mean something else.
void drop_thousands(std::string& cell) {
  const auto point = cell.find('.');
  auto comma = cell.find(',');
  if (point == std::string::npos || comma == std::string::npos || comma > point) return;
  for (std::size_t at = comma; at < point; at += 4)
    if (cell[at] != ',' || at + 4 > point || cell.find_first_not_of("0123456789", at + 1) < at + 4) return;
  for (; comma != std::string::npos; comma = cell.find(',')) cell.erase(comma, 1);
}

}  // namespace

// A line of words above the rows that can name their columns: as many cells as they, or one that misses an empty last.
bool can_head(const SplitLine& line, std::size_t width) {
  const std::size_t cells = line.cells.size();
  return is_words(line) && (cells == width || cells + 1 == width || (cells == width + 1 && line.cells.back().empty()));
}

std::optional<double> number_in(std::string cell, bool decimal_comma) {
  if (!decimal_comma) drop_thousands(cell);
  return csv_number_in(cell, decimal_comma);
}

TableLayout find_table(const std::vector<SplitLine>& lines, char delimiter, const std::string& file) {
  TableLayout layout;
  const RowShape shape = shape_of_rows(lines);
  layout.width = shape.width;
  const std::vector<Block> blocks = blocks_of(lines, shape);
  if (blocks.empty()) return layout;
  const Block table =
      *std::max_element(blocks.begin(), blocks.end(), [](const Block& a, const Block& b) { return a.rows < b.rows; });
  refuse_second_table(lines, blocks, table, shape, file);
  layout.begin = table.begin;
  layout.end = table.end;
  while (layout.end > layout.begin && is_footer(lines[layout.end - 1], shape)) --layout.end;
  take_bad_first_rows(lines, shape, layout);
  find_heading(lines, delimiter, layout);
  return layout;
}

std::vector<std::string> lines_left_out(const std::vector<SplitLine>& lines, const TableLayout& layout) {
  const auto span = [&](std::size_t first, std::size_t last) {
    return first == last ? fmt::format("line {}", lines[first].number)
                         : fmt::format("lines {} to {}", lines[first].number, lines[last].number);
  };
  std::vector<std::string> notes;
  const std::size_t top = layout.heading.value_or(layout.begin);
  if (top > 0)
    notes.push_back(fmt::format("{} before the {} in line {} skipped", span(0, top - 1),
                                layout.heading ? "heading" : "first row", lines[top].number));
  if (layout.end < lines.size())
    notes.push_back(fmt::format("{} after the last row skipped", span(layout.end, lines.size() - 1)));
  return notes;
}

}  // namespace weaveform::identify
