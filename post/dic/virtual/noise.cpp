#include "post/dic/virtual/noise.hpp"

#include <cmath>
#include <numbers>

namespace weaveform::dic {
namespace {

// Finaliser of splitmix64 (Steele, Lea & Flood 2014): every bit of the result depends on every bit of x.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

}  // namespace

double uniform(const NoiseKey& key, std::uint64_t purpose) {
  const std::uint64_t bits = mixed(mixed(mixed(mixed(key.seed) ^ key.stage) ^ key.point) ^ purpose);
  return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
}

double normal(const NoiseKey& key, std::uint64_t purpose) {
  // Box & Muller 1958
  const double radius = std::sqrt(-2.0 * std::log(uniform(key, 2 * purpose + 1000)));
  return radius * std::cos(2.0 * std::numbers::pi * uniform(key, 2 * purpose + 1001));
}

}  // namespace weaveform::dic
