#include "core/files/owned_files.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

TEST(OwnedFiles, AreThoseOfTheListAndNoOthers) {
  const FileNames names = {"history.csv", "frames/frame_##.vtu", "work_precision_*.svg", "cases/*"};
  for (const char* ours : {"history.csv", "frames/frame_10.vtu", "frames/frame_00012.vtu", "work_precision_.svg",
                           "work_precision_top.force_N.svg", "cases/a.toml"})
    EXPECT_TRUE(is_one_of(ours, names)) << ours;
  for (const char* other : {"history.csv2", "History.csv", "my/history.csv", "frames/frame_.vtu", "frames/frame_1.vtu",
                            "frames/frame_12a.vtu", "frames/frame_0000_mine.vtu", "frames/more/frame_0001.vtu",
                            "work_precision_a/b.svg", "cases/.hidden", "cases", "cases/a/b", ""})
    EXPECT_FALSE(is_one_of(other, names)) << other;
}

TEST(OwnedFiles, AreRemovedWithTheFoldersThatAreEmptyThen) {
  const test::TemporaryFolder folder;
  for (const char* name : {"frames", "stages", "other"}) fs::create_directories(folder.path() / name);
  for (const char* name : {"frames/frame_0001.vtu", "stages/stage_001.txt", "stages/notes.txt", "other/mine"})
    std::ofstream(folder.path() / name) << "x";
  remove_files(folder.path(), {"frames/frame_#.vtu", "stages/stage_#.txt"});
  EXPECT_FALSE(fs::exists(folder.path() / "frames"));
  EXPECT_FALSE(fs::exists(folder.path() / "stages/stage_001.txt"));
  EXPECT_TRUE(fs::exists(folder.path() / "stages/notes.txt"));
  EXPECT_TRUE(fs::exists(folder.path() / "other/mine"));
}

TEST(OwnedFiles, AreFoundInFoldersOfAnyNameToo) {
  const test::TemporaryFolder folder;
  for (const char* name : {"plies/lower", "plies/upper", "plies/mine"}) fs::create_directories(folder.path() / name);
  fs::create_directory_symlink("mine", folder.path() / "plies/link");
  for (const char* name : {"plies/lower/outline.csv", "plies/upper/outline.csv", "plies/mine/notes.txt"})
    std::ofstream(folder.path() / name) << "x";
  EXPECT_EQ(present_files(folder.path(), {"plies/*/outline.csv"}).size(), 2U);
  remove_files(folder.path(), {"plies/*/outline.csv"});
  EXPECT_FALSE(fs::exists(folder.path() / "plies/lower"));
  EXPECT_FALSE(fs::exists(folder.path() / "plies/upper"));
  EXPECT_TRUE(fs::exists(folder.path() / "plies/mine/notes.txt"));
}

TEST(OwnedFiles, AreNotLookedForBehindALink) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder.path() / "theirs");
  std::ofstream(folder.path() / "theirs/frame_0001.vtu") << "x";
  fs::create_directory_symlink("theirs", folder.path() / "frames");
  remove_files(folder.path(), {"frames/frame_#.vtu"});
  EXPECT_TRUE(fs::exists(folder.path() / "theirs/frame_0001.vtu"));
}

}  // namespace
}  // namespace weaveform
