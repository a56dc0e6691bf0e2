// The few ways Weaveform fails, thrown where they are found and caught once in app/main.cpp.
// Each carries a message that says what, where and what to do; the exit code follows from the type.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace weaveform {

enum class ExitCode : int { done = 0, input = 2, physics = 3, files = 4, interrupted = 130 };

// Holds every complaint found, one line each, in the form "file:line:column: what is wrong; what to do".
class ListedError : public std::runtime_error {
public:
  explicit ListedError(std::vector<std::string> complaints)
      : std::runtime_error(joined(complaints)), complaints_(std::move(complaints)) {}
  explicit ListedError(std::string complaint) : ListedError(std::vector<std::string>{std::move(complaint)}) {}
  [[nodiscard]] const std::vector<std::string>& complaints() const { return complaints_; }

private:
  static std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const auto& line : lines) text += (text.empty() ? "" : "\n") + line;
    return text;
  }
  std::vector<std::string> complaints_;
};

// The input is wrong (scene, card, measurement, arguments).
class InputError : public ListedError {
public:
  using ListedError::ListedError;
};

// The analysis went wrong: unstable step, tangled cells, energy balance lost, not a number.
class PhysicsError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

// A file cannot be read or written (missing, no permission, disk full).
class FileError : public ListedError {
public:
  using ListedError::ListedError;
};

// The user stopped the run; a checkpoint was left behind.
class Interrupted : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

}  // namespace weaveform
