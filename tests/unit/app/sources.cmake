set(UNIT_APP_SOURCES
  unit/app/study/border_report_test.cpp
  unit/app/study/border_search_test.cpp
  unit/app/study/measure_test.cpp
  unit/app/study/study_file_test.cpp
  unit/app/study/study_report_test.cpp
  unit/app/study/work_precision_test.cpp
)
