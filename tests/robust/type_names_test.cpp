// Two types of one name in one namespace are undefined, and no compiler says so: a program that holds both takes the
// member functions of their vectors from either. The headers are read for it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>

namespace {

namespace fs = std::filesystem;

TEST(TypeNames, StandOnceInTheirNamespace) {
  static const std::regex space(R"(^namespace ([\w:]+) \{)");
  static const std::regex type(R"(^(?:struct|class) (?:alignas\(\w+\) )?(\w+)(?: final)?(?: : [^;]*)? \{)");
  std::map<std::string, std::string> first;  // header of each type
  for (const char* room : {"mesher", "solver", "post", "app"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(WEAVEFORM_SOURCE_DIR) / room)) {
      if (entry.path().extension() != ".hpp") continue;
      std::ifstream file(entry.path());
      std::string within, line;
      for (std::smatch found; std::getline(file, line);) {
        if (std::regex_search(line, found, space)) within = found[1];
        if (!std::regex_search(line, found, type)) continue;
        const auto [place, is_new] = first.emplace(within + "::" + found[1].str(), entry.path().string());
        EXPECT_TRUE(is_new) << place->first << " in " << place->second << " and " << entry.path().string();
      }
    }
  EXPECT_GT(first.size(), 100U) << "the search itself is broken";
}

}  // namespace
