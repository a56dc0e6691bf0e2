set(VERIFY_SOURCES
  verify/unit_cell_test.cpp
)
