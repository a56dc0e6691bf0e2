set(UNIT_POST_SOURCES
  unit/post/bias_extension_test.cpp
  unit/post/contours_test.cpp
  unit/post/post_test.cpp
  unit/post/summary_test.cpp
  unit/post/transfer_test.cpp
)
