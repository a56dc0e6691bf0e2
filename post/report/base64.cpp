#include "post/report/base64.hpp"

#include <algorithm>
#include <bit>

namespace weaveform {

static_assert(std::endian::native == std::endian::little);

std::string base64(const unsigned char* bytes, std::size_t count) {
  constexpr const char* digit = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((count + 2) / 3 * 4);
  for (std::size_t at = 0; at < count; at += 3) {
    const std::size_t here = std::min<std::size_t>(3, count - at);
    unsigned group = static_cast<unsigned>(bytes[at]) << 16U;
    if (here > 1) group |= static_cast<unsigned>(bytes[at + 1]) << 8U;
    if (here > 2) group |= static_cast<unsigned>(bytes[at + 2]);
    text += digit[group >> 18U];
    text += digit[group >> 12U & 63U];
    text += here > 1 ? digit[group >> 6U & 63U] : '=';
    text += here > 2 ? digit[group & 63U] : '=';
  }
  return text;
}

}  // namespace weaveform
