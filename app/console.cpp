#include "app/console.hpp"

#include <fmt/core.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>

namespace weaveform {

namespace {

// The exit code of a failure of ours that no user can mend. Kept apart from the promised codes of ExitCode.
constexpr int defect_code = 1;

int failed(const std::string& message, ExitCode code) {
  fmt::print(stderr, "error: {}\n", message);
  return static_cast<int>(code);
}

}  // namespace

void print_answer(const std::string& text) {
  const bool newline_missing = text.empty() || text.back() != '\n';
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() &&
                       (!newline_missing || std::fputc('\n', stdout) != EOF) && std::fflush(stdout) == 0;
  if (!written) throw FileError(fmt::format("standard output: {}; make room or write elsewhere", std::strerror(errno)));
}

void log_line(const std::string& text) {
  fmt::print(stderr, "{}\n", text);
}

void log_warning(const std::string& text) {
  if (!text.empty()) log_line("warning: " + text);
}

int report(const std::exception& error) {
  if (const auto* input = dynamic_cast<const InputError*>(&error)) {
    for (const auto& complaint : input->complaints()) fmt::print(stderr, "error: {}\n", complaint);
    return static_cast<int>(ExitCode::input);
  }
  if (dynamic_cast<const PhysicsError*>(&error)) return failed(error.what(), ExitCode::physics);
  if (dynamic_cast<const FileError*>(&error)) return failed(error.what(), ExitCode::files);
  if (dynamic_cast<const Interrupted*>(&error)) return failed(error.what(), ExitCode::interrupted);
  if (dynamic_cast<const std::filesystem::filesystem_error*>(&error)) return failed(error.what(), ExitCode::files);
  if (dynamic_cast<const std::bad_alloc*>(&error))
    return failed("no memory left; use a greater blank.coarsening or a machine with more memory", ExitCode::files);
  fmt::print(stderr, "error: a defect in Weaveform ({}); please report it with the scene\n", error.what());
  return defect_code;
}

}  // namespace weaveform
