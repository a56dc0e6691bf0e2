#include "mesher/mesh/quick_base64.hpp"

#include <vtkObjectFactory.h>

#include <cstring>

namespace weaveform {
namespace {

constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

// The two characters of every twelve bits.
const std::array<std::array<char, 2>, 4096> pair_of = [] {
  std::array<std::array<char, 2>, 4096> pairs{};
  for (std::size_t bits = 0; bits < pairs.size(); ++bits) pairs[bits] = {digits[bits >> 6U], digits[bits & 63U]};
  return pairs;
}();

char* encode_three(const unsigned char* bytes, char* to) {
  const unsigned bits = (static_cast<unsigned>(bytes[0]) << 16U) | (static_cast<unsigned>(bytes[1]) << 8U) | bytes[2];
  std::memcpy(to, pair_of[bits >> 12U].data(), 2);
  std::memcpy(to + 2, pair_of[bits & 4095U].data(), 2);
  return to + 4;
}

}  // namespace

vtkStandardNewMacro(QuickBase64);

int QuickBase64::StartWriting() {
  kept_ = 0;
  return 1;
}

int QuickBase64::Write(const void* data, size_t length) {
  const auto* from = static_cast<const unsigned char*>(data);
  const unsigned char* const end = from + length;
  characters_.resize(4 * (length / 3 + 2));
  char* to = characters_.data();
  while (kept_ > 0 && kept_ < 3 && from < end) three_[kept_++] = *from++;
  if (kept_ == 3) {
    to = encode_three(three_.data(), to);
    kept_ = 0;
  }
  for (; end - from >= 3; from += 3) to = encode_three(from, to);
  while (from < end) three_[kept_++] = *from++;
  return WriteStream(characters_.data(), static_cast<size_t>(to - characters_.data()));
}

int QuickBase64::EndWriting() {
  if (kept_ == 0) return 1;
  const std::array<unsigned char, 3> padded = {three_[0], kept_ > 1 ? three_[1] : static_cast<unsigned char>(0), 0};
  std::array<char, 4> last{};
  encode_three(padded.data(), last.data());
  for (int k = kept_ + 1; k < 4; ++k) last[k] = '=';
  kept_ = 0;
  return WriteStream(last.data(), last.size());
}

}  // namespace weaveform
