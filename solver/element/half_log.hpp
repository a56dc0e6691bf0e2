// Half the logarithm of a ratio, ln(a/b)/2, which both strains of the theory are: the true strain of a yarn from a = L^2,
// b = L0^2, and the logarithmic shear strain of a cell, atanh(s), from a = 1 + s, b = 1 - s. No branch, no
// table, no relaxed floating point, the same bits in a lane as alone. a, b:
// positive, normal, finite, a/b within 2^+-1000 (2^+-100 in single precision). Error below 4e-16 (2e-7) of the result,
// also where a and b are close: it is atanh((a - b)/(a + b)) there, and the difference is exact.
//
// Method: with the power of two that is nearest to a/b, ln(a/b)/2 = k ln2/2 + atanh(r), r = (a - 2^k b)/(a + 2^k b), and
// |r| <= 0.2005, since what k rounds is log2(a/b) to 0.0861 (a mantissa for its logarithm). atanh(r)/r is a polynomial in
// r^2 that is off by 6e-19 at most, a Chebyshev fit in 40 digits; in single precision the series' first terms, off by
// 1e-8.
#pragma once

#include <cstdint>

#include "solver/element/lanes.hpp"

namespace weaveform {

// How numbers of a precision hold their mantissa and exponent, and ln2/2 in two parts, of which k * high is exact.
template <class Real>
struct FloatingFormat;
template <>
struct FloatingFormat<double> {
  static constexpr int mantissa_bits = 52;
  static constexpr double shifter = 6755399441055744.0;  // 1.5 * 2^52
  static constexpr std::int64_t shifter_bits = 0x4338000000000000;
  static constexpr double half_ln2_high = 0.5 * 6.93147180369123816490e-01,
                          half_ln2_low = 0.5 * 1.90821492927058770002e-10;
};
template <>
struct FloatingFormat<float> {
  static constexpr int mantissa_bits = 23;
  static constexpr double shifter = 12582912.0;  // 1.5 * 2^23
  static constexpr std::int32_t shifter_bits = 0x4b400000;
  static constexpr double half_ln2_high = 0.5 * 0.693359375, half_ln2_low = 0.5 * -2.12194440054690583e-4;
};

// atanh(r)/r - 1 from u = r^2
template <class T>
[[gnu::always_inline]] inline T atanh_series(const T& u) {
  if constexpr (std::is_same_v<Real<T>, float>) {
    return u * (1.0 / 3.0 + u * (1.0 / 5.0 + u * (1.0 / 7.0 + u * (1.0 / 9.0))));
  } else {
    return u * (0.333333333333333321 +
                u * (0.20000000000004042 +
                     u * (0.142857142836058488 +
                          u * (0.111111115295165183 +
                               u * (0.0909086839460080141 +
                                    u * (0.0769445059859283947 +
                                         u * (0.0660452622200027622 + u * 0.0680702979288638083)))))));
  }
}

// Up to the one division: the caller may make it together with another of its own.
template <class T>
struct HalfLog {
  T numerator, denominator;  // r is their ratio
  T power;                   // k

  [[gnu::always_inline]] inline T value(const T& r) const {
    using Format = FloatingFormat<Real<T>>;
    return power * Format::half_ln2_high + (power * Format::half_ln2_low + near_value(r));
  }
  // The same bits where the power is zero.
  [[gnu::always_inline]] static inline T near_value(const T& r) { return r * atanh_series<T>(r * r) + r; }
};

// Ratios a/b whose nearest power of two is one: log2 of them is less than 1/2 by more than what rounding it is off by.
inline constexpr double least_near_ratio = 0.76, greatest_near_ratio = 1.32;

template <class T>
struct NearPower {
  T near, power;  // 2^k b, the nearest to a, and k
};

template <class T>
[[gnu::always_inline]] inline NearPower<T> near_power(const T& a, const T& b) {
  using Format = FloatingFormat<Real<T>>;
  using Whole = std::remove_const_t<decltype(Format::shifter_bits)>;
  constexpr int bits = Format::mantissa_bits;
  constexpr auto half = static_cast<Whole>(Whole{1} << (bits - 1));
  constexpr auto exponent_mask = static_cast<Whole>(~((Whole{1} << bits) - 1));
  const auto rounded = bits_of(a) - bits_of(b) + half;
  // k as a number without an integer conversion: placed in the mantissa of 1.5 * 2^mantissa_bits
  return {number_of(bits_of(b) + (rounded & exponent_mask)),
          number_of((rounded >> bits) + Format::shifter_bits) - Format::shifter};
}

template <class T>
[[gnu::always_inline]] inline HalfLog<T> half_log_parts(const T& a, const T& b) {
  const NearPower<T> nearest = near_power(a, b);
  return {a - nearest.near, a + nearest.near, nearest.power};
}

// For a caller who knows a - b = `excess` to more digits than a and b show.
template <class T>
[[gnu::always_inline]] inline HalfLog<T> half_log_parts(const T& a, const T& b, const T& excess) {
  const NearPower<T> nearest = near_power(a, b);
  return {excess + (b - nearest.near), a + nearest.near, nearest.power};
}

// The same for ratios that are near, in two thirds of the operations.
template <class T>
[[gnu::always_inline]] inline HalfLog<T> near_half_log_parts(const T& a, const T& b, const T& excess) {
  return {excess, a + b, spread<T>(0.0)};
}

template <class T>
[[gnu::always_inline]] inline T half_log(const T& a, const T& b) {
  const HalfLog<T> parts = half_log_parts(a, b);
  return parts.value(parts.numerator / parts.denominator);
}

}  // namespace weaveform
