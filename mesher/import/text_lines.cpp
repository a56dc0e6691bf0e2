#include "mesher/import/text_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>

#include "mesher/base/error.hpp"
#include "mesher/base/files.hpp"

namespace weaveform {

namespace {
constexpr double greatest_number = 1e30;  // the square of a greater one may be infinite soon
}

TextLines::TextLines(const std::filesystem::path& file) : name_(file.string()) {
  std::istringstream in(read_text_file(file));
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    lines_.push_back(std::move(line));
  }
}

const std::string& TextLines::next() {
  if (at_end()) fail("the file ends too early; it may have been cut short");
  return lines_[next_++];
}

void TextLines::fail_at(int line, const std::string& what) const {
  throw InputError(fmt::format("{}:{}: {}", name_, line, what));
}

long TextLines::whole(std::string_view word, const std::string& what) const {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  long value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || error != std::errc() || end != word.data() + word.size())
    fail(fmt::format("'{}' is no whole number ({})", word, what));
  return value;
}

double TextLines::real(std::string_view word, const std::string& what) const {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  std::string text(word);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');  // Fortran's exponent
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    fail(fmt::format("'{}' is no finite number ({})", word, what));
  if (std::abs(value) > greatest_number) fail(fmt::format("'{}' is beyond all measure ({})", word, what));
  return value;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  std::size_t at = 0;
  while ((at = line.find_first_not_of(" \t", at)) != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t from = text.find_first_not_of(" \t");
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(" \t") - from + 1);
}

std::vector<std::string_view> fields_of(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  std::size_t at = 0;
  while (true) {
    const std::size_t end = line.find(separator, at);
    fields.push_back(trimmed(line.substr(at, end == std::string_view::npos ? end : end - at)));
    if (end == std::string_view::npos) return fields;
    at = end + 1;
  }
}

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

}  // namespace weaveform
