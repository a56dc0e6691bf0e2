// Damaged variants of a sound file, the same ones in every run.
#pragma once

#include <algorithm>
#include <cstddef>
#include <random>
#include <string>

namespace weaveform::test {

// Variant `seed`: some bytes changed, bits flipped, a stretch taken out or doubled, digits made long, or the end cut
// off.
inline std::string damaged(const std::string& sound, unsigned seed) {
  std::mt19937 random(seed);
  std::string text = sound;
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % std::max<std::size_t>(n, 1)); };
  for (std::size_t times = 1 + below(3); times > 0 && !text.empty(); --times) {
    const std::size_t at = below(text.size()), length = std::min(1 + below(40), text.size() - at);
    switch (below(7)) {
      case 0:
        text[at] = static_cast<char>(random());
        break;
      case 1:
        text[at] = static_cast<char>(static_cast<unsigned char>(text[at]) ^ (1U << below(8)));
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(at, text.substr(at, length));
        break;
      case 4: {
        const std::size_t digit = text.find_first_of("0123456789", at);
        if (digit != std::string::npos) text.insert(digit, below(2) == 0 ? "9" : "99999999999");
        break;
      }
      case 5: {
        const std::size_t digit = text.find_first_of("0123456789", at);
        if (digit != std::string::npos) text[digit] = static_cast<char>('0' + below(10));
        break;
      }
      default:
        if (below(4) == 0) text.resize(at);
    }
  }
  return text;
}

}  // namespace weaveform::test
