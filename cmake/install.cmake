# cmake --install: the program (component `program`) and the libraries up to post with their headers (`development`), for
# find_package(Weaveform) in other projects (docs/library.md). Headers lie in include/weaveform, as the rooms do here.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# The program, with its manual page and completion, which it prints itself.
set(manual ${PROJECT_BINARY_DIR}/manual)
file(MAKE_DIRECTORY ${manual})
add_custom_command(OUTPUT ${manual}/weaveform.1.gz ${manual}/weaveform.bash
  COMMAND sh -c "'$<TARGET_FILE:weaveform>' help --man | gzip -9n >weaveform.1.gz"
  COMMAND sh -c "'$<TARGET_FILE:weaveform>' help --completion bash >weaveform.bash"
  DEPENDS weaveform WORKING_DIRECTORY ${manual} COMMENT "" VERBATIM)
add_custom_target(weaveform_manual ALL DEPENDS ${manual}/weaveform.1.gz ${manual}/weaveform.bash)
install(TARGETS weaveform RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(TARGETS weaveform-picture RUNTIME DESTINATION libexec/weaveform COMPONENT program)
foreach(component IN ITEMS program development)
  install(TARGETS weaveform_opencascade LIBRARY DESTINATION libexec/weaveform COMPONENT ${component})
endforeach()
install(FILES ${manual}/weaveform.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${manual}/weaveform.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  RENAME weaveform COMPONENT program)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

set(rooms core fabric mesher solver post)
foreach(room IN LISTS rooms)
  set_target_properties(weaveform_${room} PROPERTIES EXPORT_NAME ${room})
  list(APPEND libraries weaveform_${room})
  install(DIRECTORY ${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/weaveform COMPONENT development
    FILES_MATCHING PATTERN "*.hpp")
endforeach()
# what the rooms are linked with; the two interfaces are empty once installed but for the place of the headers
list(APPEND libraries weaveform_triangles weaveform_cad weaveform_point_surface weaveform_options weaveform_warnings)
install(TARGETS ${libraries} EXPORT WeaveformTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)

# one does not need the tests built to install the rest
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY TRUE)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Weaveform)
install(EXPORT WeaveformTargets NAMESPACE Weaveform:: DESTINATION ${package_folder} COMPONENT development)
configure_package_config_file(cmake/WeaveformConfig.cmake.in ${PROJECT_BINARY_DIR}/WeaveformConfig.cmake
  INSTALL_DESTINATION ${package_folder})
# while the first number is 0, anything may change with the second
write_basic_package_version_file(${PROJECT_BINARY_DIR}/WeaveformConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/WeaveformConfig.cmake ${PROJECT_BINARY_DIR}/WeaveformConfigVersion.cmake
  DESTINATION ${package_folder} COMPONENT development)
