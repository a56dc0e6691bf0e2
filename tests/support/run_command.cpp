#include "tests/support/run_command.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace weaveform::test {

namespace fs = std::filesystem;

CommandResult run_command(const std::string& command, const fs::path& folder) {
  // Kept outside `folder`, so that tests may list it.
  const TemporaryFolder captured;
  const fs::path script = captured.path() / "script";
  write_text(
      "weaveform() { '" WEAVEFORM_BINARY "' \"$@\"; }\ncd '" + folder.string() + "' || exit 1\n" + command + "\n",
      script);
  const std::string line = "sh '" + script.string() + "' </dev/null >'" + (captured.path() / "out").string() + "' 2>'" +
                           (captured.path() / "err").string() + "'";
  const int status = std::system(line.c_str());
  CommandResult result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.out = read_text(captured.path() / "out");
  result.err = read_text(captured.path() / "err");
  return result;
}

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void write_text(const std::string& text, const fs::path& file) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error("cannot write " + file.string());
}

std::string tiny_scene() {
  return R"([fabric]
material = "twintex-pw"

[blank]
size = [115.0, 230.0]
yarn_angle = 45.0
coarsening = 4

[[grip]]
name = "bottom"
edge = "bottom"

[[grip]]
name = "top"
edge = "top"
travel = 30.0

[[measure]]
name = "center"
relative_box = [-0.125, -0.125, 0.125, 0.125]

[output]
frames = 4
history = 20
)";
}

}  // namespace weaveform::test
