# Embeds the packed viewer as it is, by the assembler: the compiler need not read a megabyte, and no data folder is needed.
set(VIEWER_FOLDER ${CMAKE_CURRENT_SOURCE_DIR}/report/viewer/packed)
foreach(file IN ITEMS report.js report.css)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${VIEWER_FOLDER}/${file})
endforeach()
configure_file(report/viewer.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/report/viewer.cpp @ONLY)
set_property(SOURCE ${CMAKE_CURRENT_BINARY_DIR}/report/viewer.cpp
  PROPERTY OBJECT_DEPENDS "${VIEWER_FOLDER}/report.js;${VIEWER_FOLDER}/report.css")
