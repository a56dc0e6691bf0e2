#include "core/instructions/instructions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/instructions/processor.hpp"

namespace weaveform {
namespace {

constexpr const char* variable = "WEAVEFORM_INSTRUCTIONS";
constexpr const char* build_all = "build them all: `./dev build`, or cmake -DWEAVEFORM_INSTRUCTION_SETS=all build";

struct Named {
  Instructions set;
  std::string_view name;
};
constexpr std::array<Named, 3> names = {
    {{Instructions::sse2, "sse2"}, {Instructions::avx2, "avx2"}, {Instructions::avx512, "avx512"}}};

constexpr std::array built_sets = {
#ifdef WEAVEFORM_HAS_SSE2
    Instructions::sse2,
#endif
#ifdef WEAVEFORM_HAS_AVX2
    Instructions::avx2,
#endif
#ifdef WEAVEFORM_HAS_AVX512
    Instructions::avx512,
#endif
#ifdef WEAVEFORM_HAS_ONLY
    Instructions::only,
#endif
};

std::string_view name_of(Instructions set) {
  for (const Named& named : names)
    if (named.set == set) return named.name;
  return WEAVEFORM_ONLY_SET;
}

std::string names_of(std::span<const Instructions> sets) {
  std::vector<std::string_view> listed;
  for (const Instructions set : sets) listed.push_back(name_of(set));
  return fmt::format("{}", fmt::join(listed, ", "));
}

Instructions widest_of(std::span<const Instructions> built, Instructions widest) {
  for (auto set = built.rbegin(); set != built.rend(); ++set)
    if (*set <= widest) return *set;
  throw InputError(fmt::format("this program was built for {} alone, and this processor's widest set is {}; {}",
                               names_of(built), name_of(widest), build_all));
}

}  // namespace

Instructions choose_instructions(const char* asked, Instructions widest, std::span<const Instructions> built) {
  const bool one_for_all = built.front() == Instructions::only;
  if (asked == nullptr || *asked == '\0') return one_for_all ? Instructions::only : widest_of(built, widest);
  for (const Named& named : names) {
    if (named.name != asked) continue;
    if (one_for_all)
      throw InputError(fmt::format("{}={}: this build has one instruction set alone, {}; unset the variable", variable,
                                   asked, name_of(Instructions::only)));
    if (named.set > widest)
      throw InputError(fmt::format("{}={}: this processor has no {}, its widest set is {}", variable, asked, asked,
                                   name_of(widest)));
    if (std::find(built.begin(), built.end(), named.set) == built.end())
      throw InputError(fmt::format("{}={}: this program was built for {} alone; unset the variable, or {}", variable,
                                   asked, names_of(built), build_all));
    return named.set;
  }
  throw InputError(fmt::format("{}={}: no such instruction set; known are sse2, avx2, avx512", variable, asked));
}

Instructions instructions() {
  static const Instructions chosen = choose_instructions(std::getenv(variable), widest_of_processor(), built_sets);
  return chosen;
}

std::string instructions_name() {
  return std::string(name_of(instructions()));
}

}  // namespace weaveform
