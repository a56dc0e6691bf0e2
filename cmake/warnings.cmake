# Linked by every target of ours, last: warnings are errors, on g++ and clang++ alike. Not by those who use the installed
# libraries.
add_library(weaveform_warnings INTERFACE)
target_compile_options(weaveform_warnings INTERFACE
  $<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wconversion;-Wno-sign-conversion;-Wold-style-cast>)
# Among others (weaveform_together) a file's local name may be a neighbour's, and to g++ a .cpp looks like a header, whose
# classes should hold nothing of an anonymous namespace. `./dev check alone` compiles each file alone.
set(together $<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>)
target_compile_options(weaveform_warnings INTERFACE
  $<BUILD_INTERFACE:$<IF:${together},$<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>,-Wshadow>>
  $<BUILD_INTERFACE:$<$<AND:${together},$<CXX_COMPILER_ID:GNU>>:-Wno-subobject-linkage>>)
# g++ 12 sees ends of arrays and overlaps inside its own strings that are none, the more so when they are optimised less;
# clang and the sanitizers look for the same.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(weaveform_warnings INTERFACE
    $<BUILD_INTERFACE:-Wno-array-bounds;-Wno-restrict;-Wno-stringop-overflow;-Wno-stringop-overread>)
endif()
# Not of g++'s instrumented build: version 12 sees uninitialised members and ends of arrays in its own library there that are none.
if(NOT WEAVEFORM_SANITIZE OR CMAKE_CXX_COMPILER_ID MATCHES Clang)
  target_compile_options(weaveform_warnings INTERFACE $<BUILD_INTERFACE:-Werror>)
endif()
