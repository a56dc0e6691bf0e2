// Lines for people, on standard error.
#pragma once

#include <string_view>

namespace weaveform {

// The text and a line's end. What cannot be written is lost without a word: work does not stop because
// nobody listens any more (a closed or full standard error, a log reader that has gone).
void say(std::string_view line) noexcept;

// The same without the line's end.
void say_part(std::string_view text) noexcept;

// On a terminal: a line that the next say_status replaces in place, and above which say() puts its own.
void say_status(std::string_view line) noexcept;
// Leaves the status line where it stands, if there is one.
void end_status_line() noexcept;

}  // namespace weaveform
