// Data flows mesher -> solver -> post -> app, on core and fabric, so includes may only point backwards along it
// (design: one way). Inside solver/ the folders have an order too.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

constexpr std::array rooms = {"core", "fabric", "mesher", "solver", "post", "app"};
// What lies in solver/ itself (solve, unit_cell) may use all of them.
constexpr std::array solver_folders = {"state",      "element", "lattice", "bending", "coupling",
                                       "constraint", "ply",     "contact", "result",  "analysis"};

struct Include {
  fs::path file;  // relative to the project
  int line = 0;
  std::string target;  // as written between the quotes
};

// The place of `name` in the order, or -1.
template <class Order>
int rank_in(const Order& order, const fs::path& name) {
  const auto found = std::find(order.begin(), order.end(), name);
  return found == order.end() ? -1 : static_cast<int>(found - order.begin());
}

int rank_of(const fs::path& path) {
  return rank_in(rooms, *path.begin());
}

// Of a file of the solver's: its folder's place, or behind all of them.
int rank_in_solver(const fs::path& path) {
  const int rank = rank_in(solver_folders, *std::next(path.begin()));
  return rank < 0 ? static_cast<int>(solver_folders.size()) : rank;
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

TEST(IncludeDirection, HasNoCircleAmongTheFoldersOfTheSolver) {
  const fs::path root = WEAVEFORM_SOURCE_DIR;
  for (const auto& entry : fs::directory_iterator(root / "solver"))
    if (entry.is_directory()) {
      EXPECT_GE(rank_in(solver_folders, entry.path().filename()), 0) << entry.path() << " has no place in the order";
    }
  for (const auto& include : quoted_includes(root, "solver"))
    if (include.target.starts_with("solver/")) {
      EXPECT_LE(rank_in_solver(include.target), rank_in_solver(include.file))
          << include.file.string() << ":" << include.line << " includes " << include.target << ", a later folder";
    }
}

// tests/unit shows where the code that it tests is.
TEST(UnitTests, LieInFoldersThatTheCodeHas) {
  const fs::path root = WEAVEFORM_SOURCE_DIR, unit = root / "tests" / "unit";
  for (const auto& entry : fs::recursive_directory_iterator(unit))
    if (entry.is_directory()) {
      EXPECT_TRUE(fs::is_directory(root / fs::relative(entry.path(), unit))) << entry.path();
    }
}

INSTANTIATE_TEST_SUITE_P(Rooms, IncludeDirection, testing::ValuesIn(rooms),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
