// Random numbers that depend on seed, stage, point and purpose only: any order of points, any machine, the same
// numbers.
#pragma once

#include <cstdint>

namespace weaveform::dic {

struct NoiseKey {
  std::uint64_t seed, stage, point;
};

[[nodiscard]] double uniform(const NoiseKey& key, std::uint64_t purpose);  // in (0, 1)
[[nodiscard]] double normal(const NoiseKey& key, std::uint64_t purpose);   // mean 0, standard deviation 1

}  // namespace weaveform::dic
