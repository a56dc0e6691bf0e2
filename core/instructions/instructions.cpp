#include "core/instructions/instructions.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <string_view>

#include "core/error.hpp"

namespace weaveform {
namespace {

constexpr const char* variable = "WEAVEFORM_INSTRUCTIONS";

struct Named {
  Instructions set;
  std::string_view name;
};
constexpr std::array<Named, 3> names = {
    {{Instructions::sse2, "sse2"}, {Instructions::avx2, "avx2"}, {Instructions::avx512, "avx512"}}};

std::string_view name_of(Instructions set) {
  for (const Named& named : names)
    if (named.set == set) return named.name;
  return WEAVEFORM_ONLY_SET;
}

// What cmake/inner_loop.cmake compiles each set for, and no more.
Instructions widest() {
#ifdef WEAVEFORM_SEVERAL_SETS
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

}  // namespace

Instructions choose_instructions(const char* asked, Instructions best) {
  if (asked == nullptr || *asked == '\0') return best;
  for (const Named& named : names) {
    if (named.name != asked) continue;
    if (best == Instructions::only)
      throw InputError(fmt::format("{}={}: this build has one instruction set alone, {}; unset the variable", variable,
                                   asked, name_of(best)));
    if (named.set > best)
      throw InputError(
          fmt::format("{}={}: this processor has no {}, its widest set is {}", variable, asked, asked, name_of(best)));
    return named.set;
  }
  throw InputError(fmt::format("{}={}: no such instruction set; known are sse2, avx2, avx512", variable, asked));
}

Instructions instructions() {
  static const Instructions chosen = choose_instructions(std::getenv(variable), widest());
  return chosen;
}

std::string instructions_name() {
  return std::string(name_of(instructions()));
}

}  // namespace weaveform
