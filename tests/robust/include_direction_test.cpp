// Data flows mesher -> solver -> post -> app, so includes may only point backwards along it (design: one way).
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

constexpr std::array rooms = {"mesher", "solver", "post", "app"};

struct Include {
  fs::path file;  // relative to the project
  int line = 0;
  std::string target;  // as written between the quotes
};

// The room's place along the flow, or -1.
int rank_of(const fs::path& path) {
  const auto found = std::find(rooms.begin(), rooms.end(), *path.begin());
  return found == rooms.end() ? -1 : static_cast<int>(found - rooms.begin());
}

std::vector<Include> quoted_includes(const fs::path& root, const std::string& room) {
  static const std::regex pattern(R"re(^\s*#\s*include\s+"([^"]+)")re");
  std::vector<Include> found;
  for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
    const auto ending = entry.path().extension();
    if (ending != ".hpp" && ending != ".cpp" && ending != ".in") continue;
    std::ifstream file(entry.path());
    std::smatch match;
    int number = 0;
    for (std::string line; std::getline(file, line);) {
      ++number;
      if (std::regex_search(line, match, pattern))
        found.push_back({fs::relative(entry.path(), root), number, match[1].str()});
    }
  }
  return found;
}

class IncludeDirection : public testing::TestWithParam<const char*> {};

TEST_P(IncludeDirection, PointsBackwardsOnly) {
  const fs::path root = WEAVEFORM_SOURCE_DIR;
  const auto includes = quoted_includes(root, GetParam());
  EXPECT_FALSE(includes.empty()) << "no include found in " << GetParam() << ": the search itself is broken";
  for (const auto& include : includes)
    EXPECT_LE(rank_of(include.target), rank_of(include.file))
        << include.file.string() << ":" << include.line << " includes " << include.target << ", a later room";
}

// A quoted include names a file from the project's root; with that, the rule above cannot be evaded by "../".
TEST_P(IncludeDirection, NamesFilesFromTheRoot) {
  const fs::path root = WEAVEFORM_SOURCE_DIR;
  for (const auto& include : quoted_includes(root, GetParam())) {
    EXPECT_GE(rank_of(include.target), 0)
        << include.file.string() << ":" << include.line << " includes " << include.target << ", which is in no room";
    EXPECT_EQ(include.target.find(".."), std::string::npos) << include.file.string() << ":" << include.line;
  }
}

INSTANTIATE_TEST_SUITE_P(Rooms, IncludeDirection, testing::ValuesIn(rooms),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
