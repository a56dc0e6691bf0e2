# Run for the object files of an inner loop (cmake/inner_loop.cmake): fails when one of OBJECTS defines what the linker
# may share with other files, such as an inline function or a template of a header that was not inlined.
foreach(object IN LISTS OBJECTS)
  execute_process(COMMAND ${NM} -C --defined-only ${object} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  # W, V, u: weak or unique
  string(REGEX MATCHALL "[^\n]* [WVu] [^\n]*" shared "${symbols}")
  if(shared)
    list(JOIN shared "\n  " shared)
    message(FATAL_ERROR "${object} is compiled for some processors only, but its code may be linked for all:\n  ${shared}\n"
      "Make it always_inline, or give it internal linkage.")
  endif()
endforeach()
