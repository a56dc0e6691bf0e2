// history.csv: comma-separated, one header line, numbers with ten significant digits.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "core/files/csv.hpp"
#include "core/files/files.hpp"
#include "solver/result/result.hpp"

namespace weaveform {

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
  return csv_line(history.column) + history_rows_text(history, first, last);
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
  CsvReader in(text, file.string());
  history.column = in.advance() ? in.cells() : std::vector<std::string>{""};
  while (in.advance()) {
    const std::size_t count = in.cells().size();
    if (count != history.column.size())
      throw InputError(fmt::format("{}: {} values under {} columns; write the history anew", in.place(), count,
                                   history.column.size()));
    std::vector<double> row(count);
    for (std::size_t k = 0; k < count; ++k) row[k] = in.number(k, "write the history anew");
    history.row.push_back(std::move(row));
  }
  return history;
}

}  // namespace weaveform
