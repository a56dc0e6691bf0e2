// The widest of the instruction sets of core/instructions that this processor has. In a header of its own, for it is also
// compiled by itself where a build is made for one machine (cmake/inner_loop.cmake).
#pragma once

#include "core/instructions/instructions.hpp"

namespace weaveform {

// What cmake/inner_loop.cmake compiles each set for, and no more.
[[nodiscard]] inline Instructions widest_of_processor() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
                    __builtin_cpu_supports("bmi2");
  if (!avx2) return Instructions::sse2;
  const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
                      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vl");
  return avx512 ? Instructions::avx512 : Instructions::avx2;
#else
  return Instructions::only;
#endif
}

}  // namespace weaveform
