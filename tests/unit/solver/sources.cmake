set(UNIT_SOLVER_SOURCES
  unit/solver/contact_law_test.cpp
  unit/solver/fabric_forces_test.cpp
  unit/solver/fields_test.cpp
  unit/solver/frames_test.cpp
  unit/solver/history_test.cpp
  unit/solver/incremental_cell_test.cpp
)
