#include "mesher/exchange/abaqus/inp_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/files/text_words.hpp"

namespace weaveform {

namespace {

namespace fs = std::filesystem;

const std::string weave_mark = "** weaveform ";
constexpr std::size_t most_deep = 8;      // files within files; Abaqus itself allows five
constexpr std::size_t most_files = 1000;  // of one deck
constexpr std::string_view blanks = " \t\r\f\v";

std::string_view stripped(std::string_view text) {
  const std::size_t from = text.find_first_not_of(blanks);
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(blanks) - from + 1);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.emplace_back(stripped(line));
  const std::string byte_order_mark = "\xEF\xBB\xBF";
  if (!lines.empty() && lines.front().rfind(byte_order_mark, 0) == 0) lines.front().erase(0, byte_order_mark.size());
  return lines;
}

std::string unquoted(std::string_view text) {
  if (text.size() > 1 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front())
    text = text.substr(1, text.size() - 2);
  return std::string(text);
}

fs::path resolved(const fs::path& path) {
  std::error_code error;
  const fs::path found = fs::canonical(path, error);
  return error ? path : found;
}

bool is_comment(const std::string& line) {
  return line.compare(0, 2, "**") == 0;
}

bool begins_like_data(const std::string& line) {
  return !line.empty() && (std::isdigit(static_cast<unsigned char>(line[0])) != 0 || line[0] == '-' || line[0] == '+');
}

}  // namespace

InpLines::InpLines(const fs::path& file) {
  open(file, file.string(), false);
}

void InpLines::fail(const InpSource& at, const std::string& what) const {
  throw InputError(fmt::format("{}:{}: {}", files_[static_cast<std::size_t>(at.file)], at.line, what));
}

long InpLines::whole(std::string_view word, const char* what) const {
  long value = 0;
  const std::string trouble = read_whole(word, value);
  if (!trouble.empty()) fail(fmt::format("{} ({})", trouble, what));
  return value;
}

double InpLines::real(std::string_view word, const char* what) const {
  double value = 0.0;
  const std::string trouble = read_real(word, value);
  if (!trouble.empty()) fail(fmt::format("{} ({})", trouble, what));
  return value;
}

void InpLines::open(const fs::path& path, const std::string& shown, bool data_only) {
  const std::string text = read_text_file(path, most_text - bytes_);
  bytes_ += text.size();
  OpenFile opened{static_cast<int>(files_.size()), resolved(path), lines_of(text), 0, data_only};
  files_.push_back(shown);
  open_.push_back(std::move(opened));
}

void InpLines::enter(const std::string& name, const InpSource& from, const std::string& what, bool data_only) {
  if (name.empty()) fail(from, what + " names no file (INPUT=FILE)");
  const std::string& parent = files_[static_cast<std::size_t>(from.file)];
  const fs::path path = fs::path(parent).parent_path() / name;  // an absolute name stays what it is
  std::error_code error;
  if (!fs::is_regular_file(path, error))
    throw FileError(fmt::format("{}:{}: {}, INPUT={}: no such file beside {} (names are relative to it)", parent,
                                from.line, what, name, parent));
  const fs::path itself = resolved(path);
  for (const auto& file : open_)
    if (file.path == itself) fail(from, fmt::format("{}, INPUT={}: the file includes itself", what, name));
  if (open_.size() >= most_deep)
    fail(from, fmt::format("{}, INPUT={}: files within files more than {} deep", what, name, most_deep));
  if (files_.size() >= most_files) fail(from, fmt::format("more than {} files are included", most_files));
  open(path, path.string(), data_only);
}

void InpLines::enter_data(const InpKeyword& keyword) {
  enter(keyword.value("INPUT"), keyword.at, keyword.name, true);
}

bool InpLines::fill() {
  while (!ahead_) {
    if (open_.empty()) return false;
    OpenFile& file = open_.back();
    if (file.next == file.lines.size()) {
      open_.pop_back();
      continue;
    }
    Line line{{file.file, static_cast<int>(file.next) + 1}, file.lines[file.next], false};
    ++file.next;
    if (is_comment(line.text)) {
      if (file.file == 0 && line.text.compare(0, weave_mark.size(), weave_mark) == 0)
        weave_.push_back({line.at.line, line.text.substr(weave_mark.size())});
      continue;
    }
    if (line.text.empty()) continue;
    line.keyword = line.text[0] == '*';
    if (!line.keyword) {
      ahead_ = std::move(line);
      continue;
    }
    if (file.data_only)
      fail(line.at, fmt::format("a keyword ({}) where only data lines are expected; give such a file to *INCLUDE",
                                line.text.substr(0, 40)));
    while (line.text.back() == ',' && file.next < file.lines.size() && file.lines[file.next].compare(0, 1, "*") != 0 &&
           !begins_like_data(file.lines[file.next]))
      line.text += file.lines[file.next++];
    const InpKeyword keyword = keyword_of(line);
    if (keyword.name == "*INCLUDE")
      enter(keyword.value("INPUT"), line.at, keyword.name, false);
    else
      ahead_ = std::move(line);
  }
  return true;
}

InpKeyword InpLines::keyword_of(const Line& line) const {
  InpKeyword keyword;
  keyword.at = line.at;
  const auto fields = fields_of(line.text, ',');
  keyword.name = upper(fields[0]);
  keyword.name.erase(std::remove_if(keyword.name.begin(), keyword.name.end(),
                                    [](char c) { return blanks.find(c) != std::string_view::npos; }),
                     keyword.name.end());
  for (std::size_t k = 1; k < fields.size(); ++k) {
    const std::size_t equal = fields[k].find('=');
    const std::string value = equal == std::string_view::npos ? "" : unquoted(trimmed(fields[k].substr(equal + 1)));
    keyword.parameter[upper(trimmed(fields[k].substr(0, equal)))] = value;
  }
  return keyword;
}

std::optional<InpKeyword> InpLines::next_keyword() {
  while (fill()) {
    const Line line = std::move(*ahead_);
    ahead_.reset();
    at_ = line.at;
    if (line.keyword) {
      begun_ = true;
      return keyword_of(line);
    }
    if (!begun_) fail("a keyword (*...) expected; is this an Abaqus input file?");
  }
  return std::nullopt;
}

bool InpLines::next_data(std::string& line) {
  if (!fill() || ahead_->keyword) return false;
  at_ = ahead_->at;
  line = std::move(ahead_->text);
  ahead_.reset();
  return true;
}

bool InpLines::next_fields(std::vector<std::string>& fields, std::size_t least) {
  fields.clear();
  std::string line;
  while (next_data(line)) {
    for (const auto field : fields_of(line, ',')) fields.emplace_back(field);
    const bool goes_on = fields.back().empty();  // the line ends with a comma
    if (goes_on) fields.pop_back();
    if (!goes_on || fields.size() >= least) return true;
  }
  return !fields.empty();
}

}  // namespace weaveform
