#include "solver/state/archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace weaveform {
namespace {

constexpr std::size_t longest_text = 1 << 16;

template <class T>
void append(std::string& bytes, const T* values, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

}  // namespace

void Archive::list(const char* what, std::vector<double>& values, std::size_t least, std::size_t most, Bounds bounds) {
  values.resize(length(what, values.size(), least, most));
  numbers(what, values, bounds);
}

void StateWriter::number(const char* /*what*/, double& value, Bounds /*bounds*/) {
  append(bytes_, &value, 1);
}

void StateWriter::count(const char* /*what*/, std::int64_t& value, std::int64_t /*least*/, std::int64_t /*most*/) {
  append(bytes_, &value, 1);
}

void StateWriter::flag(const char* /*what*/, bool& value) {
  bytes_.push_back(value ? '\1' : '\0');
}

void StateWriter::text(const char* what, std::string& value) {
  append(bytes_, value.data(), length(what, value.size(), 0, longest_text));
}

void StateWriter::numbers(const char* what, std::span<double> values, Bounds /*bounds*/) {
  append(bytes_, values.data(), length(what, values.size(), values.size(), values.size()));
}

void StateWriter::indices(const char* what, std::span<int> values, int /*least*/, int /*most*/) {
  append(bytes_, values.data(), length(what, values.size(), values.size(), values.size()));
}

std::size_t StateWriter::length(const char* /*what*/, std::size_t now, std::size_t /*least*/, std::size_t /*most*/) {
  const std::uint64_t count = now;
  append(bytes_, &count, 1);
  return now;
}

void StateReader::take(void* to, std::size_t size) {
  if (size > left_.size()) throw DamagedState{"cut short"};
  if (size > 0) std::memcpy(to, left_.data(), size);
  left_.remove_prefix(size);
}

void StateReader::number(const char* what, double& value, Bounds bounds) {
  take(&value, sizeof value);
  if (!bounds.hold(value)) throw DamagedState{fmt::format("{} that cannot be", what)};
}

void StateReader::count(const char* what, std::int64_t& value, std::int64_t least, std::int64_t most) {
  take(&value, sizeof value);
  if (value < least || value > most) throw DamagedState{fmt::format("{} that cannot be", what)};
}

void StateReader::flag(const char* what, bool& value) {
  std::uint8_t byte = 0;
  take(&byte, 1);
  if (byte > 1) throw DamagedState{fmt::format("{} that is neither set nor not", what)};
  value = byte == 1;
}

void StateReader::text(const char* what, std::string& value) {
  const std::size_t size = length(what, 0, 0, longest_text);
  if (size > left_.size()) throw DamagedState{"cut short"};
  value.assign(left_.substr(0, size));
  left_.remove_prefix(size);
}

void StateReader::numbers(const char* what, std::span<double> values, Bounds bounds) {
  (void)length(what, values.size(), values.size(), values.size());
  take(values.data(), values.size_bytes());
  if (!std::all_of(values.begin(), values.end(), [&](double value) { return bounds.hold(value); }))
    throw DamagedState{fmt::format("{} that cannot be", what)};
}

void StateReader::indices(const char* what, std::span<int> values, int least, int most) {
  (void)length(what, values.size(), values.size(), values.size());
  take(values.data(), values.size_bytes());
  if (!std::all_of(values.begin(), values.end(), [&](int value) { return value >= least && value <= most; }))
    throw DamagedState{fmt::format("{} that cannot be", what)};
}

std::size_t StateReader::length(const char* what, std::size_t /*now*/, std::size_t least, std::size_t most) {
  std::uint64_t count = 0;
  take(&count, sizeof count);
  if (count < least || count > most)
    throw DamagedState{fmt::format("{} entries of {} where there must be {}{}", count, what, least,
                                   least == most ? "" : fmt::format(" to {}", most))};
  if (count > left_.size()) throw DamagedState{"cut short"};  // an entry has one byte at least
  return count;
}

void StateLook::number(const char* what, double& value, Bounds bounds) {
  if (found_.empty() && !bounds.hold(value)) found_ = what;
}

void StateLook::numbers(const char* what, std::span<double> values, Bounds bounds) {
  if (found_.empty() && !std::all_of(values.begin(), values.end(), [&](double value) { return bounds.hold(value); }))
    found_ = what;
}

}  // namespace weaveform
