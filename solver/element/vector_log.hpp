// Natural logarithm that a compiler turns into vector instructions: no branch, no table, no relaxed floating point, the
// same bits in a vector lane as alone. Argument: positive, normal, finite. Error below 1 ulp. Method: x = 2^k z with z
// in [sqrt(1/2), sqrt 2); log z by the odd series in s = f/(2+f), f = z-1, with the minimax coefficients of FDLIBM (Sun
// Microsystems 1993, e_log.c).
#pragma once

#include <bit>
#include <cstdint>

namespace weaveform {

inline double vector_log(double x) {
  constexpr std::int64_t sqrt_half_bits = 0x3fe6a09e667f3bcd;
  constexpr std::int64_t exponent_mask = static_cast<std::int64_t>(0xfff0000000000000ULL);
  constexpr double ln2_high = 6.93147180369123816490e-01;
  constexpr double ln2_low = 1.90821492927058770002e-10;
  const auto bits = std::bit_cast<std::int64_t>(x);
  const std::int64_t offset = bits - sqrt_half_bits;
  const double z = std::bit_cast<double>(bits - (offset & exponent_mask));
  // The exponent as a double without an integer conversion: place it in the mantissa of 1.5 * 2^52.
  const double k = std::bit_cast<double>((offset >> 52) + 0x4338000000000000) - 6755399441055744.0;
  const double f = z - 1.0;
  const double s = f / (2.0 + f);
  const double s2 = s * s;
  const double series =
      s2 * (6.666666666666735130e-01 +
            s2 * (3.999999999940941908e-01 +
                  s2 * (2.857142874366239149e-01 +
                        s2 * (2.222219843214978396e-01 +
                              s2 * (1.818357216161805012e-01 +
                                    s2 * (1.531383769920937332e-01 + s2 * 1.479819860511658591e-01))))));
  const double half_square = 0.5 * f * f;
  return k * ln2_high + (f - (half_square - (s * (half_square + series) + k * ln2_low)));
}

}  // namespace weaveform
