// Arrays as text: the bytes of numbers as they lie in memory (little-endian, as on every machine this runs on), in base64
// (RFC 4648), as web pages read them.
#pragma once

#include <string>
#include <vector>

namespace weaveform {

[[nodiscard]] std::string base64(const unsigned char* bytes, std::size_t count);

template <class Number>
[[nodiscard]] std::string base64(const std::vector<Number>& numbers) {
  return base64(reinterpret_cast<const unsigned char*>(numbers.data()), numbers.size() * sizeof(Number));
}

}  // namespace weaveform
