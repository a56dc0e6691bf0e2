#include "core/guard/guarded.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <system_error>
#include <vector>

#include "core/error.hpp"
#include "core/files/bytes.hpp"
#include "core/guard/confine.hpp"

namespace weaveform {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double clock_per_processor = 5.0, least_clock = 20.0;  // s
constexpr double bytes_per_gigabyte = 1073741824.0;
constexpr int last_signal = 64;

// How the child's message ends.
enum class Outcome : char { result = 'R', input = 'I', file = 'F', memory = 'M', other = 'X' };

#if defined(__SANITIZE_ADDRESS__)
constexpr bool address_space_is_reserved = true;  // terabytes of it, for shadow memory
#else
constexpr bool address_space_is_reserved = false;
#endif

// A number that both processes see.
class SharedFraction {
public:
  SharedFraction() : page_(mmap(nullptr, sizeof(Number), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (page_ != MAP_FAILED) new (page_) Number(0.0);
  }
  ~SharedFraction() {
    if (page_ != MAP_FAILED) munmap(page_, sizeof(Number));
  }
  SharedFraction(const SharedFraction&) = delete;
  SharedFraction& operator=(const SharedFraction&) = delete;
  // A child may write anything here.
  [[nodiscard]] double value() const {
    const double fraction = page_ == MAP_FAILED ? 0.0 : number().load();
    return fraction >= 0.0 && fraction <= 1.0 ? fraction : 0.0;
  }
  void set(double fraction) {
    if (page_ != MAP_FAILED) number().store(fraction);
  }

private:
  using Number = std::atomic<double>;
  static_assert(Number::is_always_lock_free);
  [[nodiscard]] Number& number() const { return *static_cast<Number*>(page_); }
  void* page_;
};

SharedFraction* fraction_of_this_child = nullptr;

void limit(__rlimit_resource resource, rlim_t soft, rlim_t hard) {
  rlimit now{};
  if (getrlimit(resource, &now) != 0) return;
  const rlimit wanted{std::min(soft, now.rlim_max), std::min(hard, now.rlim_max)};
  setrlimit(resource, &wanted);
}

// SIGPROF ends this process when it has computed for so long.
void set_reading_time(double seconds) {
  itimerval time{};
  time.it_value.tv_sec = static_cast<time_t>(std::ceil(seconds));
  setitimer(ITIMER_PROF, &time, nullptr);
}

double address_space_now() {
  double pages = 0.0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

// Only these two and the three standard streams, which lead nowhere, are left open. Both are above the streams.
void close_all_but(int one, int other) {
  const int nowhere = open("/dev/null", O_RDWR);
  for (int stream = 0; nowhere >= 0 && stream <= STDERR_FILENO; ++stream) dup2(nowhere, stream);
  unsigned from = STDERR_FILENO + 1;
  for (const int kept : {std::min(one, other), std::max(one, other)}) {
    if (kept < static_cast<int>(from)) continue;
    if (static_cast<unsigned>(kept) > from) close_range(from, static_cast<unsigned>(kept) - 1, 0);
    from = static_cast<unsigned>(kept) + 1;
  }
  close_range(from, ~0U, 0);
}

void enter_limits(const Guard& guard, pid_t parent, int pipe) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  setpgid(0, 0);  // the terminal's Ctrl-C is the parent's to answer, and whatever this one starts ends with it
  for (int signal = 1; signal <= last_signal; ++signal) std::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  std::ofstream("/proc/self/oom_score_adj") << 1000;  // when memory runs out, this process goes first
  close_all_but(pipe, guard.open_file);
  set_reading_time(guard.reading_seconds);
  const auto seconds = static_cast<rlim_t>(std::ceil(guard.seconds));
  limit(RLIMIT_CPU, seconds, seconds + 1);
  limit(RLIMIT_CORE, 0, 0);
  if (!address_space_is_reserved) {
    const auto bytes = static_cast<rlim_t>(address_space_now() + guard.gigabytes * bytes_per_gigabyte);
    limit(RLIMIT_AS, bytes, bytes);
  }
  if (guard.may_act) return;
  if (guard.writable_folder.empty()) limit(RLIMIT_FSIZE, 0, 0);
  confine_process(guard.writable_folder);
}

std::string message(Outcome outcome, const std::vector<std::string>& lines) {
  ByteWriter bytes;
  bytes.value<std::uint64_t>(lines.size());
  for (const std::string& line : lines) bytes.text(line);
  bytes.value(outcome);
  return bytes.take();
}

std::string outcome_of(const std::function<std::string()>& work) {
  try {
    return work() + static_cast<char>(Outcome::result);
  } catch (const InputError& error) {
    return message(Outcome::input, error.complaints());
  } catch (const FileError& error) {
    return message(Outcome::file, {error.what()});
  } catch (const std::bad_alloc&) {
    return message(Outcome::memory, {});
  } catch (const std::exception& error) {
    return message(Outcome::other, {error.what()});
  } catch (...) {
    return message(Outcome::other, {"an error without a name"});
  }
}

[[noreturn]] void be_the_child(const Guard& guard, const std::function<std::string()>& work, pid_t parent, int pipe,
                               SharedFraction& done) {
  fraction_of_this_child = &done;
  enter_limits(guard, parent, pipe);
  const std::string bytes = outcome_of(work);
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t part = write(pipe, bytes.data() + sent, bytes.size() - sent);
    if (part < 0 && errno != EINTR) _exit(1);
    if (part > 0) sent += static_cast<std::size_t>(part);
  }
  _exit(0);
}

// Ends and collects the child, and whatever it started, whatever happens here.
class Child {
public:
  explicit Child(pid_t number) : number_(number) {}
  ~Child() {
    if (number_ > 0) (void)ended();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  // Its status. One that has closed its end of the pipe is on its way out, and a signal changes that no more.
  int ended() {
    kill(-number_, SIGKILL);
    kill(number_, SIGKILL);
    int status = 0;
    while (waitpid(number_, &status, 0) < 0 && errno == EINTR) {
    }
    number_ = 0;
    return status;
  }

private:
  pid_t number_;
};

class Descriptor {
public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int number() const { return number_; }

private:
  int number_;
};

InputError failure(const Guard& guard, const std::string& what) {
  return InputError(fmt::format("{}: {} {}; {}", guard.file, guard.what, what, guard.remedy));
}

std::string too_long(double seconds) {
  return fmt::format("took longer than {:.3g} s", seconds);
}

std::string too_much(const Guard& guard) {
  return fmt::format("needs more than {:g} GB of memory", guard.gigabytes);
}

double clock_limit(const Guard& guard) {
  return guard.clock_seconds > 0.0 ? guard.clock_seconds : std::max(least_clock, clock_per_processor * guard.seconds);
}

// What the child sent until it closed its end.
std::string received(int pipe, const Guard& guard, const SharedFraction& done) {
  const double seconds = clock_limit(guard);
  const auto deadline = Clock::now() + std::chrono::duration<double>(seconds);
  const auto most = static_cast<std::size_t>(guard.gigabytes * bytes_per_gigabyte);
  std::string bytes;
  std::vector<char> part(1 << 20);
  while (true) {
    const double left = std::chrono::duration<double, std::milli>(deadline - Clock::now()).count();
    if (left <= 0.0) throw failure(guard, too_long(seconds));
    if (bytes.size() > most) throw failure(guard, too_much(guard));
    constexpr double look = 100.0;  // ms
    pollfd ready{pipe, POLLIN, 0};
    if (guard.while_it_works) guard.while_it_works(done.value());
    if (poll(&ready, 1, static_cast<int>(std::min(left + 1.0, guard.while_it_works ? look : 1e6))) <= 0) continue;
    const ssize_t got = read(pipe, part.data(), part.size());
    if (got > 0) bytes.append(part.data(), static_cast<std::size_t>(got));
    if (got == 0 || (got < 0 && errno != EINTR)) return bytes;
  }
}

std::string death_of(int status, const Guard& guard) {
  if (WIFEXITED(status)) return fmt::format("gave up without a word (exit code {})", WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU) return too_long(guard.seconds);
  if (signal == SIGPROF) return too_long(guard.reading_seconds);
  if (signal == SIGKILL) return "was killed; there may be no memory left on this machine";
  std::string name = strsignal(signal);
  std::transform(name.begin(), name.begin() + 1, name.begin(), [](unsigned char c) { return std::tolower(c); });
  return fmt::format("crashed ({})", name);
}

std::string decoded(std::string bytes, const Guard& guard) {
  const auto outcome = static_cast<Outcome>(bytes.back());
  bytes.pop_back();
  if (outcome == Outcome::result) return bytes;
  if (outcome == Outcome::memory) throw failure(guard, too_much(guard));
  std::vector<std::string> lines;
  try {
    ByteReader reader(bytes);
    for (std::size_t left = reader.count_of(sizeof(std::uint64_t)); left > 0; --left) lines.push_back(reader.text());
  } catch (const std::runtime_error&) {
    throw failure(guard, "sent nothing that can be read");
  }
  if (outcome == Outcome::input && !lines.empty()) throw InputError(lines);
  if (outcome == Outcome::file && lines.size() == 1) throw FileError(lines.front());
  throw failure(guard, "failed" + (lines.empty() ? std::string() : fmt::format(" ({})", lines.front())));
}

// Where the standard streams were closed the pipe may have taken their numbers.
void raise_above_streams(std::array<int, 2>& pipe) {
  for (int& end : pipe) {
    if (end > STDERR_FILENO) continue;
    const int raised = fcntl(end, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    close(end);
    end = raised;
  }
}

}  // namespace

void guarded_reading_is_done() {
  set_reading_time(0.0);
}

void guarded_progress(double fraction) {
  if (fraction_of_this_child != nullptr) fraction_of_this_child->set(fraction);
}

std::string run_guarded(const Guard& guard, const std::function<std::string()>& work) {
  std::array<int, 2> pipe{};
  if (pipe2(pipe.data(), O_CLOEXEC) != 0)
    throw FileError(fmt::format("{}: no pipe to read it through ({})", guard.file, std::strerror(errno)));
  raise_above_streams(pipe);
  const pid_t parent = getpid();
  SharedFraction done;
  const pid_t number = fork();
  if (number == 0) be_the_child(guard, work, parent, pipe[1], done);
  const int reason = errno;
  close(pipe[1]);
  const Descriptor end(pipe[0]);
  if (number < 0) throw FileError(fmt::format("{}: no process to read it in ({})", guard.file, std::strerror(reason)));
  Child child(number);
  std::string bytes = received(end.number(), guard, done);
  const int status = child.ended();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || bytes.empty()) throw failure(guard, death_of(status, guard));
  return decoded(std::move(bytes), guard);
}

}  // namespace weaveform
