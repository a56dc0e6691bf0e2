set(LONG_SOURCES
  long/dic_throughput_test.cpp
  support/run_command.cpp
)
