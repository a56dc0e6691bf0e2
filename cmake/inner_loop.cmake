# The inner loops alone are told that no one reads errno or floating-point traps, without which neither compiler
# vectorises square roots and selections. Nothing else is relaxed: NaN and the order of sums stay as written.
#
# On x86-64 each of their files is compiled three times, into a namespace named by WEAVEFORM_SET, and one of the three is
# chosen when the program runs (core/instructions): for every processor of the architecture, for those with AVX2 (2013)
# and for those with AVX-512. What is listed here is what core/instructions/instructions.cpp asks the processor for. The
# rest of the program runs anywhere. Elsewhere, and with WEAVEFORM_NATIVE, they are compiled once; and of the three only
# this machine's widest with WEAVEFORM_INSTRUCTION_SETS=widest, which takes a minute less of a processor's time and gives
# the same loops here (`./dev run` in a new tree).
set(WEAVEFORM_INSTRUCTION_SETS all CACHE STRING "Instruction sets of the inner loops: all, or widest, this machine's alone")
set(inner_loop_flags -O3 -fno-math-errno -fno-trapping-math -fopenmp-simd)
if(WEAVEFORM_INSTRUMENTED)
  list(APPEND inner_loop_flags -O1)  # what sanitizers add to unrolled loops takes minutes to compile
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
  # clang 14 leaves the gathering loops over the outline's few loose elements scalar; that is slower, not wrong
  list(APPEND inner_loop_flags -Wno-pass-failed)
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND NOT WEAVEFORM_NATIVE)
  set(WEAVEFORM_SETS sse2 avx2 avx512)
  set(avx2_flags -mavx2 -mfma -mbmi -mbmi2)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # one load a lane: gathers are slow on AMD and, since Downfall (2023), on Intel; stacks of plies take 5 to 8 % less
    set(no_gathers -mtune-ctrl=^use_gather_2parts,^use_gather_4parts,^use_gather)
  endif()
  set(inner_loop_sse2)
  set(inner_loop_avx2 ${avx2_flags} -mtune=haswell ${no_gathers})
  set(inner_loop_avx512 ${avx2_flags} -mavx512f -mavx512cd -mavx512bw -mavx512dq -mavx512vl
    -mtune=icelake-server -mprefer-vector-width=512 ${no_gathers})
  if(WEAVEFORM_INSTRUCTION_SETS STREQUAL widest)
    try_run(WEAVEFORM_WIDEST_SET compiled ${CMAKE_BINARY_DIR}/widest_set ${CMAKE_CURRENT_LIST_DIR}/widest_set.cpp
      CMAKE_FLAGS -DINCLUDE_DIRECTORIES=${PROJECT_SOURCE_DIR} CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON)
    list(GET WEAVEFORM_SETS ${WEAVEFORM_WIDEST_SET} WEAVEFORM_SETS)
  elseif(NOT WEAVEFORM_INSTRUCTION_SETS STREQUAL all)
    message(FATAL_ERROR "WEAVEFORM_INSTRUCTION_SETS=${WEAVEFORM_INSTRUCTION_SETS}: is all or widest")
  endif()
else()
  set(WEAVEFORM_SETS only)
  set(inner_loop_only)
  if(WEAVEFORM_NATIVE)
    set(inner_loop_only -march=native -mprefer-vector-width=512)
  endif()
endif()
string(TOUPPER "${WEAVEFORM_SETS}" WEAVEFORM_SETS_DEFINITIONS)
list(TRANSFORM WEAVEFORM_SETS_DEFINITIONS PREPEND WEAVEFORM_HAS_)
if(WEAVEFORM_NATIVE)
  set(WEAVEFORM_ONLY_SET "native")
else()
  set(WEAVEFORM_ONLY_SET "${CMAKE_SYSTEM_PROCESSOR}")
endif()

# weaveform_inner_loop(TARGET LOOPS... CHOOSE FILES...): compiles LOOPS for each set, and FILES (once, for every
# processor), which know between which sets to choose. A compilation that leaves code which the linker may take for other
# files' too, as inline functions are, is refused: the others would then run it on processors that cannot.
function(weaveform_inner_loop target)
  cmake_parse_arguments(PARSE_ARGV 1 inner "" "" "LOOPS;CHOOSE")
  set_property(SOURCE ${inner_CHOOSE} APPEND PROPERTY COMPILE_DEFINITIONS ${WEAVEFORM_SETS_DEFINITIONS})
  target_sources(${target} PRIVATE ${inner_CHOOSE})
  foreach(set IN LISTS WEAVEFORM_SETS)
    set(loops ${target}_${set})
    add_library(${loops} OBJECT ${inner_LOOPS})
    target_link_libraries(${loops} PRIVATE weaveform_options weaveform_warnings)
    target_compile_definitions(${loops} PRIVATE WEAVEFORM_SET=${set})
    target_compile_options(${loops} PRIVATE ${inner_loop_flags} ${inner_loop_${set}})
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${loops}>)
    if(NOT set STREQUAL only AND NOT WEAVEFORM_INSTRUMENTED)
      # at linking: an output of its own would be waited for by all that is compiled for those who link it
      add_custom_command(TARGET ${target} PRE_LINK
        COMMAND ${CMAKE_COMMAND} -DNM=${CMAKE_NM} "-DOBJECTS=$<TARGET_OBJECTS:${loops}>"
          -P ${PROJECT_SOURCE_DIR}/cmake/own_code.cmake
        COMMENT "" VERBATIM)
    endif()
  endforeach()
endfunction()
