#include "core/guard/run_program.hpp"

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

// What it was for, before the reason why it failed.
struct Trouble {
  const std::string& purpose;
  [[nodiscard]] FileError operator()(const std::string& reason) const {
    return FileError(fmt::format("{}: {}", purpose, reason));
  }
  [[nodiscard]] FileError operator()(int error_number) const {
    return (*this)(std::generic_category().message(error_number));
  }
};

// A file in memory. Unlike a pipe it takes any amount without a reader, so that the child can be waited for first.
class MemoryFile {
public:
  explicit MemoryFile(const Trouble& trouble) : trouble_(trouble), descriptor_(memfd_create("weaveform", MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw trouble_(errno);
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  [[nodiscard]] int descriptor() const { return descriptor_; }

  void fill(const std::string& text) const {
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t more = write(descriptor_, text.data() + done, text.size() - done);
      if (more < 0 && errno != EINTR) throw trouble_(errno);
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
      if (more < 0) throw trouble_(errno);
      if (more == 0) return text;
      text.append(part.data(), static_cast<std::size_t>(more));
    }
  }

private:
  Trouble trouble_;
  int descriptor_;
};

int wait_for(pid_t child, const Trouble& trouble) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw trouble(errno);
  return status;
}

std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  text.erase(0, text.rfind('\n') + 1);
  text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
  return text.empty() ? "no reason given" : text;
}

}  // namespace

ProgramEnd run_program(std::vector<std::string> words, const std::string& input, const std::string& purpose,
                       const std::string& package) {
  const Trouble trouble{purpose};
  const MemoryFile in(trouble), out(trouble), complaint(trouble);
  in.fill(input);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const char* search = std::getenv("PATH");
  std::string language = "LC_ALL=C", path = fmt::format("PATH={}", search != nullptr ? search : "");
  std::array<char*, 3> environment = {language.data(), path.data(), nullptr};

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, in.descriptor(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, out.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, complaint.descriptor(), STDERR_FILENO);
  pid_t child = 0;
  const int failure = posix_spawnp(&child, arguments[0], &files, nullptr, arguments.data(), environment.data());
  posix_spawn_file_actions_destroy(&files);
  if (failure == ENOENT)
    throw trouble(fmt::format("{0} is not on the PATH; install it (Debian: apt-get install {1})", words[0], package));
  if (failure != 0)
    throw trouble(fmt::format("{} cannot be started ({})", words[0], std::generic_category().message(failure)));
  const int status = wait_for(child, trouble);
  ProgramEnd end{.output = out.content(), .complaint = last_line(complaint.content())};
  if (WIFSIGNALED(status))
    end.signal = WTERMSIG(status);
  else
    end.exit_code = WEXITSTATUS(status);
  return end;
}

}  // namespace weaveform
