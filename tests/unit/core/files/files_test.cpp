// Whole files beside each other: programs that write one file, one folder, and clear it away, all at once.
#include "core/files/files.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <vector>

#include "core/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

class WholeFiles : public testing::Test {
protected:
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) names.push_back(entry.path().filename().string());
    return names;
  }
  const test::TemporaryFolder own_;
  const fs::path folder_ = own_.path();
};

// A process of its own that ends with 0 when `work` says that all was well.
pid_t start(const std::function<bool()>& work) {
  const pid_t child = fork();
  if (child != 0) return child;
  bool well = false;
  try {
    well = work();
  } catch (const std::exception& error) {
    static_cast<void>(std::fprintf(stderr, "%s\n", error.what()));
  }
  _exit(well ? 0 : 1);
}

int ending_of(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

// Every byte of a file is its writer's letter, so that a mixture shows.
bool is_whole(const std::string& text, std::size_t size) {
  return text.size() == size && text.find_first_not_of(text.front()) == std::string::npos;
}

TEST_F(WholeFiles, TwoWritersOfOneFileAndOneWhoClearsTheFolderDoEachOtherNoHarm) {
  constexpr std::size_t size = 200'000;
  constexpr int times = 150;
  const fs::path file = folder_ / "sub" / "history.csv";
  write_text_whole(file, std::string(size, 'z'));
  std::vector<pid_t> all;
  for (const char letter : {'a', 'b'})
    all.push_back(start([&, letter] {
      for (int k = 0; k < times; ++k) write_text_whole(file, std::string(size, letter));
      return true;
    }));
  all.push_back(start([&] {
    for (int k = 0; k < 20 * times; ++k) clear_temporaries(file.parent_path());
    return true;
  }));
  all.push_back(start([&] {
    for (int k = 0; k < times; ++k)
      if (!is_whole(read_text_file(file), size)) return false;
    return true;
  }));
  for (const pid_t child : all) EXPECT_EQ(ending_of(child), 0);
  EXPECT_TRUE(is_whole(read_text_file(file), size));
  EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), fs::directory_iterator()), 1);
}

TEST_F(WholeFiles, WhatAKilledWriterLeftIsClearedAwayAndWhatALivingOneIsAtStays) {
  const fs::path file = folder_ / "frame.vtu";
  int ready[2], go[2];
  ASSERT_EQ(pipe(ready), 0);
  ASSERT_EQ(pipe(go), 0);
  const auto hold = [&](const std::string& text) {
    write_whole(file, [&](const fs::path& temporary) {
      std::ofstream(temporary) << text;
      char byte = 'r';
      ASSERT_EQ(write(ready[1], &byte, 1), 1);
      ASSERT_EQ(read(go[0], &byte, 1), 1);
    });
    return true;
  };
  char byte = 0;
  const pid_t killed = start([&] { return hold("half"); });
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  const pid_t living = start([&] { return hold("whole"); });
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_EQ(names().size(), 2U);
  clear_temporaries(folder_);
  EXPECT_EQ(names().size(), 2U) << "both are at it";
  kill(killed, SIGKILL);
  EXPECT_EQ(ending_of(killed), 128 + SIGKILL);
  clear_temporaries(folder_);
  EXPECT_EQ(names().size(), 1U) << "one is";
  ASSERT_EQ(write(go[1], &byte, 1), 1);
  EXPECT_EQ(ending_of(living), 0);
  EXPECT_EQ(names(), std::vector<std::string>{"frame.vtu"});
  EXPECT_EQ(read_text_file(file), "whole");
}

TEST_F(WholeFiles, AWriterThatFailsLeavesTheOldFileAndNothingElse) {
  const fs::path file = folder_ / "summary.json";
  write_text_whole(file, "old");
  EXPECT_THROW(write_whole(file, [](const fs::path&) { throw FileError("no"); }), FileError);
  EXPECT_EQ(read_text_file(file), "old");
  EXPECT_EQ(names().size(), 1U);
}

TEST_F(WholeFiles, ClearingAwayTouchesNothingOfAnotherName) {
  for (const char* name : {"x.partial", ".x.short.partial", ".x.abcdefghijkl.partially", ".x.ABCDEFGHIJKL.partial"})
    std::ofstream(folder_ / name) << "mine";
  const auto before = names().size();
  fs::create_symlink(folder_ / "x.partial", folder_ / ".link.abcdefghijkl.partial");
  clear_temporaries(folder_);
  EXPECT_EQ(names().size(), before + 1) << "nor a link";
  clear_temporaries(folder_ / "no such folder");
}

}  // namespace
}  // namespace weaveform
