// Tests of the program as a user meets it: a folder of their own with the tiny scene in it, and commands run there.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/run_command.hpp"

namespace weaveform::test {

class CommandFolder : public testing::Test {
protected:
  void SetUp() override { write_text(tiny_scene(), file("tiny.toml")); }
  [[nodiscard]] CommandResult run(const std::string& command) const { return run_command(command, folder_.path()); }
  // The command must end with 0.
  void must(const std::string& command) const {
    const CommandResult result = run(command);
    ASSERT_EQ(result.exit_code, 0) << command << "\n" << result.err;
  }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }
  [[nodiscard]] bool has(const std::string& program) const { return run("command -v " + program).exit_code == 0; }

private:
  TemporaryFolder folder_;
};

}  // namespace weaveform::test
