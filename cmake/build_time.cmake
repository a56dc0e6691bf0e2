# What makes a clean build short. Measured with g++ 12: half of a typical file's compilation was reading headers, and
# half of the rest optimising what runs once.

# Headers that most files of a target include are read once for all of them.
function(weaveform_precompile target)
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <cmath> <filesystem> <map> <optional> <set> <string> <vector> <fmt/format.h> ${ARGN})
endfunction()

# weaveform_runs_once(TARGET [PATTERN]): sources (those that match) that read, check, name or write, and are done before
# anybody has noticed, are optimised less. Arithmetic keeps its bits: neither compiler reorders it at any level.
function(weaveform_runs_once target)
  if(NOT ARGN)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX ${ARGN})
  set_property(SOURCE ${sources} TARGET_DIRECTORY ${target} APPEND PROPERTY
    COMPILE_OPTIONS $<$<CONFIG:Release>:-O1>)
endfunction()

# Several files of a target at a time: what each of them makes of the same templates (argument parsing, JSON, formatting)
# is compiled once. Their anonymous namespaces must get on with each other.
function(weaveform_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 7)
endfunction()
