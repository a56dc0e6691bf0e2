#include "tests/support/run_in_terminal.hpp"

#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <stdexcept>

#include "tests/support/run_command.hpp"

namespace weaveform::test {

std::string run_in_terminal(const std::string& command, const std::filesystem::path& folder, int columns) {
  const TemporaryFolder captured;
  const std::string script = (captured.path() / "script").string();
  write_text(
      "weaveform() { '" WEAVEFORM_BINARY "' \"$@\"; }\ncd '" + folder.string() + "' || exit 1\n" + command + "\n",
      script);
  winsize size{};
  size.ws_row = 24;
  size.ws_col = static_cast<unsigned short>(columns);
  int screen = -1;
  const pid_t child = forkpty(&screen, nullptr, nullptr, &size);
  if (child < 0) throw std::runtime_error("no terminal to be had");
  if (child == 0) {
    setenv("TERM", "xterm", 1);
    execlp("sh", "sh", script.c_str(), nullptr);
    _exit(127);
  }
  std::string text;
  std::array<char, 4096> bytes{};
  // the end of a terminal's other side is an error here
  for (ssize_t count = 0; (count = read(screen, bytes.data(), bytes.size())) > 0;)
    text.append(bytes.data(), static_cast<std::size_t>(count));
  close(screen);
  waitpid(child, nullptr, 0);
  return text;
}

}  // namespace weaveform::test
