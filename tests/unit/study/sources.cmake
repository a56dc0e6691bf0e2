set(UNIT_STUDY_SOURCES
  unit/study/border_report_test.cpp
  unit/study/border_search_test.cpp
  unit/study/measure_test.cpp
  unit/study/study_file_test.cpp
  unit/study/study_report_test.cpp
  unit/study/work_precision_test.cpp
)
