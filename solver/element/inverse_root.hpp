// 1/sqrt(x) for x in the normal range of single precision (1e-37 to 1e38), by an estimate in single precision and one
// step of third order in double, in a third of the time that a vector unit takes for root and division. (Divisions alone
// are left to it: they overlap with what else a loop does, and an estimate's steps did not.)
//
// With x r^2 = 1 - e, 1/sqrt(x) = r (1 - e)^(-1/2) = r (1 + e/2 + 3 e^2/8 + 5 e^3/16 + O(e^4)), e below 1e-5: the
// exponent's half with its sign turned, and Newton's r (3 - x r^2)/2 twice.
#pragma once

#include "solver/element/lanes.hpp"

namespace weaveform {

inline constexpr std::int32_t half_exponent = 0x5f375a86;  // Lomont 2003: the estimate's error is 3.4 % at most

template <class Short>
[[gnu::always_inline]] inline Short improved_root(const Short& x, const Short& r) {
  const Short better = r * (1.5F - 0.5F * x * r * r);
  return better * (1.5F - 0.5F * x * better * better);
}
// Relative error below 5e-6.
[[gnu::always_inline]] inline double estimate_inverse_root(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(
      improved_root(f, std::bit_cast<float>(half_exponent - (std::bit_cast<std::int32_t>(f) >> 1))));
}
template <int parts>
[[gnu::always_inline]] inline Pack<parts, float> estimate_inverse_root(const Pack<parts, float>& x) {
  Pack<parts, float> result;
  WEAVEFORM_FOR_PARTS(result.part[i] = improved_root(
                          x.part[i], std::bit_cast<NativeVector<float>>(
                                         half_exponent - (std::bit_cast<NativeBits<float>>(x.part[i]) >> 1))))
  return result;
}
template <int parts>
[[gnu::always_inline]] inline Pack<parts> estimate_inverse_root(const Pack<parts>& x) {
  using ShortBits = VectorOf<std::int32_t, native_width>::Type;
  ShortVector f[parts], r[parts];
  WEAVEFORM_FOR_PARTS(f[i] = narrowed(x.part[i]))
  WEAVEFORM_FOR_PARTS(r[i] = std::bit_cast<ShortVector>(half_exponent - (std::bit_cast<ShortBits>(f[i]) >> 1)))
  Pack<parts> result;
  WEAVEFORM_FOR_PARTS(result.part[i] = widened(improved_root(f[i], r[i])))
  return result;
}

// Relative error below 4e-16, in single precision below 2e-7.
template <class T>
[[gnu::always_inline]] inline T inverse_root(const T& x) {
  const T r = estimate_inverse_root(x), e = 1.0 - x * r * r;
  if constexpr (std::is_same_v<Real<T>, float>)
    return r + r * e * 0.5;
  else
    return r + r * e * (0.5 + e * (0.375 + 0.3125 * e));
}

}  // namespace weaveform
