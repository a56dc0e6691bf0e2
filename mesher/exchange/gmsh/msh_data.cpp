#include "mesher/exchange/gmsh/msh_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/files/text_words.hpp"

namespace weaveform {

namespace {
constexpr long most_items = 100'000'000;  // nodes, elements, entities, names
constexpr double greatest_number = 1e30;  // the square of a greater one may be infinite soon
}  // namespace

MshData::MshData(const std::filesystem::path& file) : name_(file.string()), text_(read_text_file(file)) {}

void MshData::fail(const std::string& what) const {
  if (binary_) throw InputError(fmt::format("{}, byte {}: {}", name_, next_, what));
  throw InputError(fmt::format("{}:{}: {}", name_, line_, what));
}

std::string_view MshData::text_line() {
  if (at_end()) fail("the file ends too early; it may have been cut short");
  const std::size_t end = std::min(text_.find('\n', next_), text_.size());
  std::string_view line = std::string_view(text_).substr(next_, end - next_);
  next_ = std::min(end + 1, text_.size());
  ++line_;
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return trimmed(line);
}

void MshData::begin_record() {
  if (!binary_) record_ = text_line();
}

void MshData::end_record() {
  if (!binary_ && !trimmed(record_).empty())
    fail(fmt::format("more numbers than expected: '{}' is left over", trimmed(record_).substr(0, 40)));
}

std::string_view MshData::word(const char* what) {
  record_ = trimmed(record_);
  if (record_.empty()) fail(fmt::format("a number expected ({}), the line ends", what));
  const std::size_t end = std::min(record_.find_first_of(" \t"), record_.size());
  const std::string_view found = record_.substr(0, end);
  record_.remove_prefix(end);
  return found;
}

template <class Value>
Value MshData::bytes(const char* what) {
  if (text_.size() - next_ < sizeof(Value))
    fail(fmt::format("the file ends too early ({}); it may have been cut short", what));
  char raw[sizeof(Value)];
  std::memcpy(raw, text_.data() + next_, sizeof raw);
  if (swapped_) std::reverse(raw, raw + sizeof raw);
  next_ += sizeof raw;
  Value value{};
  std::memcpy(&value, raw, sizeof raw);
  return value;
}

long MshData::integer(const char* what) {
  if (binary_) return bytes<std::int32_t>(what);
  long value = 0;
  const std::string trouble = read_whole(word(what), value);
  if (!trouble.empty()) fail(fmt::format("{} ({})", trouble, what));
  return value;
}

long MshData::size(const char* what) {
  if (!binary_) return integer(what);
  const auto value = bytes<std::uint64_t>(what);
  if (value > static_cast<std::uint64_t>(INT64_MAX)) fail(fmt::format("{} is out of range ({})", value, what));
  return static_cast<long>(value);
}

double MshData::real(const char* what) {
  double value = 0.0;
  if (!binary_) {
    const std::string trouble = read_real(word(what), value);
    if (!trouble.empty()) fail(fmt::format("{} ({})", trouble, what));
    return value;
  }
  value = bytes<double>(what);
  if (!(std::abs(value) <= greatest_number)) fail(fmt::format("{} is no number for a place ({})", value, what));
  return value;
}

long MshData::count(const char* what, bool four_bytes) {
  const long value = four_bytes ? integer(what) : size(what);
  if (value < 0 || value > most_items) fail(fmt::format("{} {} is out of range", value, what));
  return value;
}

void MshData::skip(std::size_t bytes, const char* what) {
  if (text_.size() - next_ < bytes) fail(fmt::format("the file ends too early ({}); it may have been cut short", what));
  next_ += bytes;
}

}  // namespace weaveform
