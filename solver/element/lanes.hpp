// Numbers side by side as one value: the element bodies are written for a number type, and the inner loops take them with
// packs of the instruction set's own vectors, tests and what is computed one by one with double. A pack of several
// vectors works on independent numbers between each of its steps, where one alone would wait for the step before: element
// bodies are long chains.
//
// Each compilation has packs of its own, named after the vectors' width. All of it is inlined: no pack passes from one
// compilation to another.
#pragma once

#include <bit>
#include <cstdint>

#pragma GCC diagnostic ignored "-Wpsabi"  // says how packs pass between compilations, which they do not

namespace weaveform {

#if defined(__AVX512F__)
inline namespace vectors_of_eight {
inline constexpr int native_width = 8;
#elif defined(__AVX2__)
inline namespace vectors_of_four {
inline constexpr int native_width = 4;
#else
inline namespace vectors_of_two {
inline constexpr int native_width = 2;
#endif

using Vector = double __attribute__((vector_size(native_width * sizeof(double))));
using VectorBits = std::int64_t __attribute__((vector_size(native_width * sizeof(double))));
using ShortVector = float __attribute__((vector_size(native_width * sizeof(float))));
using ShortVectorBits = std::int32_t __attribute__((vector_size(native_width * sizeof(float))));
using AnyVector =
    double __attribute__((vector_size(native_width * sizeof(double)), aligned(sizeof(double)), may_alias));

template <int parts>
struct Pack {
  static constexpr int width = parts * native_width;
  Vector part[parts];
  double operator[](int lane) const { return part[lane / native_width][lane % native_width]; }
};

// Eight numbers, the least that loops take at once.
inline constexpr int lane_count = 8;
inline constexpr int parts_of_block = lane_count / native_width;
using Lanes = Pack<parts_of_block>;

// Of a pack's numbers; of a comparison's outcome all bits of a number or none.
template <int parts>
struct Bits {
  VectorBits part[parts];
};

#define WEAVEFORM_FOR_PARTS(statement)                      \
  _Pragma("GCC unroll 8") for (int i = 0; i < parts; ++i) { \
    statement;                                              \
  }

#define WEAVEFORM_PACK_OPERATOR(op)                                                                   \
  template <int parts>                                                                                \
  [[gnu::always_inline]] inline Pack<parts> operator op(const Pack<parts>& a, const Pack<parts>& b) { \
    Pack<parts> result;                                                                               \
    WEAVEFORM_FOR_PARTS(result.part[i] = a.part[i] op b.part[i])                                      \
    return result;                                                                                    \
  }                                                                                                   \
  template <int parts>                                                                                \
  [[gnu::always_inline]] inline Pack<parts> operator op(const Pack<parts>& a, double b) {             \
    Pack<parts> result;                                                                               \
    WEAVEFORM_FOR_PARTS(result.part[i] = a.part[i] op b)                                              \
    return result;                                                                                    \
  }                                                                                                   \
  template <int parts>                                                                                \
  [[gnu::always_inline]] inline Pack<parts> operator op(double a, const Pack<parts>& b) {             \
    Pack<parts> result;                                                                               \
    WEAVEFORM_FOR_PARTS(result.part[i] = a op b.part[i])                                              \
    return result;                                                                                    \
  }
WEAVEFORM_PACK_OPERATOR(+)
WEAVEFORM_PACK_OPERATOR(-)
WEAVEFORM_PACK_OPERATOR(*)
WEAVEFORM_PACK_OPERATOR(/)

template <int parts>
[[gnu::always_inline]] inline Pack<parts>& operator+=(Pack<parts>& a, const Pack<parts>& b) {
  return a = a + b;
}

#define WEAVEFORM_PACK_COMPARISON(op)                                                                 \
  template <int parts>                                                                                \
  [[gnu::always_inline]] inline Bits<parts> operator op(const Pack<parts>& a, const Pack<parts>& b) { \
    Bits<parts> result;                                                                               \
    WEAVEFORM_FOR_PARTS(result.part[i] = a.part[i] op b.part[i])                                      \
    return result;                                                                                    \
  }
WEAVEFORM_PACK_COMPARISON(<)
WEAVEFORM_PACK_COMPARISON(>)
#undef WEAVEFORM_PACK_OPERATOR
#undef WEAVEFORM_PACK_COMPARISON

#define WEAVEFORM_BITS_OPERATOR(op)                                                                   \
  template <int parts>                                                                                \
  [[gnu::always_inline]] inline Bits<parts> operator op(const Bits<parts>& a, const Bits<parts>& b) { \
    Bits<parts> result;                                                                               \
    WEAVEFORM_FOR_PARTS(result.part[i] = a.part[i] op b.part[i])                                      \
    return result;                                                                                    \
  }                                                                                                   \
  template <int parts>                                                                                \
  [[gnu::always_inline]] inline Bits<parts> operator op(const Bits<parts>& a, std::int64_t b) {       \
    Bits<parts> result;                                                                               \
    WEAVEFORM_FOR_PARTS(result.part[i] = a.part[i] op b)                                              \
    return result;                                                                                    \
  }
WEAVEFORM_BITS_OPERATOR(+)
WEAVEFORM_BITS_OPERATOR(-)
WEAVEFORM_BITS_OPERATOR(&)
WEAVEFORM_BITS_OPERATOR(|)
WEAVEFORM_BITS_OPERATOR(>>)
#undef WEAVEFORM_BITS_OPERATOR

// The same number everywhere.
template <class T>
[[gnu::always_inline]] inline T spread(double value) {
  if constexpr (sizeof(T) == sizeof(double)) {
    return value;
  } else {
    T result;
    for (auto& part : result.part) part = Vector{} + value;
    return result;
  }
}

[[gnu::always_inline]] inline double select(bool which, double a, double b) {
  return which ? a : b;
}
template <int parts>
[[gnu::always_inline]] inline Pack<parts> select(const Bits<parts>& which, const Pack<parts>& a, const Pack<parts>& b) {
  Pack<parts> result;
  WEAVEFORM_FOR_PARTS(result.part[i] = which.part[i] ? a.part[i] : b.part[i])
  return result;
}

template <class T>
[[gnu::always_inline]] inline T lesser(const T& a, const T& b) {
  return select(a < b, a, b);
}
template <class T>
[[gnu::always_inline]] inline T greater(const T& a, const T& b) {
  return select(a > b, a, b);
}
template <class T>
[[gnu::always_inline]] inline T at_least(const T& a, double bound) {
  return greater(a, spread<T>(bound));
}
template <class T>
[[gnu::always_inline]] inline T at_most(const T& a, double bound) {
  return lesser(a, spread<T>(bound));
}

[[gnu::always_inline]] inline std::int64_t bits_of(double x) {
  return std::bit_cast<std::int64_t>(x);
}
[[gnu::always_inline]] inline double number_of(std::int64_t bits) {
  return std::bit_cast<double>(bits);
}
template <int parts>
[[gnu::always_inline]] inline Bits<parts> bits_of(const Pack<parts>& x) {
  Bits<parts> result;
  WEAVEFORM_FOR_PARTS(result.part[i] = std::bit_cast<VectorBits>(x.part[i]))
  return result;
}
template <int parts>
[[gnu::always_inline]] inline Pack<parts> number_of(const Bits<parts>& bits) {
  Pack<parts> result;
  WEAVEFORM_FOR_PARTS(result.part[i] = std::bit_cast<Vector>(bits.part[i]))
  return result;
}

inline constexpr std::int64_t sign_bit = INT64_MIN;
template <class T>
[[gnu::always_inline]] inline T magnitude(const T& x) {
  return number_of(bits_of(x) & ~sign_bit);
}
// `size` >= 0, with the sign of x.
template <class T>
[[gnu::always_inline]] inline T signed_like(const T& size, const T& x) {
  return number_of(bits_of(size) | (bits_of(x) & sign_bit));
}

// Where the parts of a pack stand in an array: part i at index at[i] and after it.
template <int parts>
struct Place {
  int at[parts];
};

template <int parts>
[[gnu::always_inline]] inline Place<parts> moved(const Place<parts>& place, int way) {
  Place<parts> result;
#pragma GCC unroll 8
  for (int i = 0; i < parts; ++i) result.at[i] = place.at[i] + way;
  return result;
}

template <class T>
[[gnu::always_inline]] inline T load(const double* p, int at) {
  static_assert(sizeof(T) == sizeof(double));
  return p[at];
}
template <class T, int parts>
[[gnu::always_inline]] inline T load(const double* p, const Place<parts>& place) {
  T result;
  WEAVEFORM_FOR_PARTS(result.part[i] = *reinterpret_cast<const AnyVector*>(p + place.at[i]))
  return result;
}

[[gnu::always_inline]] inline void store(double* p, int at, double value) {
  p[at] = value;
}
template <int parts>
[[gnu::always_inline]] inline void store(double* p, const Place<parts>& place, const Pack<parts>& value) {
  WEAVEFORM_FOR_PARTS(*reinterpret_cast<AnyVector*>(p + place.at[i]) = value.part[i])
}

// x[index[at * stride]], x[index[(at + 1) * stride]], ...
template <class T>
[[gnu::always_inline]] inline T gather(const double* x, const int* index, int at, int stride = 1) {
  static_assert(sizeof(T) == sizeof(double));
  return x[index[at * stride]];
}
template <class T, int parts>
[[gnu::always_inline]] inline T gather(const double* x, const int* index, const Place<parts>& place, int stride = 1) {
  T result;
  WEAVEFORM_FOR_PARTS(_Pragma("GCC unroll 8") for (int l = 0; l < native_width; ++l) result.part[i][l] =
                          x[index[(place.at[i] + l) * stride]])
  return result;
}

// p[at * stride], p[(at + 1) * stride], ...
template <class T>
[[gnu::always_inline]] inline T every(const double* p, int at, int stride) {
  static_assert(sizeof(T) == sizeof(double));
  return p[at * stride];
}
template <class T, int parts>
[[gnu::always_inline]] inline T every(const double* p, const Place<parts>& place, int stride) {
  T result;
  WEAVEFORM_FOR_PARTS(_Pragma("GCC unroll 8") for (int l = 0; l < native_width; ++l) result.part[i][l] =
                          p[(place.at[i] + l) * stride])
  return result;
}

// A block at index n.
[[gnu::always_inline]] inline Place<parts_of_block> block_at(int n) {
  Place<parts_of_block> place;
#pragma GCC unroll 8
  for (int i = 0; i < parts_of_block; ++i) place.at[i] = n + i * native_width;
  return place;
}
[[gnu::always_inline]] inline Lanes load_lanes(const double* p) {
  return load<Lanes>(p, block_at(0));
}
[[gnu::always_inline]] inline void store_lanes(double* p, const Lanes& value) {
  store(p, block_at(0), value);
}

}  // inline namespace
}  // namespace weaveform
