# What every target shares: include root, no contraction of a*b+c behind our back (same bits from every compiler pass).
add_library(weaveform_options INTERFACE)
target_include_directories(weaveform_options INTERFACE ${PROJECT_SOURCE_DIR})
if(WEAVEFORM_SANITIZE)
  target_compile_options(weaveform_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(weaveform_options INTERFACE -fsanitize=address,undefined)
endif()
if(WEAVEFORM_FUZZ)
  target_compile_options(weaveform_options INTERFACE -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(weaveform_options INTERFACE -fsanitize=address,undefined)
endif()
# A program's templates are its own. Libraries that use the same ones (Gmsh has Eigen in it) would otherwise be bound to
# those of the program, which are compiled with other options: with the address sanitizer, or for a machine with wider
# vectors, Eigen then frees what it did not allocate. Not with clang's sanitizers, which must be seen by the libraries.
if(NOT WEAVEFORM_FUZZ)
  target_link_options(weaveform_options INTERFACE
    $<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:-Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/own_symbols.map>)
endif()
if(WEAVEFORM_COVERAGE)
  target_compile_options(weaveform_options INTERFACE --coverage)
  target_link_options(weaveform_options INTERFACE --coverage)
endif()

# Commands: argument parsers that run once, and take longer to optimise than to compile. Nothing is lost, for what they
# call is compiled with the libraries.
add_library(weaveform_runs_once INTERFACE)
target_compile_options(weaveform_runs_once INTERFACE $<$<CONFIG:Release>:-O1>)

# The inner loops alone are compiled for this machine, and told that no one reads errno or floating-point traps, without
# which neither compiler vectorises square roots and selections. Nothing else is relaxed: NaN and the order of sums stay as
# written. Called in the folder whose target has the files.
function(weaveform_inner_loop)
  set(options -O3 -fno-math-errno -fno-trapping-math -fopenmp-simd)
  if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
    # clang 14 leaves the gathering loops over the outline's few loose elements scalar; that is slower, not wrong
    list(APPEND options -Wno-pass-failed)
  endif()
  if(WEAVEFORM_NATIVE)
    list(APPEND options -march=native -mprefer-vector-width=512)
  endif()
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${options}")
endfunction()
