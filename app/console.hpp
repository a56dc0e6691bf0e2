// What the user sees: answers on standard output, log and complaints on standard error.
#pragma once

#include <exception>
#include <string>

#include "mesher/base/error.hpp"

namespace weaveform {

// An answer (table, scene, reference). Throws FileError when standard output cannot take it (full disk behind a pipe).
void print_answer(const std::string& text);

// A line of the log.
void log_line(const std::string& text);

// A line of the log that begins with "warning: "; nothing for an empty text.
void log_warning(const std::string& text);

// Says on standard error what went wrong, one line for each complaint, and gives the exit code that belongs to it:
//   InputError 2, PhysicsError 3, FileError (and any other trouble of the file system, or no memory left) 4,
//   Interrupted 130, anything else 1: a defect of Weaveform itself.
[[nodiscard]] int report(const std::exception& error);

}  // namespace weaveform
