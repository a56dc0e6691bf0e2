// Digests by which a content is known again (XXH3, 128 bits; Collet, github.com/Cyan4973/xxHash). They find what was
// changed or damaged; they are no defence against somebody who forges.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace weaveform {

class Digest {
public:
  Digest();
  ~Digest();
  Digest(const Digest&) = delete;
  Digest& operator=(const Digest&) = delete;

  // A text counts with its length, so that "ab" and "c" are not "a" and "bc".
  void add(std::string_view text);
  void add(const std::string& text) { add(std::string_view(text)); }
  // The bytes of numbers, and of plain structs and arrays without padding.
  template <class T>
  void add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    add_bytes(&value, sizeof value);
  }
  template <class T>
  void add(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    add(static_cast<std::uint64_t>(values.size()));
    add_bytes(values.data(), values.size() * sizeof(T));
  }
  [[nodiscard]] std::string hex() const;  // 32 digits

private:
  void add_bytes(const void* data, std::size_t size);
  struct State;
  std::unique_ptr<State> state_;
};

[[nodiscard]] std::string digest_of(std::string_view text);

// 64 bits over all bytes, to find a damaged file.
[[nodiscard]] std::uint64_t check_sum(std::string_view bytes);

}  // namespace weaveform
