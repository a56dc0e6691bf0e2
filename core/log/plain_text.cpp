#include "core/log/plain_text.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace weaveform {
namespace {

constexpr std::size_t least_utf16 = 16;  // bytes; fewer say nothing without a byte-order mark
constexpr char32_t replacement = 0xFFFD;

void append_utf8(std::string& text, char32_t c) {
  const auto tail = [&](int shift) { text += static_cast<char>(0x80U | ((c >> shift) & 0x3FU)); };
  if (c < 0x80) {
    text += static_cast<char>(c);
  } else if (c < 0x800) {
    text += static_cast<char>(0xC0U | (c >> 6));
    tail(0);
  } else if (c < 0x10000) {
    text += static_cast<char>(0xE0U | (c >> 12));
    tail(6), tail(0);
  } else {
    text += static_cast<char>(0xF0U | (c >> 18));
    tail(12), tail(6), tail(0);
  }
}

// The character that begins at `at`, which moves past it; nothing when the bytes are no UTF-8.
std::optional<char32_t> next_utf8(std::string_view text, std::size_t& at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xC2 ? 0
                             : lead < 0xE0 ? 2
                             : lead < 0xF0 ? 3
                             : lead < 0xF5 ? 4
                                           : 0;
  if (length == 0 || at + length > text.size()) return std::nullopt;
  constexpr std::array<unsigned, 5> mask = {0, 0x7F, 0x1F, 0x0F, 0x07};
  char32_t c = lead & mask[length];
  for (std::size_t k = 1; k < length; ++k) {
    const auto byte = static_cast<unsigned char>(text[at + k]);
    if ((byte & 0xC0U) != 0x80U) return std::nullopt;
    c = (c << 6) | (byte & 0x3FU);
  }
  at += length;
  return c;
}

// Windows-1252 from 0x80 to 0x9F; the rest of it is Latin-1.
constexpr std::array<char32_t, 32> windows_1252 = {0x20AC, 0x81,   0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021,
                                                   0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0x8D,   0x017D, 0x8F,
                                                   0x90,   0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
                                                   0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x9D,   0x017E, 0x0178};

enum class Encoding { utf8, windows, utf16_little, utf16_big };

Encoding encoding_of(std::string_view text) {
  if (text.starts_with("\xFF\xFE")) return Encoding::utf16_little;
  if (text.starts_with("\xFE\xFF")) return Encoding::utf16_big;
  // without a mark: every second byte of plain Latin text is zero
  const std::size_t pairs = std::min<std::size_t>(text.size(), 2000) / 2;
  if (2 * pairs >= least_utf16) {
    std::array<std::size_t, 2> zeros = {0, 0};
    for (std::size_t k = 0; k < 2 * pairs; ++k) zeros[k % 2] += text[k] == '\0' ? 1 : 0;
    if (zeros[0] == 0 && 10 * zeros[1] > 9 * pairs) return Encoding::utf16_little;
    if (zeros[1] == 0 && 10 * zeros[0] > 9 * pairs) return Encoding::utf16_big;
  }
  for (std::size_t at = 0; at < text.size();)
    if (!next_utf8(text, at)) return Encoding::windows;
  return Encoding::utf8;
}

char32_t utf16_unit(std::string_view text, std::size_t at, bool little) {
  const auto byte = [&](std::size_t k) { return static_cast<char32_t>(static_cast<unsigned char>(text[k])); };
  return little ? byte(at) | (byte(at + 1) << 8) : byte(at + 1) | (byte(at) << 8);
}

char32_t next_utf16(std::string_view text, std::size_t& at, bool little) {
  const char32_t first = utf16_unit(text, at, little);
  at += 2;
  if (first < 0xD800 || first > 0xDFFF) return first;
  if (first > 0xDBFF || at + 2 > text.size()) return replacement;
  const char32_t second = utf16_unit(text, at, little);
  if (second < 0xDC00 || second > 0xDFFF) return replacement;
  at += 2;
  return 0x10000 + ((first - 0xD800) << 10) + (second - 0xDC00);
}

void append_folded(std::string& text, char32_t c) {
  switch (c) {
    case 0x201C:
    case 0x201D:
    case 0x201E:
    case 0x201F:
    case 0xAB:
    case 0xBB:
    case 0x2033:  // quotes
      text += '"';
      return;
    case 0x2018:
    case 0x2019:
    case 0x201A:
    case 0x201B:
    case 0x2032:
      text += '\'';
      return;
    case 0xA0:
    case 0x2007:
    case 0x2009:
    case 0x202F:  // blanks that do not break
      text += ' ';
      return;
    case 0x2212:
    case 0x2010:
    case 0x2011:
    case 0x2012:
    case 0x2013:
    case 0x2014:  // minus and dashes
      text += '-';
      return;
    case 0x3BC:
      append_utf8(text, 0xB5);
      return;
    case 0xFEFF:  // byte-order mark
      return;
    default:
      append_utf8(text, c);
  }
}

std::string decoded(std::string_view bytes) {
  const Encoding encoding = encoding_of(bytes);
  std::string text;
  text.reserve(bytes.size());
  for (std::size_t at = 0; at < bytes.size();) {
    if (encoding == Encoding::utf8) {
      append_folded(text, next_utf8(bytes, at).value_or(replacement));
    } else if (encoding == Encoding::windows) {
      const auto byte = static_cast<unsigned char>(bytes[at++]);
      append_folded(text, byte >= 0x80 && byte < 0xA0 ? windows_1252[byte - 0x80] : byte);
    } else if (at + 1 < bytes.size()) {
      append_folded(text, next_utf16(bytes, at, encoding == Encoding::utf16_little));
    } else {
      ++at;  // half a character at the end of a file cut off
    }
  }
  return text;
}

}  // namespace

std::string plain_text(std::string bytes) {
  // A large file of numbers is ASCII and stays as it is.
  const auto special = [](char c) { return c == '\0' || static_cast<unsigned char>(c) >= 0x80; };
  if (std::any_of(bytes.begin(), bytes.end(), special)) bytes = decoded(bytes);
  if (bytes.find('\r') != std::string::npos && bytes.find('\n') == std::string::npos)
    std::replace(bytes.begin(), bytes.end(), '\r', '\n');
  return bytes;
}

}  // namespace weaveform
