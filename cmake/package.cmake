# CPack: the Debian package of the program (./dev package). What it depends on is read off the program itself.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME weaveform)
set(CPACK_PACKAGE_VENDOR Weaveform)
set(CPACK_PACKAGE_CONTACT "Weaveform <weaveform@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "predicts how woven reinforcements form")
set(CPACK_PACKAGE_DESCRIPTION "An explicit finite-element solver for the forming of dry fabrics: yarns as a lattice of
line elements, merged with cells that carry in-plane shear only; rigid tools with contact and friction, draping, fitted
material cards, comparison with optical measurements, and export to other codes.")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
# the libraries are for a build of one's own (cmake --install)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Gmsh's library is not linked but loaded when needed, so that its package is not among those found
file(REAL_PATH ${GMSH_LIBRARY} gmsh_file)
execute_process(COMMAND dpkg-query --search ${gmsh_file} OUTPUT_VARIABLE gmsh_package ERROR_QUIET)
string(REGEX REPLACE ":.*" "" CPACK_DEBIAN_PACKAGE_DEPENDS "${gmsh_package}")
# draws the charts; a run without it says so and leaves them out. Pictures where there is no screen, and films, likewise.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "xvfb, xauth, ffmpeg")
install(FILES cmake/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/weaveform COMPONENT program)
install(FILES post/report/viewer/packed/LICENSES.txt DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/weaveform
  RENAME viewer-licenses.txt COMPONENT program)
include(CPack)
