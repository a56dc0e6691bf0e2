set(CHAIN_SOURCES
  support/run_command.cpp
  chain/bias_extension_test.cpp
  chain/examples_test.cpp
  chain/export_test.cpp
  chain/stages_test.cpp
  chain/symmetry_test.cpp
)
