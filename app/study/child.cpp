#include "app/study/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "core/error.hpp"

namespace weaveform::study {

namespace {

constexpr int no_program = 127;  // as a shell says it

// Between fork and exec: nothing here may allocate.
[[noreturn]] void become(char* const* arguments, int log, pid_t parent) {
  // The study may be killed without a chance to stop its cases; two studies must not then write into one folder.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(no_program);
  // An interruption is the study's to pass on: a group of its own keeps the terminal's Ctrl-C from arriving twice.
  setpgid(0, 0);
  const int nowhere = open("/dev/null", O_RDWR);
  dup2(nowhere, STDIN_FILENO);
  dup2(nowhere, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  execv(arguments[0], arguments);
  _exit(no_program);
}

}  // namespace

std::filesystem::path this_program() {
  // Not what the link says: that may have been built anew, or removed, since this program began.
  return "/proc/self/exe";
}

pid_t start_child(const std::vector<std::string>& arguments, const std::filesystem::path& log) {
  std::vector<std::string> copy = arguments;
  std::vector<char*> words;
  for (std::string& word : copy) words.push_back(word.data());
  words.push_back(nullptr);
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file < 0) throw FileError(fmt::format("{}: cannot be written ({})", log.string(), std::strerror(errno)));
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) become(words.data(), file, parent);
  const int reason = errno;
  close(file);
  if (child < 0) throw FileError(fmt::format("no process for a case ({}); use fewer --jobs", std::strerror(reason)));
  return child;
}

std::optional<int> poll_child(pid_t child) {
  int status = 0;
  const pid_t ended = waitpid(child, &status, WNOHANG);
  if (ended == 0 || (ended < 0 && errno == EINTR)) return std::nullopt;
  if (ended < 0) throw FileError(fmt::format("a case's process is lost ({})", std::strerror(errno)));
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace weaveform::study
