# What makes a clean build short. Measured with g++ 12: half of a typical file's compilation was reading headers, and
# half of the rest optimising what runs once. (Precompiled headers save what is compiled together another 3 to 13 %, and
# take as long to be made.)

# weaveform_runs_once(TARGET [PATTERN]): sources that read, check, name or write, and are done before anybody has noticed,
# are optimised no more than debugging allows: all of the target's, or those that match, which become a target of their
# own, TARGET_once, as files are compiled together only with the same options. Arithmetic keeps its bits: neither compiler
# reorders it at any level. To be called when the target is complete.
# With the sanitizers not at all: what they put in takes twice as long to optimise as to run through.
set(weaveform_brief $<$<CONFIG:Release>:-Og> $<$<BOOL:${WEAVEFORM_SANITIZE}>:-O0>)
function(weaveform_runs_once target)
  if(ARGN)
    get_target_property(sources ${target} SOURCES)
    get_target_property(libraries ${target} LINK_LIBRARIES)
    set(once ${sources})
    list(FILTER once INCLUDE REGEX "${ARGN}")
    list(REMOVE_ITEM sources ${once})
    set_target_properties(${target} PROPERTIES SOURCES "${sources}")
    add_library(${target}_once OBJECT ${once})
    target_link_libraries(${target}_once PRIVATE ${libraries})
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_once>)
    set(target ${target}_once)
  endif()
  target_compile_options(${target} PRIVATE ${weaveform_brief})
endfunction()

# weaveform_together(TARGET [APART]): the sources of a target are compiled together, at most a hundred at a time, in
# their order; those in whose path the regular expression APART matches something else, apart. Headers are read once, and
# what each file makes of the same templates (argument parsing, JSON, formatting) is compiled once: a hundred at a time
# take a sixth less than fourteen, and up to 2.2 GB each. The price: names of their anonymous namespaces must differ, and
# who changes one file compiles its neighbours, 30 s at most. -DWEAVEFORM_TOGETHER=OFF compiles each file alone.
function(weaveform_together target)
  if(NOT WEAVEFORM_TOGETHER)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    if(NOT source MATCHES "\\.cpp$" OR IS_ABSOLUTE ${source})
      continue()
    endif()
    set(group "")
    if(ARGN)
      string(REGEX MATCH "${ARGN}" group "${source}")
    endif()
    string(MAKE_C_IDENTIFIER "in_${group}" group)
    list(LENGTH sources_${group} count)
    list(APPEND sources_${group} ${source})
    math(EXPR batch "${count} / 100")
    set_property(SOURCE ${source} TARGET_DIRECTORY ${target} PROPERTY UNITY_GROUP ${group}_${batch})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
