#include "app/study/runner.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <deque>
#include <set>
#include <thread>
#include <utility>

#include "app/study/child.hpp"
#include "app/study/measure.hpp"
#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/files/folder_lock.hpp"
#include "mesher/tools/geo_script.hpp"
#include "solver/result/file_names.hpp"

namespace weaveform::study {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto pause = std::chrono::milliseconds(5);  // between looks at the children: small beside any case

struct Running {
  Case one;
  pid_t process;
  Clock::time_point since;
  bool resumed = false;
};

// Cases that have not ended for good, each scene once.
std::vector<Case> unfinished(const std::vector<Case>& cases, const fs::path& folder, const RunOptions& options) {
  std::vector<Case> left;
  std::set<std::string> names;
  for (const Case& one : cases) {
    if (!names.insert(one.name).second) continue;
    const CaseFiles files = case_files(folder, one.name);
    const auto ended = outcome(files, one.text);
    const bool timed = options.repeats == 1 || std::ssize(walls_of(files)) >= options.repeats;
    const bool done = ended && (ended->exit_code == 0 ? timed : is_final(ended->exit_code) && !options.retry);
    if (!done) left.push_back(one);
  }
  return left;
}

// Notes the time of the run that has just ended; of more than `repeats` the last are kept. False: run it again.
bool timed_enough(const CaseFiles& files, int repeats) {
  if (repeats == 1) return true;
  std::vector<double> walls = walls_of(files);
  walls.push_back(measure(files.results, "wall_s"));
  if (std::ssize(walls) > repeats) walls.erase(walls.begin(), walls.end() - repeats);
  std::string text;
  for (const double wall : walls) text += fmt::format("{}\n", wall);
  write_text_whole(files.walls, text);
  return std::ssize(walls) == repeats;
}

// Held while a study runs its cases.
FolderLock lock_cases(const fs::path& study_folder) {
  std::error_code trouble;
  fs::create_directories(study_folder / "cases", trouble);
  if (trouble)
    throw FileError(fmt::format("{}: cannot be made ({}); choose another --output", (study_folder / "cases").string(),
                                trouble.message()));
  return FolderLock(study_folder / "cases", "lock", "another study is running its cases in this folder");
}

class Pool {
public:
  // total: of cases; 0 where it is not known
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
    fs::remove(files.exit);
    if (options_.repeats == 1) fs::remove(files.walls);
    launch({one, 0, Clock::now()});
  }

  // Takes out the cases that have ended; true when there was one.
  bool collect() {
    bool any = false;
    for (std::size_t i = 0; i < running_.size();) {
      const auto code = poll_child(running_[i].process);
      if (!code) {
        ++i;
        continue;
      }
      any = true;
      const Running ended = std::move(running_[i]);
      running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
      end(ended, *code);
    }
    return any;
  }

  // Asks the running cases to stop, and waits until they have.
  void interrupt() {
    for (const Running& each : running_) kill(each.process, SIGTERM);
    for (const Running& each : running_) {
      auto code = poll_child(each.process);
      for (; !code; code = poll_child(each.process)) std::this_thread::sleep_for(pause);
      const CaseFiles files = case_files(folder_, each.one.name);
      const bool finished = *code == 0 ? timed_enough(files, options_.repeats) : is_final(*code);
      if (finished) write_text_whole(files.exit, fmt::format("{}\n", *code));
    }
    running_.clear();
  }

private:
  void launch(Running next) {
    const CaseFiles files = case_files(folder_, next.one.name);
    next.resumed = fs::exists(files.results / file_name::checkpoint);
    fs::remove(files.log);
    std::vector<std::string> words = {
        this_program().string(), "run",     files.scene.string(), "--output",
        files.results.string(),  "--quiet", "--threads",          std::to_string(options_.threads)};
    if (next.resumed) words.emplace_back("--resume");
    if (geo_scripts_are_trusted()) words.emplace_back("--trust-geo");
    next.process = start_child(words, files.log);
    running_.push_back(std::move(next));
  }

  void end(const Running& ended, int code) {
    const CaseFiles files = case_files(folder_, ended.one.name);
    if (code == static_cast<int>(ExitCode::interrupted)) return;
    if (code == 0 && !timed_enough(files, options_.repeats)) return launch(ended);
    // a checkpoint of another version of the program, or a damaged one, is no fault of the case
    const bool refused = code == static_cast<int>(ExitCode::input) || code == static_cast<int>(ExitCode::files);
    if (ended.resumed && refused && fs::remove(files.results / file_name::checkpoint)) return launch(ended);
    write_text_whole(files.exit, fmt::format("{}\n", code));
    const double seconds = std::chrono::duration<double>(Clock::now() - ended.since).count();
    options_.log(fmt::format("case {}{}: {}: {}, {:.1f} s", ++ended_, total_ > 0 ? fmt::format(" of {}", total_) : "",
                             describe(ended.one), code == 0 ? "done" : "failed: " + error_line(files.log, code),
                             seconds));
    if (code == 0 && !one_done_) {
      one_done_ = true;
      options_.first_done(ended.one);
    }
  }

  fs::path folder_;
  const RunOptions& options_;
  std::size_t total_;
  std::vector<Running> running_;
  int ended_ = 0;
  bool one_done_ = false;
};

int run_pool(const Wanted& wanted, Pool& pool, const RunOptions& options) {
  std::deque<Case> waiting;
  int given = 0;
  for (bool ask = true;;) {
    if (options.stop_requested && options.stop_requested()) {
      pool.interrupt();
      throw Interrupted("study interrupted; the same command goes on where it stopped");
    }
    if (ask) {
      for (Case& one : wanted()) {
        waiting.push_back(std::move(one));
        ++given;
      }
    }
    if (waiting.empty() && pool.empty()) return given;
    for (; !waiting.empty() && !pool.full(); waiting.pop_front()) pool.start(waiting.front());
    ask = pool.collect();
    if (!ask) std::this_thread::sleep_for(pause);
  }
}

}  // namespace

void write_case(const Case& one, const fs::path& study_folder) {
  const CaseFiles files = case_files(study_folder, one.name);
  if (!fs::exists(files.scene)) return write_text_whole(files.scene, one.text);
  if (read_text_file(files.scene) != one.text)
    throw FileError(
        fmt::format("{}: holds another scene than the case of that name; remove it, or use another --output",
                    files.scene.string()));
}

int run_wanted(const Wanted& wanted, const fs::path& study_folder, const RunOptions& options) {
  const FolderLock lock = lock_cases(study_folder);
  Pool pool(study_folder, options, 0);
  return run_pool(wanted, pool, options);
}

int run_cases(const std::vector<Case>& cases, const fs::path& study_folder, const RunOptions& options) {
  const FolderLock lock = lock_cases(study_folder);
  std::vector<Case> left = unfinished(cases, study_folder, options);
  Pool pool(study_folder, options, left.size());
  return run_pool([&] { return std::exchange(left, {}); }, pool, options);
}

}  // namespace weaveform::study
