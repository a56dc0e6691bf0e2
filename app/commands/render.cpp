// weaveform render DIR: a picture or a film of a result. Drawing needs libraries and an X server that nothing else does, so
// that a program of its own draws (app/picture), under a virtual server where there is no screen.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>

#include "app/commands/commands.hpp"
#include "app/picture/picture_options.hpp"
#include "core/error.hpp"
#include "core/files/beside_program.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

fs::path drawing_program() {
  const std::string name = "weaveform-picture";
  if (fs::path place = beside_program(name); !place.empty()) return place;
  throw FileError(
      fmt::format("{}: the program that draws is not there; install weaveform again, or in its sources run ./dev build",
                  first_place(name).string()));
}

std::vector<std::string> words_for(const PictureArguments& arguments) {
  std::vector<std::string> words = {drawing_program().string(),
                                    arguments.directory,
                                    "--output",
                                    arguments.output,
                                    "--field",
                                    arguments.field,
                                    "--view",
                                    arguments.view,
                                    "--size",
                                    std::to_string(arguments.size[0]),
                                    std::to_string(arguments.size[1])};
  if (!arguments.range.empty()) {
    words.emplace_back("--range");
    for (const double end : arguments.range) words.push_back(fmt::format("{}", end));
  }
  if (arguments.frame) words.insert(words.end(), {"--frame", std::to_string(*arguments.frame)});
  for (const auto& [is_asked, word] : {std::pair{arguments.animate, "--animate"},
                                       {arguments.without_tools, "--no-tools"},
                                       {arguments.without_yarns, "--no-yarns"},
                                       {arguments.force, "--force"},
                                       {arguments.quiet, "--quiet"}})
    if (is_asked) words.emplace_back(word);
  return words;
}

// What graphics drivers keep to the end is not ours to free.
void leave_drivers_alone() {
#ifdef __SANITIZE_ADDRESS__
  const char* options = std::getenv("ASAN_OPTIONS");
  setenv("ASAN_OPTIONS", fmt::format("{}:detect_leaks=0", options != nullptr ? options : "").c_str(), 1);
#endif
}

void render(const PictureArguments& arguments) {
  leave_drivers_alone();
  std::vector<std::string> words = words_for(arguments);
  const char* display = std::getenv("DISPLAY");
  const bool has_screen = display != nullptr && *display != '\0';
  if (!has_screen) words.insert(words.begin(), {"xvfb-run", "--auto-servernum", "--server-args=-screen 0 640x480x24"});
  std::vector<char*> call;
  for (std::string& word : words) call.push_back(word.data());
  call.push_back(nullptr);
  execvp(call[0], call.data());
  if (errno == ENOENT && !has_screen)
    throw FileError(
        "there is no screen to draw with (DISPLAY is not set), and no virtual one: xvfb-run is not on the PATH; "
        "install "
        "it (Debian: apt-get install xvfb xauth)");
  throw FileError(fmt::format("{}: cannot be started ({})", words.front(), std::strerror(errno)));
}

}  // namespace

void add_render_command(CLI::App& program) {
  auto* command = program.add_subcommand("render", "A picture (PNG) or film (GIF, WebM) of a result");
  const auto arguments = std::make_shared<PictureArguments>();
  add_picture_options(*command, *arguments);
  command->callback([arguments] { render(*arguments); });
}

}  // namespace weaveform
