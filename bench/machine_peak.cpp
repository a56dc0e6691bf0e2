// Compiled for the machine it runs on (bench/CMakeLists.txt).
#include "bench/machine_peak.hpp"

#include <chrono>
#include <vector>

#include "solver/element/lanes.hpp"

namespace weaveform {
namespace {

constexpr int chains = 12;  // that do not wait for each other: more than any unit's latency needs, all in registers
constexpr int repeats = 256;

// Calls work() until the time is up; returns how often a second.
template <class Work>
double calls_per_second(double seconds, const Work& work) {
  using Clock = std::chrono::steady_clock;
  long calls = 0;
  double passed = 0.0;
  for (const auto begin = Clock::now(); passed < seconds;
       passed = std::chrono::duration<double>(Clock::now() - begin).count())
    for (int k = 0; k < 16; ++k, ++calls) work();
  return static_cast<double>(calls) / passed;
}

// Numbers a second that `step` makes of numbers, G.
template <class Step>
double rate_of(double seconds, const Step& step) {
  Vector kept[chains];
  for (Vector& one : kept) one = Vector{} + 1.1;
  const double rate = calls_per_second(seconds, [&] {
    Vector x[chains];
#pragma GCC unroll 16
    for (int c = 0; c < chains; ++c) x[c] = kept[c];
    for (int k = 0; k < repeats; ++k)
#pragma GCC unroll 16
      for (int c = 0; c < chains; ++c) x[c] = step(x[c]);
#pragma GCC unroll 16
    for (int c = 0; c < chains; ++c) kept[c] = x[c];
    asm volatile("" : : "g"(&kept) : "memory");  // nothing of it may be left out as unused
  });
  return 1e-9 * rate * repeats * chains * native_width;
}

}  // namespace

double arithmetic_rate(double seconds) {
  return 2.0 * rate_of(seconds, [](const Vector& x) { return (x + 1e-4) * 0.9999; });
}

double division_rate(double seconds) {
  return rate_of(seconds, [](const Vector& x) { return 1.21 / x; });
}

double memory_rate(long doubles, double seconds) {
  std::vector<double> x(doubles, 1.0), v(doubles, 1e-9);
  double* position = x.data();
  const double* velocity = v.data();
  const double rate = calls_per_second(seconds, [&] {
#pragma omp simd
    for (long n = 0; n < doubles; ++n) position[n] += 1e-7 * velocity[n];
    asm volatile("" : : "g"(position) : "memory");
  });
  return 1e-9 * rate * static_cast<double>(doubles) * 3 * sizeof(double);
}

}  // namespace weaveform
