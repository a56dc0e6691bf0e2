// How a file of inner loops, compiled once for each instruction set, is called. Each compilation defines one table of
// function pointers in a namespace named after its set, and nothing else that other files can see; below the table's
// type, in a file compiled like all others, stands
//
//   WEAVEFORM_CHOOSE_LOOPS(ElementLoops, loops_of_elements)
//
// which defines `const ElementLoops& chosen_loops_of_elements()`. For use inside namespace weaveform.
#pragma once

#include <array>

#include "core/instructions/instructions.hpp"

// The table of a set that the build does not have is null; instructions() never names such a set.
#define WEAVEFORM_DECLARE_IN(set, Table, table) \
  namespace set {                               \
  extern const Table table;                     \
  }
#ifdef WEAVEFORM_HAS_SSE2
#define WEAVEFORM_DECLARE_SSE2(Table, table) WEAVEFORM_DECLARE_IN(sse2, Table, table)
#define WEAVEFORM_TABLE_SSE2(table) &sse2::table
#else
#define WEAVEFORM_DECLARE_SSE2(Table, table)
#define WEAVEFORM_TABLE_SSE2(table) nullptr
#endif
#ifdef WEAVEFORM_HAS_AVX2
#define WEAVEFORM_DECLARE_AVX2(Table, table) WEAVEFORM_DECLARE_IN(avx2, Table, table)
#define WEAVEFORM_TABLE_AVX2(table) &avx2::table
#else
#define WEAVEFORM_DECLARE_AVX2(Table, table)
#define WEAVEFORM_TABLE_AVX2(table) nullptr
#endif
#ifdef WEAVEFORM_HAS_AVX512
#define WEAVEFORM_DECLARE_AVX512(Table, table) WEAVEFORM_DECLARE_IN(avx512, Table, table)
#define WEAVEFORM_TABLE_AVX512(table) &avx512::table
#else
#define WEAVEFORM_DECLARE_AVX512(Table, table)
#define WEAVEFORM_TABLE_AVX512(table) nullptr
#endif
#ifdef WEAVEFORM_HAS_ONLY
#define WEAVEFORM_DECLARE_ONLY(Table, table) WEAVEFORM_DECLARE_IN(only, Table, table)
#define WEAVEFORM_TABLE_ONLY(table) &only::table
#else
#define WEAVEFORM_DECLARE_ONLY(Table, table)
#define WEAVEFORM_TABLE_ONLY(table) nullptr
#endif

#define WEAVEFORM_CHOOSE_LOOPS(Table, table)                                                     \
  WEAVEFORM_DECLARE_SSE2(Table, table)                                                           \
  WEAVEFORM_DECLARE_AVX2(Table, table)                                                           \
  WEAVEFORM_DECLARE_AVX512(Table, table)                                                         \
  WEAVEFORM_DECLARE_ONLY(Table, table)                                                           \
  namespace {                                                                                    \
  const Table& chosen_##table() {                                                                \
    static const Table& chosen = *std::array<const Table*, 4>{                                   \
        WEAVEFORM_TABLE_SSE2(table), WEAVEFORM_TABLE_AVX2(table), WEAVEFORM_TABLE_AVX512(table), \
        WEAVEFORM_TABLE_ONLY(table)}[static_cast<int>(instructions())];                          \
    return chosen;                                                                               \
  }                                                                                              \
  }
