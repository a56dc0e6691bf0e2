set(UNIT_STUDY_SOURCES
  unit/study/measure_test.cpp
  unit/study/study_file_test.cpp
  unit/study/study_report_test.cpp
)
