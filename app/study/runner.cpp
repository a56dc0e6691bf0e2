#include "app/study/runner.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <set>
#include <thread>

#include "app/study/child.hpp"
#include "mesher/base/error.hpp"
#include "solver/motion/interrupt.hpp"
#include "solver/result/whole_file.hpp"

namespace weaveform::study {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto pause = std::chrono::milliseconds(5);  // between looks at the children: small beside any case

struct Running {
  const Case* one;
  pid_t process;
  Clock::time_point since;
};

// Cases that have not ended for good, each scene once.
std::vector<const Case*> unfinished(const std::vector<Case>& cases, const fs::path& folder, bool retry) {
  std::vector<const Case*> left;
  std::set<std::string> names;
  for (const Case& one : cases) {
    if (!names.insert(one.name).second) continue;
    const auto ended = outcome(case_files(folder, one.name), one.text);
    const bool done = ended && (ended->exit_code == 0 || (is_final(ended->exit_code) && !retry));
    if (!done) left.push_back(&one);
  }
  return left;
}

// Held while a study runs its cases; the system lets go of it however the program ends.
class FolderLock {
public:
  explicit FolderLock(const fs::path& study_folder) {
    const fs::path file = study_folder / "cases" / "lock";
    std::error_code trouble;
    fs::create_directories(file.parent_path(), trouble);
    file_ = open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0)
      throw FileError(
          fmt::format("{}: cannot be written ({}); choose another --output", file.string(), std::strerror(errno)));
    if (flock(file_, LOCK_EX | LOCK_NB) == 0) return;
    close(file_);
    throw FileError(
        fmt::format("{}: another study is running its cases in this folder; wait for it, or choose another "
                    "--output",
                    study_folder.string()));
  }
  ~FolderLock() { close(file_); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

private:
  int file_ = -1;
};

class Pool {
public:
  Pool(const fs::path& folder, const RunOptions& options, std::size_t total)
      : folder_(folder), options_(options), total_(total) {}
  ~Pool() {
    for (const Running& each : running_) {
      kill(each.process, SIGKILL);
      waitpid(each.process, nullptr, 0);
    }
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  [[nodiscard]] bool full() const { return std::ssize(running_) >= options_.jobs; }
  [[nodiscard]] bool empty() const { return running_.empty(); }

  void start(const Case& one) {
    write_case(one, folder_);
    const CaseFiles files = case_files(folder_, one.name);
    const bool resume = fs::exists(files.results / "checkpoint.bin");
    fs::remove(files.exit);
    fs::remove(files.log);
    std::vector<std::string> words = {
        this_program().string(), "run",     files.scene.string(), "--output",
        files.results.string(),  "--quiet", "--threads",          std::to_string(options_.threads)};
    if (resume) words.emplace_back("--resume");
    running_.push_back({&one, start_child(words, files.log), Clock::now()});
  }

  // Takes out the cases that have ended.
  void collect() {
    for (std::size_t i = 0; i < running_.size();) {
      const auto code = poll_child(running_[i].process);
      if (!code) {
        ++i;
        continue;
      }
      const Running ended = running_[i];
      running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
      end(ended, *code);
    }
  }

  // Asks the running cases to stop, and waits until they have.
  void interrupt() {
    for (const Running& each : running_) kill(each.process, SIGTERM);
    for (const Running& each : running_) {
      auto code = poll_child(each.process);
      for (; !code; code = poll_child(each.process)) std::this_thread::sleep_for(pause);
      if (is_final(*code)) write_text_whole(case_files(folder_, each.one->name).exit, fmt::format("{}\n", *code));
    }
    running_.clear();
  }

private:
  void end(const Running& ended, int code) {
    const CaseFiles files = case_files(folder_, ended.one->name);
    if (code == static_cast<int>(ExitCode::interrupted)) return;
    write_text_whole(files.exit, fmt::format("{}\n", code));
    const double seconds = std::chrono::duration<double>(Clock::now() - ended.since).count();
    options_.log(fmt::format("case {} of {}: {}: {}, {:.1f} s", ++ended_, total_, describe(*ended.one),
                             code == 0 ? "done" : "failed: " + error_line(files.log, code), seconds));
    if (code == 0 && !one_done_) {
      one_done_ = true;
      options_.first_done(*ended.one);
    }
  }

  fs::path folder_;
  const RunOptions& options_;
  std::size_t total_;
  std::vector<Running> running_;
  int ended_ = 0;
  bool one_done_ = false;
};

}  // namespace

void write_case(const Case& one, const fs::path& study_folder) {
  const CaseFiles files = case_files(study_folder, one.name);
  if (!fs::exists(files.scene)) return write_text_whole(files.scene, one.text);
  if (read_text(files.scene) != one.text)
    throw FileError(
        fmt::format("{}: holds another scene than the case of that name; remove it, or use another --output",
                    files.scene.string()));
}

int run_cases(const std::vector<Case>& cases, const fs::path& study_folder, const RunOptions& options) {
  const FolderLock lock(study_folder);
  const std::vector<const Case*> left = unfinished(cases, study_folder, options.retry);
  const InterruptWatch watch;
  Pool pool(study_folder, options, left.size());
  std::size_t next = 0;
  while (next < left.size() || !pool.empty()) {
    if (InterruptWatch::requested()) {
      pool.interrupt();
      throw Interrupted("study interrupted; the same command goes on where it stopped");
    }
    while (next < left.size() && !pool.full()) pool.start(*left[next++]);
    pool.collect();
    if (!pool.empty()) std::this_thread::sleep_for(pause);
  }
  return static_cast<int>(left.size());
}

}  // namespace weaveform::study
