// Half the logarithm of a ratio, ln(a/b)/2, which both strains of the theory are: the true strain of a yarn from a = L^2,
// b = L0^2, and the logarithmic shear strain of a cell, atanh(s), from a = 1 + s, b = 1 - s. No branch, no
// table, no relaxed floating point, the same bits in a lane as alone. a, b:
// positive, normal, finite, a/b within 2^+-1000. Error below 4e-16 of the result, also where a and b are close: it is
// atanh((a - b)/(a + b)) there, and the difference is exact.
//
// Method: with the power of two that is nearest to a/b, ln(a/b)/2 = k ln2/2 + atanh(r), r = (a - 2^k b)/(a + 2^k b), and
// |r| <= 0.2005, since what k rounds is log2(a/b) to 0.0861 (a mantissa for its logarithm). atanh(r)/r is a polynomial in
// r^2 that is off by 6e-19 at most, a Chebyshev fit in 40 digits.
#pragma once

#include <cstdint>

#include "solver/element/lanes.hpp"

namespace weaveform {

// Up to the one division: the caller may make it together with another of its own.
template <class T>
struct HalfLog {
  T numerator, denominator;  // r is their ratio
  T power;                   // k

  [[gnu::always_inline]] inline T value(const T& r) const {
    constexpr double high = 0.5 * 6.93147180369123816490e-01;  // ln2/2 in two parts, of which k * high is exact
    constexpr double low = 0.5 * 1.90821492927058770002e-10;
    const T u = r * r;
    const T series =
        u *
        (0.333333333333333321 +
         u * (0.20000000000004042 +
              u * (0.142857142836058488 +
                   u * (0.111111115295165183 +
                        u * (0.0909086839460080141 +
                             u * (0.0769445059859283947 + u * (0.0660452622200027622 + u * 0.0680702979288638083)))))));
    return power * high + (r + (r * series + power * low));
  }
};

template <class T>
[[gnu::always_inline]] inline HalfLog<T> half_log_parts(const T& a, const T& b) {
  constexpr std::int64_t exponent_mask = static_cast<std::int64_t>(0xfff0000000000000ULL);
  constexpr std::int64_t half = std::int64_t{1} << 51;
  const auto rounded = bits_of(a) - bits_of(b) + half;
  const T near = number_of(bits_of(b) + (rounded & exponent_mask));  // 2^k b
  // k as a double without an integer conversion: placed in the mantissa of 1.5 * 2^52
  const T k = number_of((rounded >> 52) + 0x4338000000000000) - 6755399441055744.0;
  return {a - near, a + near, k};
}

template <class T>
[[gnu::always_inline]] inline T half_log(const T& a, const T& b) {
  const HalfLog<T> parts = half_log_parts(a, b);
  return parts.value(parts.numerator / parts.denominator);
}

}  // namespace weaveform
