set(UNIT_CORE_SOURCES
  unit/core/chart/chart_test.cpp
  unit/core/files/csv_test.cpp
  unit/core/guard/guarded_test.cpp
  unit/core/keys/advice_test.cpp
  unit/core/keys/choice_test.cpp
  unit/core/log/plain_text_test.cpp
)
