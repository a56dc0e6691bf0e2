// A number that counts what is done to it: the element bodies are templates over their number type, and so they say
// themselves what a cell-step costs.
#pragma once

#include "solver/element/lanes.hpp"

namespace weaveform {

struct Operations {
  double sums = 0.0, products = 0.0, divisions = 0.0, choices = 0.0;  // choices: comparisons with what they select
};

struct Counted {
  double value = 0.0;
  Counted() = default;
  Counted(double number) : value(number) {}  // NOLINT(google-explicit-constructor): constants of formulas

  static Operations& done() {
    static Operations operations;
    return operations;
  }
  friend Counted operator+(const Counted& a, const Counted& b) {
    ++done().sums;
    return a.value + b.value;
  }
  friend Counted operator-(const Counted& a, const Counted& b) {
    ++done().sums;
    return a.value - b.value;
  }
  friend Counted operator*(const Counted& a, const Counted& b) {
    ++done().products;
    return a.value * b.value;
  }
  friend Counted operator/(const Counted& a, const Counted& b) {
    ++done().divisions;
    return a.value / b.value;
  }
  friend bool operator<(const Counted& a, const Counted& b) { return a.value < b.value; }
  friend bool operator>(const Counted& a, const Counted& b) { return a.value > b.value; }
  Counted& operator+=(const Counted& other) { return *this = *this + other; }
};

template <>
struct RealOf<Counted> {
  using Type = double;
};

// What element bodies ask of a number type beside its operators (lanes.hpp, inverse_root.hpp).
template <>
inline Counted spread<Counted>(double value) {
  return value;
}
inline Counted select(bool which, const Counted& a, const Counted& b) {
  ++Counted::done().choices;
  return which ? a : b;
}
inline std::int64_t bits_of(const Counted& x) {
  return bits_of(x.value);
}
// Two steps of Newton's method, in single precision.
inline Counted estimate_inverse_root(const Counted& x) {
  Counted::done().products += 8.0;
  Counted::done().sums += 2.0;
  return 1.0 / __builtin_sqrt(x.value);
}

}  // namespace weaveform
