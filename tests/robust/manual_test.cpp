// The manual page and the completion know every command and option that --help knows, for all are made from one table.
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>

#include "tests/support/run_command.hpp"

namespace {

using weaveform::test::run_command;
using weaveform::test::TemporaryFolder;

std::string said(const std::string& command) {
  const TemporaryFolder folder;
  const auto result = run_command(command, folder.path());
  EXPECT_EQ(result.exit_code, 0) << command << '\n' << result.err;
  return result.out;
}

std::set<std::string> all_of(const std::string& text, const char* pattern) {
  const std::regex expression(pattern);
  std::set<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), expression), end; it != end; ++it)
    found.insert((*it)[1].str());
  return found;
}

// What bash offers for a line, the last word of which is begun.
std::string offered(const std::string& words) {
  return said(
      "weaveform help --completion bash >completion && mkdir folder && touch scene.toml && bash -c '"
      "source ./completion; COMP_WORDS=(" +
      words +
      "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _weaveform; "
      "echo \"${COMPREPLY[@]}\"'");
}

TEST(Manual, NamesEveryCommandAndOption) {
  const std::string page = said("weaveform help --man");
  const std::string plain = std::regex_replace(page, std::regex(R"(\\-)"), "-");
  const auto commands = all_of(page, "\n\\.SS ([a-z -]+)\n");
  EXPECT_GE(commands.size(), 18U) << "the search itself is broken";
  for (const std::string& command : commands) {
    const std::size_t begin = plain.find("\n.SS " + command + "\n"), end = plain.find("\n.S", begin + 1);
    const std::string section = plain.substr(begin, end - begin);
    const auto options = all_of(said("weaveform help " + command), "(--[a-z-]+)");
    for (const std::string& option : options) EXPECT_NE(section.find(option), std::string::npos) << command << option;
  }
  for (const char* command : {"run", "post", "post compare", "unit-cell"})
    EXPECT_TRUE(commands.count(command)) << command;
}

TEST(Completion, OffersCommandsOptionsValuesFoldersAndFiles) {
  EXPECT_EQ(offered("weaveform unit"), "unit-cell\n");
  EXPECT_EQ(offered("weaveform post comp"), "compare\n");
  EXPECT_EQ(offered("weaveform help me"), "mesh\n");
  EXPECT_EQ(offered("weaveform run --outp"), "--output\n");
  EXPECT_EQ(offered("weaveform run scene.toml --acc"), "--accuracy\n");
  EXPECT_EQ(offered("weaveform export scene.toml --format orientation-c"), "orientation-calculix\n");
  EXPECT_EQ(offered("weaveform run scene.toml --output f"), "folder\n");
  EXPECT_EQ(offered("weaveform run s"), "scene.toml\n");
  EXPECT_EQ(offered("weaveform solve fo"), "folder\n");
}

}  // namespace
