# Linked by every target of ours, last: warnings are errors, on g++ and clang++ alike.
add_library(weaveform_warnings INTERFACE)
target_compile_options(weaveform_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wold-style-cast)
# Not of the instrumented build: g++ 12 sees uninitialised members and ends of arrays in its own library there that are none.
if(NOT WEAVEFORM_SANITIZE)
  target_compile_options(weaveform_warnings INTERFACE -Werror)
endif()
