#include "app/console.hpp"

#include <fmt/core.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>
#include <string_view>

#include "core/log/say.hpp"

namespace weaveform {

namespace {

// Needs no memory: the error may be that there is none.
int failed(std::string_view message, ExitCode code) {
  say_part("error: ");
  say(message);
  return static_cast<int>(code);
}

}  // namespace

void print_answer(const std::string& text) {
  const bool newline_missing = text.empty() || text.back() != '\n';
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() &&
                       (!newline_missing || std::fputc('\n', stdout) != EOF) && std::fflush(stdout) == 0;
  if (!written)
    throw FileError(fmt::format("standard output: the answer cannot be written ({}); make room, or write elsewhere",
                                std::strerror(errno)));
}

void log_line(const std::string& text) {
  say(text);
}

void log_warning(const std::string& text) {
  if (!text.empty()) log_line("warning: " + text);
}

int report(const std::exception& error) {
  if (const auto* listed = dynamic_cast<const ListedError*>(&error)) {
    const ExitCode code = dynamic_cast<const FileError*>(&error) != nullptr ? ExitCode::files : ExitCode::input;
    for (const auto& complaint : listed->complaints()) (void)failed(complaint, code);
    return static_cast<int>(code);
  }
  if (dynamic_cast<const PhysicsError*>(&error)) return failed(error.what(), ExitCode::physics);
  if (dynamic_cast<const Interrupted*>(&error)) return failed(error.what(), ExitCode::interrupted);
  if (dynamic_cast<const std::filesystem::filesystem_error*>(&error)) return failed(error.what(), ExitCode::files);
  if (dynamic_cast<const std::bad_alloc*>(&error))
    return failed("no memory left; use a greater blank.coarsening or a machine with more memory", ExitCode::files);
  say_part("error: a defect in Weaveform (");
  say_part(error.what());
  say("); please report it with the scene");
  return defect_code;
}

}  // namespace weaveform
