// What the user sees: answers on standard output, log and complaints on standard error.
#pragma once

#include <exception>
#include <string>

#include "core/error.hpp"

namespace weaveform {

// The exit code of a failure of ours that no user can mend. Kept apart from the promised codes of ExitCode.
inline constexpr int defect_code = 1;

// An answer (table, scene, reference). Throws FileError when standard output cannot take it (closed, a full
// disk, a reader that has gone).
void print_answer(const std::string& text);

// A line of the log; what cannot be written is lost (core/log/say.hpp).
void log_line(const std::string& text);

// A line of the log that begins with "warning: "; nothing for an empty text.
void log_warning(const std::string& text);

// Says on standard error what went wrong, one line for each complaint, and gives the exit code that belongs to it:
//   InputError 2, PhysicsError 3, FileError (and any other trouble of the file system, or no memory left) 4,
//   Interrupted 130, anything else 1: a defect of Weaveform itself.
[[nodiscard]] int report(const std::exception& error);

}  // namespace weaveform
