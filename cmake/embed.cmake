# weaveform_embed(FUNCTION HEADER FILE): generates FUNCTION.cpp beside the binaries of HEADER's folder, in which FUNCTION, as
# HEADER declares it, returns the bytes of FILE. By the assembler: the compiler need not read a megabyte, and the program
# needs no data folder.
function(weaveform_embed FUNCTION HEADER FILE)
  set(FILE ${CMAKE_CURRENT_SOURCE_DIR}/${FILE})
  cmake_path(GET HEADER PARENT_PATH folder)
  set(source ${PROJECT_BINARY_DIR}/${folder}/${FUNCTION}.cpp)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/embedded.cpp.in ${source} @ONLY)
  set_property(SOURCE ${source} PROPERTY OBJECT_DEPENDS ${FILE})
endfunction()
