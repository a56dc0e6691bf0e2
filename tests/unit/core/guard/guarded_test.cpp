// Work in a child process: whatever becomes of it, this process goes on and has a line to say.
#include "core/guard/guarded.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

Guard quick() {
  return {.file = "part.step", .what = "the reader", .remedy = "write it again", .seconds = 1.0, .gigabytes = 0.5};
}

std::string complaint_of(const Guard& guard, const std::function<std::string()>& work) {
  try {
    (void)run_guarded(guard, work);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Guarded, ALargeResultComesBackByteForByte) {
  std::string bytes(50000000, '\0');  // NOLINT(bugprone-string-constructor): large is meant
  for (std::size_t k = 0; k < bytes.size(); ++k) bytes[k] = static_cast<char>(k * 2654435761U >> 13);
  EXPECT_TRUE(run_guarded(quick(), [&] { return bytes; }) == bytes);
  EXPECT_EQ(run_guarded(quick(), [] { return std::string(); }), "");
}

TEST(Guarded, TheParentSeesHowFarTheChildIs) {
  Guard guard = quick();
  std::vector<double> seen;
  guard.while_it_works = [&](double fraction) { seen.push_back(fraction); };
  (void)run_guarded(guard, [] {
    for (const double fraction : {0.25, 0.75, 7.0}) {
      guarded_progress(fraction);
      std::this_thread::sleep_for(std::chrono::milliseconds(250));
    }
    return std::string();
  });
  const auto saw = [&](double fraction) { return std::find(seen.begin(), seen.end(), fraction) != seen.end(); };
  EXPECT_TRUE(saw(0.25) && saw(0.75));
  EXPECT_FALSE(saw(7.0)) << "a child is not believed";
  guarded_progress(0.5);  // here, where nobody watches
}

TEST(Guarded, ACrashIsALineThatNamesFileAndSignal) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) {
    const std::string line = complaint_of(quick(), [signal]() -> std::string {
      std::signal(signal, SIG_DFL);
      raise(signal);
      return "";
    });
    EXPECT_EQ(line.find("part.step: the reader crashed ("), 0U) << line;
    EXPECT_NE(line.find("; write it again"), std::string::npos) << line;
  }
  EXPECT_NE(complaint_of(quick(), []() -> std::string { _exit(3); }).find("exit code 3"), std::string::npos);
  EXPECT_NE(complaint_of(quick(), []() -> std::string { _exit(0); }).find("gave up"), std::string::npos);
}

TEST(Guarded, WhatNeverEndsIsEndedWhetherItComputesOrSleeps) {
  const auto begin = std::chrono::steady_clock::now();
  const std::string computing = complaint_of(quick(), []() -> std::string {
    volatile unsigned k = 0;
    while (true) k = k + 1;
  });
  EXPECT_NE(computing.find("took longer than 1 s"), std::string::npos) << computing;
  Guard by_the_clock = quick();
  by_the_clock.clock_seconds = 2.0;
  const std::string sleeping = complaint_of(by_the_clock, []() -> std::string {
    while (true) pause();
  });
  EXPECT_NE(sleeping.find("took longer than 2 s"), std::string::npos) << sleeping;
  Guard reading = quick();
  reading.seconds = 30.0;
  reading.reading_seconds = 1.0;
  const std::string in_the_reader = complaint_of(reading, []() -> std::string {
    volatile unsigned k = 0;
    while (true) k = k + 1;
  });
  EXPECT_NE(in_the_reader.find("took longer than 1 s"), std::string::npos) << in_the_reader;
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(100));
}

#if !defined(__SANITIZE_ADDRESS__)
TEST(Guarded, MemoryOutOfProportionIsRefused) {
  const volatile std::size_t much = std::size_t{1} << 40;  // known to the compiler, clang 14 would build the string
  const std::string line = complaint_of(quick(), [&much] { return std::string(much, 'x'); });
  EXPECT_NE(line.find("needs more than 0.5 GB of memory"), std::string::npos) << line;
}
#endif

TEST(Guarded, ExceptionsComeBackAsTheyWereThrown) {
  try {
    (void)run_guarded(quick(), []() -> std::string { throw InputError(std::vector<std::string>{"one", "two"}); });
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.complaints(), (std::vector<std::string>{"one", "two"}));
  }
  EXPECT_THROW((void)run_guarded(quick(), []() -> std::string { throw FileError("gone"); }), FileError);
  const std::string line = complaint_of(quick(), []() -> std::string { throw std::logic_error("odd\nthing"); });
  EXPECT_NE(line.find("failed (odd"), std::string::npos) << line;
}

TEST(Guarded, TheChildWritesNoFileStartsNoProgramAndOpensNoConnection) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "written";
  test::write_text("kept", folder.path() / "old");
  const std::string done = run_guarded(quick(), [&] {
    std::string could;
    std::ofstream(file) << "x" << std::flush;
    std::error_code refused;
    if (std::filesystem::exists(file)) could += " write";
    if (std::filesystem::remove(folder.path() / "old", refused)) could += " remove";
    std::filesystem::rename(folder.path() / "old", folder.path() / "new", refused);
    if (!refused) could += " rename";
    std::filesystem::create_directory(folder.path() / "made", refused);
    if (!refused) could += " mkdir";
    std::filesystem::create_symlink("old", folder.path() / "link", refused);
    if (!refused) could += " link";
    if (truncate((folder.path() / "old").c_str(), 0) == 0) could += " truncate";
    if (std::system(("touch " + file.string()).c_str()) == 0) could += " system";
    if (socket(AF_INET, SOCK_STREAM, 0) >= 0) could += " socket";
    if (kill(getppid(), 0) == 0) could += " kill";
    const pid_t child = fork();
    if (child == 0) _exit(0);
    if (child > 0) could += " fork";
    if (execl("/bin/true", "true", nullptr) == 0) could += " exec";
    return could;
  });
  EXPECT_EQ(done, "");
  EXPECT_EQ(test::read_text(folder.path() / "old"), "kept");
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(Guarded, AFolderToWriteInIsTheOnlyOne) {
  const test::TemporaryFolder mine, other;
  Guard guard = quick();
  guard.writable_folder = mine.path();
  (void)run_guarded(guard, [&] {
    std::ofstream(mine.path() / "a") << "x" << std::flush;
    if (std::system(("touch " + (mine.path() / "b").string()).c_str()) == 0) std::abort();
    return std::string();
  });
  EXPECT_EQ(test::read_text(mine.path() / "a"), "x");
  EXPECT_FALSE(std::filesystem::exists(mine.path() / "b"));
}

TEST(Guarded, WhatATrustedChildStartedEndsWithIt) {
  const test::TemporaryFolder folder;
  Guard guard = quick();
  guard.may_act = true;
  const std::filesystem::path file = folder.path() / "late";
  (void)run_guarded(guard, [&] {
    return std::to_string(std::system(("(sleep 1; touch '" + file.string() + "') >/dev/null 2>&1 &").c_str()));
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(Guarded, NoChildIsLeftBehind) {
  (void)complaint_of(quick(), []() -> std::string { std::abort(); });
  (void)run_guarded(quick(), [] { return std::string("x"); });
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

}  // namespace
}  // namespace weaveform
