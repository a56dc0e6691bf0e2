// How a file of inner loops, compiled once for each instruction set, is called. Each compilation defines one table of
// function pointers in a namespace named after its set, and nothing else that other files can see; below the table's
// type, in a file compiled like all others, stands
//
//   WEAVEFORM_CHOOSE_LOOPS(ElementLoops, loops_of_elements)
//
// which defines `const ElementLoops& chosen_loops_of_elements()`. For use inside namespace weaveform.
#pragma once

#include "core/instructions/instructions.hpp"

#ifdef WEAVEFORM_SEVERAL_SETS
#define WEAVEFORM_CHOOSE_LOOPS(Table, table)                                            \
  namespace sse2 {                                                                      \
  extern const Table table;                                                             \
  }                                                                                     \
  namespace avx2 {                                                                      \
  extern const Table table;                                                             \
  }                                                                                     \
  namespace avx512 {                                                                    \
  extern const Table table;                                                             \
  }                                                                                     \
  namespace {                                                                           \
  const Table& chosen_##table() {                                                       \
    static const Table& chosen = instructions() == Instructions::avx512 ? avx512::table \
                                 : instructions() == Instructions::avx2 ? avx2::table   \
                                                                        : sse2::table;  \
    return chosen;                                                                      \
  }                                                                                     \
  }
#else
#define WEAVEFORM_CHOOSE_LOOPS(Table, table) \
  namespace only {                           \
  extern const Table table;                  \
  }                                          \
  namespace {                                \
  const Table& chosen_##table() {            \
    return only::table;                      \
  }                                          \
  }
#endif
