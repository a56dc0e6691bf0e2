set(ROBUST_SOURCES
  support/run_command.cpp
  robust/docs_commands_test.cpp
  robust/exit_codes_test.cpp
  robust/include_direction_test.cpp
  robust/interrupted_test.cpp
  robust/result_folder_test.cpp
)
