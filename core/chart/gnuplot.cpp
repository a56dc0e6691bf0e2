#include "core/chart/gnuplot.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "core/error.hpp"

namespace weaveform {
namespace {

FileError cannot_draw(const std::string& reason) {
  return FileError("charts cannot be drawn: " + reason);
}

std::string words_of(int error_number) {
  return std::generic_category().message(error_number);
}

// A file in memory. Unlike a pipe it takes any amount without a reader, so that the child can be waited for first.
class MemoryFile {
public:
  MemoryFile() : descriptor_(memfd_create("weaveform-chart", MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw cannot_draw(words_of(errno));
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  [[nodiscard]] int descriptor() const { return descriptor_; }

  void fill(const std::string& text) const {
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t more = write(descriptor_, text.data() + done, text.size() - done);
      if (more < 0 && errno != EINTR) throw cannot_draw(words_of(errno));
      if (more > 0) done += static_cast<std::size_t>(more);
    }
    lseek(descriptor_, 0, SEEK_SET);
  }

  [[nodiscard]] std::string content() const {
    std::string text;
    std::array<char, 1 << 16> part;
    lseek(descriptor_, 0, SEEK_SET);
    while (true) {
      const ssize_t more = read(descriptor_, part.data(), part.size());
      if (more < 0 && errno == EINTR) continue;
      if (more < 0) throw cannot_draw(words_of(errno));
      if (more == 0) return text;
      text.append(part.data(), static_cast<std::size_t>(more));
    }
  }

private:
  int descriptor_;
};

pid_t start(const MemoryFile& script, const MemoryFile& answer, const MemoryFile& complaint) {
  // -d: without any start-up file.
  std::string program = "gnuplot", no_settings = "-d", from_input = "-";
  std::array<char*, 4> arguments = {program.data(), no_settings.data(), from_input.data(), nullptr};
  const char* search = std::getenv("PATH");
  std::string language = "LC_ALL=C", path = fmt::format("PATH={}", search != nullptr ? search : "");
  std::array<char*, 3> environment = {language.data(), path.data(), nullptr};

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, script.descriptor(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, answer.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, complaint.descriptor(), STDERR_FILENO);
  pid_t child = 0;
  const int failure = posix_spawnp(&child, program.c_str(), &files, nullptr, arguments.data(), environment.data());
  posix_spawn_file_actions_destroy(&files);
  if (failure == ENOENT)
    throw cannot_draw("gnuplot is not on the PATH; install it (Debian: apt-get install gnuplot-nox)");
  if (failure != 0) throw cannot_draw(fmt::format("gnuplot cannot be started ({})", words_of(failure)));
  return child;
}

int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw cannot_draw(fmt::format("gnuplot is lost ({})", words_of(errno)));
  return status;
}

// The last line that says something: gnuplot repeats the command and points at the place before it.
std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  text.erase(0, text.rfind('\n') + 1);
  text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
  return text.empty() ? "no reason given" : text;
}

}  // namespace

std::string run_gnuplot(const std::string& script) {
  const MemoryFile input, answer, complaint;
  input.fill(script);
  const int status = wait_for(start(input, answer, complaint));
  if (WIFSIGNALED(status))
    throw cannot_draw(fmt::format("gnuplot was ended by signal {} (package gnuplot-nox)", WTERMSIG(status)));
  if (WEXITSTATUS(status) != 0)
    throw cannot_draw(fmt::format("gnuplot (package gnuplot-nox, 5.4 or later) ended with exit code {}: {}",
                                  WEXITSTATUS(status), last_line(complaint.content())));
  return answer.content();
}

}  // namespace weaveform
