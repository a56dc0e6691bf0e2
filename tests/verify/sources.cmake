set(VERIFY_SOURCES
  verify/fit_coverage_test.cpp
  verify/fit_paper_tables_test.cpp
  verify/fit_traps_test.cpp
  verify/bias_extension_test.cpp
  verify/shear_frame_test.cpp
  verify/unit_cell_test.cpp
)
