set(CHAIN_SOURCES
  support/run_command.cpp
  chain/bias_extension_test.cpp
  chain/examples_test.cpp
  chain/forming_test.cpp
  chain/stages_test.cpp
)
