// Which of the machine's instruction sets the inner loops run with. Their files are compiled once for each set
// (cmake/inner_loop.cmake), one of which is chosen when the program first asks; all else runs on any processor of the
// architecture. On another architecture than x86-64, and in a native build, there is one compilation: `only`. A build may
// also have those of its machine alone (WEAVEFORM_INSTRUCTION_SETS=widest), which is sooner done.
//
// Results differ in the last bits from set to set: sse2 rounds after each product, the others fuse products with sums,
// and wider vectors add up energies and tool forces in another order. With one set they are the same bits anywhere.
#pragma once

#include <span>
#include <string>

namespace weaveform {

enum class Instructions { sse2, avx2, avx512, only };

// The widest set that both this processor and this build have, or the one named by the environment variable
// WEAVEFORM_INSTRUCTIONS (sse2, avx2, avx512). The same answer for as long as the program runs. Throws InputError for any
// other name, for a set that this processor or this build does not have, and where they have none in common.
[[nodiscard]] Instructions instructions();

// As the variable has it; of `only`, what the build was made for.
[[nodiscard]] std::string instructions_name();

// `asked` by its name, null or empty when nothing is: the widest of `built`, narrowest first, up to the processor's
// `widest`. Throws as instructions() does.
[[nodiscard]] Instructions choose_instructions(const char* asked, Instructions widest,
                                               std::span<const Instructions> built);

}  // namespace weaveform
