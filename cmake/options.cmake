# What every target shares: the include root, sanitizers and the like. (Products are fused with sums where an instruction
# set has it: core/instructions/instructions.hpp says what that means for the bits.)
add_library(weaveform_options INTERFACE)
target_include_directories(weaveform_options INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/weaveform>)
# Position-independent code may otherwise not inline what another library could put its own in place of; nobody does.
target_compile_options(weaveform_options INTERFACE $<BUILD_INTERFACE:-fno-semantic-interposition>)
# g++ looks for memory that it may use again when it has a gigabyte, not 128 MB: 3 % of a build's time.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  target_compile_options(weaveform_options INTERFACE $<BUILD_INTERFACE:--param=ggc-min-heapsize=1048576>)
endif()
if(WEAVEFORM_SANITIZE)
  target_compile_options(weaveform_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(weaveform_options INTERFACE -fsanitize=address,undefined)
  # clang++ would put its runtime into each program, where the libraries cannot see it (own_symbols.map)
  if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
    execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-runtime-dir OUTPUT_VARIABLE runtime OUTPUT_STRIP_TRAILING_WHITESPACE)
    target_link_options(weaveform_options INTERFACE -shared-libasan -Wl,-rpath,${runtime})
  endif()
endif()
if(WEAVEFORM_FUZZ)
  target_compile_options(weaveform_options INTERFACE -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(weaveform_options INTERFACE -fsanitize=address,undefined)
endif()
# what g++ says of its address sanitizer by itself
if((WEAVEFORM_SANITIZE OR WEAVEFORM_FUZZ) AND CMAKE_CXX_COMPILER_ID MATCHES Clang)
  target_compile_definitions(weaveform_options INTERFACE __SANITIZE_ADDRESS__)
endif()
# A program's templates are its own. Libraries that use the same ones (Gmsh has Eigen in it) would otherwise be bound to
# those of the program, which are compiled with other options: with the address sanitizer, or for a machine with wider
# vectors, Eigen then frees what it did not allocate. Not with the fuzzer, whose runtime, in the program, the libraries
# must see.
if(NOT WEAVEFORM_FUZZ)
  target_link_options(weaveform_options INTERFACE
    $<BUILD_INTERFACE:$<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:-Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/own_symbols.map>>)
endif()
if(WEAVEFORM_COVERAGE)
  target_compile_options(weaveform_options INTERFACE --coverage)
  target_link_options(weaveform_options INTERFACE --coverage)
endif()

if(WEAVEFORM_SANITIZE OR WEAVEFORM_FUZZ OR WEAVEFORM_COVERAGE)
  set(WEAVEFORM_INSTRUMENTED ON)
endif()
