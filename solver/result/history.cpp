// history.csv: comma-separated, one header line, numbers with ten significant digits.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "solver/result/result.hpp"

namespace weaveform {

namespace {

// A grip's name may hold a comma or a quote; such a field is quoted and its quotes are doubled (RFC 4180, 2005).
std::string quoted(const std::string& field) {
  if (field.find_first_of(",\"\n\r") == std::string::npos) return field;
  std::string text = "\"";
  for (const char c : field) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

// Splits one record off the front of `text`, line end included.
std::vector<std::string> take_record(std::string_view& text) {
  std::vector<std::string> field(1);
  bool inside_quotes = false;
  std::size_t at = 0;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"') {
      const bool doubled = inside_quotes && at + 1 < text.size() && text[at + 1] == '"';
      if (doubled)
        field.back() += text[at++];
      else
        inside_quotes = !inside_quotes;
    } else if (c == ',' && !inside_quotes) {
      field.emplace_back();
    } else if (c == '\n' && !inside_quotes) {
      ++at;
      break;
    } else if (c != '\r' || inside_quotes) {
      field.back() += c;
    }
  }
  text.remove_prefix(at);
  return field;
}

std::vector<double> numbers(const std::vector<std::string>& field, const std::string& where) {
  std::vector<double> row(field.size());
  for (std::size_t k = 0; k < field.size(); ++k) {
    const char *begin = field[k].data(), *end = begin + field[k].size();
    const auto [stop, error] = std::from_chars(begin, end, row[k]);
    if (error != std::errc{} || stop != end)
      throw InputError(fmt::format("{}: '{}' is no number; write the history anew", where, field[k]));
  }
  return row;
}

}  // namespace

int History::index(const std::string& name) const {
  const auto found = std::find(column.begin(), column.end(), name);
  return found == column.end() ? -1 : static_cast<int>(found - column.begin());
}

std::vector<double> History::values(const std::string& name) const {
  const int k = index(name);
  if (k < 0)
    throw InputError(fmt::format("history has no column '{}'; its columns are {}", name, fmt::join(column, ", ")));
  std::vector<double> values;
  values.reserve(row.size());
  for (const auto& one : row) values.push_back(one[k]);
  return values;
}

std::string history_rows_text(const History& history, int first, int last) {
  std::string text;
  const auto out = std::back_inserter(text);
  for (int r = first; r < last; ++r) {
    const auto& row = history.row[r];
    for (std::size_t k = 0; k < row.size(); ++k) fmt::format_to(out, "{}{:.10g}", k == 0 ? "" : ",", row[k]);
    text += '\n';
  }
  return text;
}

std::string history_text(const History& history, int first, int last) {
  std::string text;
  for (std::size_t k = 0; k < history.column.size(); ++k) {
    if (k > 0) text += ',';
    text += quoted(history.column[k]);
  }
  text += '\n';
  return text + history_rows_text(history, first, last);
}

void write_history(const History& history, const std::filesystem::path& file) {
  write_text_whole(file, history_text(history, 0, static_cast<int>(history.row.size())));
}

History read_history(const std::filesystem::path& file, HistoryEnd end) {
  const std::string content = read_text_file(file);
  std::string_view text = content;
  if (end == HistoryEnd::may_be_torn) text = text.substr(0, text.rfind('\n') + 1);
  if (text.empty() && end == HistoryEnd::may_be_torn)
    throw InputError(fmt::format("{}: has no heading yet; go on with --resume", file.string()));
  History history;
  history.column = take_record(text);
  for (int line = 2; !text.empty(); ++line) {
    const std::string where = fmt::format("{}:{}", file.string(), line);
    const std::vector<std::string> field = take_record(text);
    if (field.size() != history.column.size())
      throw InputError(fmt::format("{}: {} values under {} columns; write the history anew", where, field.size(),
                                   history.column.size()));
    history.row.push_back(numbers(field, where));
  }
  return history;
}

}  // namespace weaveform
