// Numbers side by side as one value: the element bodies are written for a number type, and the inner loops take them with
// packs of the instruction set's own vectors, tests and what is computed one by one with double. A pack of several
// vectors works on independent numbers between each of its steps, where one alone would wait for the step before: element
// bodies are long chains.
//
// Packs are of double or of single precision. Memory holds what a run keeps in double precision always: a pack of single
// precision narrows what it loads, and differences of positions only after they were taken.
//
// Each compilation has packs of its own, named after the vectors' width. All of it is inlined: no pack passes from one
// compilation to another.
#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "solver/element/lane_count.hpp"

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

template <class Number, int width>
struct VectorOf {
  using Type __attribute__((vector_size(width * sizeof(Number)))) = Number;
};
using Vector = VectorOf<double, native_width>::Type;
using ShortVector = VectorOf<float, native_width>::Type;  // a vector's numbers in single precision: half of one
// The attribute stands beside the name: beside the type clang++ leaves the alignment as it is.
using AnyVector __attribute__((vector_size(native_width * sizeof(double)), aligned(sizeof(double)), may_alias)) =
    double;
using AnyShortVector __attribute__((vector_size(native_width * sizeof(float)), aligned(sizeof(float)), may_alias)) =
    float;
static_assert(alignof(AnyVector) == sizeof(double) && alignof(AnyShortVector) == sizeof(float));

// A vector of either precision: `halves` times as many numbers as one of double precision.
template <class Real>
struct Native;
template <>
struct Native<double> {
  static constexpr int halves = 1, width = native_width;
  using Whole = std::int64_t;
};
template <>
struct Native<float> {
  static constexpr int halves = 2, width = 2 * native_width;
  using Whole = std::int32_t;
};
template <class Real>
using NativeVector = typename VectorOf<Real, Native<Real>::width>::Type;
template <class Real>
using NativeBits = typename VectorOf<typename Native<Real>::Whole, Native<Real>::width>::Type;

template <int parts, class RealNumber = double>
struct Pack {
  using Real = RealNumber;
  static constexpr int width = parts * Native<Real>::width;
  NativeVector<Real> part[parts];
  Real operator[](int lane) const { return part[lane / Native<Real>::width][lane % Native<Real>::width]; }
};

// The least that loops take at once.
inline constexpr int parts_of_block = lane_count / native_width;
using Lanes = Pack<parts_of_block>;

// As many numbers as `halves` vectors of double precision have.
template <int halves, class Real>
using PackOf = Pack<halves / Native<Real>::halves, Real>;

template <class T>
struct RealOf {
  using Type = T;
};
template <int parts, class Real>
struct RealOf<Pack<parts, Real>> {
  using Type = Real;
};
// double or float: what T is of
template <class T>
using Real = typename RealOf<T>::Type;

// The same numbers in double precision.
template <class T>
struct WideOf {
  using Type = T;
};
template <int parts>
struct WideOf<Pack<parts, float>> {
  using Type = Pack<2 * parts>;
};
template <class T>
using Wide = typename WideOf<T>::Type;

// Of a pack's numbers; of a comparison's outcome all bits of a number or none.
template <int parts, class Real>
struct Bits {
  NativeBits<Real> part[parts];
};

#define WEAVEFORM_FOR_PARTS(statement)                      \
  _Pragma("GCC unroll 8") for (int i = 0; i < parts; ++i) { \
    statement;                                              \
  }

#define WEAVEFORM_PACK_OPERATOR(op)                                                                   \
  template <int parts, class Real>                                                                    \
  [[gnu::always_inline]] inline Pack<parts, Real> operator op(const Pack<parts, Real>& a,             \
                                                              const Pack<parts, Real>& b) {           \
    Pack<parts, Real> result;                                                                         \
    WEAVEFORM_FOR_PARTS(result.part[i] = a.part[i] op b.part[i])                                      \
    return result;                                                                                    \
  }                                                                                                   \
  template <int parts, class Real>                                                                    \
  [[gnu::always_inline]] inline Pack<parts, Real> operator op(const Pack<parts, Real>& a, double b) { \
    Pack<parts, Real> result;                                                                         \
    const auto number = static_cast<Real>(b);                                                         \
    WEAVEFORM_FOR_PARTS(result.part[i] = a.part[i] op number)                                         \
    return result;                                                                                    \
  }                                                                                                   \
  template <int parts, class Real>                                                                    \
  [[gnu::always_inline]] inline Pack<parts, Real> operator op(double a, const Pack<parts, Real>& b) { \
    Pack<parts, Real> result;                                                                         \
    const auto number = static_cast<Real>(a);                                                         \
    WEAVEFORM_FOR_PARTS(result.part[i] = number op b.part[i])                                         \
    return result;                                                                                    \
  }
WEAVEFORM_PACK_OPERATOR(+)
WEAVEFORM_PACK_OPERATOR(-)
WEAVEFORM_PACK_OPERATOR(*)
WEAVEFORM_PACK_OPERATOR(/)

template <int parts, class Real>
[[gnu::always_inline]] inline Pack<parts, Real>& operator+=(Pack<parts, Real>& a, const Pack<parts, Real>& b) {
  return a = a + b;
}

#define WEAVEFORM_PACK_COMPARISON(op)                                                       \
  template <int parts, class Real>                                                          \
  [[gnu::always_inline]] inline Bits<parts, Real> operator op(const Pack<parts, Real>& a,   \
                                                              const Pack<parts, Real>& b) { \
    Bits<parts, Real> result;                                                               \
    WEAVEFORM_FOR_PARTS(result.part[i] = a.part[i] op b.part[i])                            \
    return result;                                                                          \
  }
WEAVEFORM_PACK_COMPARISON(<)
WEAVEFORM_PACK_COMPARISON(>)
#undef WEAVEFORM_PACK_OPERATOR
#undef WEAVEFORM_PACK_COMPARISON

#define WEAVEFORM_BITS_OPERATOR(op)                                                             \
  template <int parts, class Real>                                                              \
  [[gnu::always_inline]] inline Bits<parts, Real> operator op(const Bits<parts, Real>& a,       \
                                                              const Bits<parts, Real>& b) {     \
    Bits<parts, Real> result;                                                                   \
    WEAVEFORM_FOR_PARTS(result.part[i] = a.part[i] op b.part[i])                                \
    return result;                                                                              \
  }                                                                                             \
  template <int parts, class Real>                                                              \
  [[gnu::always_inline]] inline Bits<parts, Real> operator op(const Bits<parts, Real>& a,       \
                                                              typename Native<Real>::Whole b) { \
    Bits<parts, Real> result;                                                                   \
    WEAVEFORM_FOR_PARTS(result.part[i] = a.part[i] op b)                                        \
    return result;                                                                              \
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
  if constexpr (std::is_same_v<T, double>) {
    return value;
  } else {
    T result;
    for (auto& part : result.part) part = NativeVector<Real<T>>{} + static_cast<Real<T>>(value);
    return result;
  }
}

[[gnu::always_inline]] inline double select(bool which, double a, double b) {
  return which ? a : b;
}
template <int parts, class Real>
[[gnu::always_inline]] inline Pack<parts, Real> select(const Bits<parts, Real>& which, const Pack<parts, Real>& a,
                                                       const Pack<parts, Real>& b) {
  Pack<parts, Real> result;
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
template <int parts, class Real>
[[gnu::always_inline]] inline Bits<parts, Real> bits_of(const Pack<parts, Real>& x) {
  Bits<parts, Real> result;
  WEAVEFORM_FOR_PARTS(result.part[i] = std::bit_cast<NativeBits<Real>>(x.part[i]))
  return result;
}
template <int parts, class Real>
[[gnu::always_inline]] inline Pack<parts, Real> number_of(const Bits<parts, Real>& bits) {
  Pack<parts, Real> result;
  WEAVEFORM_FOR_PARTS(result.part[i] = std::bit_cast<NativeVector<Real>>(bits.part[i]))
  return result;
}

// The least whole number of as many bits as T's numbers have: the sign's bit alone.
template <class T>
inline constexpr auto sign_bit = std::is_same_v<Real<T>, double> ? INT64_MIN : std::int64_t{INT32_MIN};
template <class T>
using WholeOf = typename Native<Real<T>>::Whole;

template <class T>
[[gnu::always_inline]] inline T magnitude(const T& x) {
  constexpr auto sign = static_cast<WholeOf<T>>(sign_bit<T>);
  return number_of(bits_of(x) & ~sign);
}
// `size` >= 0, with the sign of x.
template <class T>
[[gnu::always_inline]] inline T signed_like(const T& size, const T& x) {
  constexpr auto sign = static_cast<WholeOf<T>>(sign_bit<T>);
  return number_of(bits_of(size) | (bits_of(x) & sign));
}

// ---- from one precision to the other

template <std::size_t... lane>
[[gnu::always_inline]] inline NativeVector<float> join(const ShortVector& first, const ShortVector& second,
                                                       std::index_sequence<lane...> /*lanes*/) {
  return __builtin_shufflevector(first, second, lane...);
}
[[gnu::always_inline]] inline NativeVector<float> join(const ShortVector& first, const ShortVector& second) {
  return join(first, second, std::make_index_sequence<2 * native_width>());
}
template <int from, std::size_t... lane>
[[gnu::always_inline]] inline ShortVector half_of(const NativeVector<float>& whole,
                                                  std::index_sequence<lane...> /*lanes*/) {
  return __builtin_shufflevector(whole, whole, (from + lane)...);
}
template <int half>
[[gnu::always_inline]] inline ShortVector half_of(const NativeVector<float>& whole) {
  return half_of<half * native_width>(whole, std::make_index_sequence<native_width>());
}
[[gnu::always_inline]] inline ShortVector narrowed(const Vector& numbers) {
  return __builtin_convertvector(numbers, ShortVector);
}
[[gnu::always_inline]] inline Vector widened(const ShortVector& numbers) {
  return __builtin_convertvector(numbers, Vector);
}

// As T has them.
template <class T>
[[gnu::always_inline]] inline T narrow(const Wide<T>& numbers) {
  if constexpr (std::is_same_v<T, Wide<T>>) {
    return numbers;
  } else {
    T result;
    constexpr int parts = T::width / Native<float>::width;
    WEAVEFORM_FOR_PARTS(result.part[i] = join(narrowed(numbers.part[2 * i]), narrowed(numbers.part[2 * i + 1])))
    return result;
  }
}
template <class T>
[[gnu::always_inline]] inline Wide<T> widen(const T& numbers) {
  if constexpr (std::is_same_v<T, Wide<T>>) {
    return numbers;
  } else {
    Wide<T> result;
    constexpr int parts = T::width / Native<float>::width;
    WEAVEFORM_FOR_PARTS(result.part[2 * i] = widened(half_of<0>(numbers.part[i]));
                        result.part[2 * i + 1] = widened(half_of<1>(numbers.part[i])))
    return result;
  }
}

// ---- memory

// Where the numbers of a pack stand in an array: as many at index at[i] and after it as a vector of double precision has.
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
  static_assert(std::is_same_v<T, double>);
  return p[at];
}
template <class T, int parts>
[[gnu::always_inline]] inline T load(const double* p, const Place<parts>& place) {
  Wide<T> result;
  WEAVEFORM_FOR_PARTS(result.part[i] = *reinterpret_cast<const AnyVector*>(p + place.at[i]))
  return narrow<T>(result);
}

[[gnu::always_inline]] inline void store(double* p, int at, double value) {
  p[at] = value;
}
template <int parts>
[[gnu::always_inline]] inline void store(double* p, const Place<parts>& place, const Pack<parts>& value) {
  WEAVEFORM_FOR_PARTS(*reinterpret_cast<AnyVector*>(p + place.at[i]) = value.part[i])
}
template <int parts>
[[gnu::always_inline]] inline void store(float* p, const Place<parts>& place, const Pack<parts>& value) {
  WEAVEFORM_FOR_PARTS(*reinterpret_cast<AnyShortVector*>(p + place.at[i]) = narrowed(value.part[i]))
}
template <int parts>
[[gnu::always_inline]] inline void store(float* p, const Place<2 * parts>& place, const Pack<parts, float>& value) {
  WEAVEFORM_FOR_PARTS(*reinterpret_cast<AnyShortVector*>(p + place.at[2 * i]) = half_of<0>(value.part[i]);
                      *reinterpret_cast<AnyShortVector*>(p + place.at[2 * i + 1]) = half_of<1>(value.part[i]))
}

// to[at] - from[at], ...
template <class T, class P>
[[gnu::always_inline]] inline T difference(const double* to, const double* from, const P& place) {
  return narrow<T>(load<Wide<T>>(to, place) - load<Wide<T>>(from, place));
}

// at(0), at(1), ...
template <class At, std::size_t... lane>
[[gnu::always_inline]] inline Vector vector_of(const At& at, std::index_sequence<lane...> /*lanes*/) {
  return Vector{at(static_cast<int>(lane))...};
}
template <class T, int parts, class At>
[[gnu::always_inline]] inline T one_by_one(const Place<parts>& place, const At& at) {
  Wide<T> result;
  WEAVEFORM_FOR_PARTS(result.part[i] = vector_of([&](int lane) { return at(place.at[i] + lane); },
                                                 std::make_index_sequence<native_width>()))
  return narrow<T>(result);
}

// x[index[at * stride]], x[index[(at + 1) * stride]], ...
template <class T>
[[gnu::always_inline]] inline T gather(const double* x, const int* index, int at, int stride = 1) {
  static_assert(std::is_same_v<T, double>);
  return x[index[at * stride]];
}
template <class T, int parts>
[[gnu::always_inline]] inline T gather(const double* x, const int* index, const Place<parts>& place, int stride = 1) {
  return one_by_one<T>(place, [&](int at) { return x[index[at * stride]]; });
}

// p[at * stride], p[(at + 1) * stride], ...
template <class T>
[[gnu::always_inline]] inline T every(const double* p, int at, int stride) {
  static_assert(std::is_same_v<T, double>);
  return p[at * stride];
}
template <class T, int parts>
[[gnu::always_inline]] inline T every(const double* p, const Place<parts>& place, int stride) {
  return one_by_one<T>(place, [&](int at) { return p[at * stride]; });
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
