// Plain values to bytes and back, between two processes of one machine. The reader trusts nothing: every length is
// compared with what is there before it is used.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace weaveform {

class ByteWriter {
public:
  template <class Value>
  void value(const Value& from) {
    static_assert(std::is_trivially_copyable_v<Value>);
    bytes_.append(reinterpret_cast<const char*>(&from), sizeof from);
  }
  void text(std::string_view from) {
    value<std::uint64_t>(from.size());
    bytes_.append(from);
  }
  template <class Value>
  void list(const Value* from, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<Value>);
    value<std::uint64_t>(count);
    if (count > 0) bytes_.append(reinterpret_cast<const char*>(from), count * sizeof(Value));
  }
  template <class Value>
  void list(const std::vector<Value>& from) {
    list(from.data(), from.size());
  }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

private:
  std::string bytes_;
};

// Throws std::runtime_error where the bytes end too early.
class ByteReader {
public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}
  template <class Value>
  [[nodiscard]] Value value() {
    static_assert(std::is_trivially_copyable_v<Value>);
    Value to{};
    std::memcpy(&to, taken(sizeof to).data(), sizeof to);
    return to;
  }
  [[nodiscard]] std::string text() { return std::string(taken(count_of(1))); }
  template <class Value>
  [[nodiscard]] std::vector<Value> list() {
    static_assert(std::is_trivially_copyable_v<Value>);
    const std::size_t count = count_of(sizeof(Value));
    std::vector<Value> to(count);
    const std::string_view from = taken(count * sizeof(Value));
    if (count > 0) std::memcpy(to.data(), from.data(), from.size());
    return to;
  }
  // A number of entries of at least `least` bytes each, which must be there.
  [[nodiscard]] std::size_t count_of(std::size_t least) {
    const auto count = value<std::uint64_t>();
    if (count > rest_.size() / least) throw std::runtime_error("bytes end too early");
    return static_cast<std::size_t>(count);
  }
  [[nodiscard]] bool at_end() const { return rest_.empty(); }

private:
  std::string_view taken(std::size_t size) {
    if (size > rest_.size()) throw std::runtime_error("bytes end too early");
    const std::string_view part = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return part;
  }
  std::string_view rest_;
};

}  // namespace weaveform
