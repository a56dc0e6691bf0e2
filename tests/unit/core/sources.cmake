set(UNIT_CORE_SOURCES
  unit/core/files/owned_files_test.cpp
  unit/core/findings_test.cpp
  unit/core/chart/chart_test.cpp
  unit/core/guard/guarded_test.cpp
  unit/core/keys/advice_test.cpp
  unit/core/log/plain_text_test.cpp
)
