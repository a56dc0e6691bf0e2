// A library never prints, exits or takes over signals: what the program does for all of it lies in app/ itself and in
// app/commands, and two services of core that are there for nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

constexpr std::array libraries = {"core", "fabric", "mesher", "solver", "post", "app/stages", "app/study"};

// Lines for people and a bar are what core/log is for; a guarded child of ours gives its own signals back.
constexpr std::array services = {"core/log/say.cpp", "core/log/say.hpp", "core/log/progress.cpp",
                                 "core/guard/guarded.cpp"};

const std::regex forbidden(
    R"(std::(cout|cerr|clog|exit|quick_exit|signal|set_terminate|puts|printf)\b|\b(sigaction|sigprocmask)\s*\()"
    R"(|(^|[^\w.>:])(exit|abort|signal|say|say_part|say_status|printf|puts|perror|log_line|log_warning)\s*\()"
    R"(|\bfmt::print\b|\bstderr\b|\bstdout\b|core/log/say\.hpp|core/log/progress\.hpp|app/console\.hpp)");

std::string code_of(const std::string& line) {
  return line.substr(0, line.find("//"));
}

std::vector<std::string> found_in(const fs::path& root, const fs::path& file) {
  std::vector<std::string> lines;
  std::ifstream stream(file);
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (std::regex_search(code_of(line), forbidden))
      lines.push_back(fs::relative(file, root).string() + ":" + std::to_string(number) + ": " + line);
  }
  return lines;
}

TEST(Libraries, NeitherPrintNorExitNorTakeOverSignals) {
  const fs::path root = WEAVEFORM_SOURCE_DIR;
  int files = 0;
  for (const char* library : libraries)
    for (const auto& entry : fs::recursive_directory_iterator(root / library)) {
      const auto ending = entry.path().extension();
      if (ending != ".hpp" && ending != ".cpp") continue;
      const std::string name = fs::relative(entry.path(), root).string();
      if (std::find(services.begin(), services.end(), name) != services.end()) continue;
      ++files;
      for (const std::string& line : found_in(root, entry.path())) ADD_FAILURE() << line;
    }
  EXPECT_GT(files, 300) << "the search itself is broken";
}

TEST(Libraries, AreSearchedForWhatTheServicesDo) {
  const fs::path root = WEAVEFORM_SOURCE_DIR;
  for (const char* service :
       {"core/log/say.cpp", "core/log/progress.cpp", "core/guard/guarded.cpp", "app/interrupt.cpp"})
    EXPECT_FALSE(found_in(root, root / service).empty()) << service;
}

}  // namespace
