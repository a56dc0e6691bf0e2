// Gmsh scripts (.geo) taken as data: the part of the language that describes geometry, and nothing else of it.
//
// Gmsh's language also runs programs, reads and writes files, asks the user and talks to servers. A scene's outline or
// tool must not: it may come from anybody. What is not on the list of geometry words (geo_words.hpp) is refused with
// its line, unless the user trusts the script (--trust-geo).
#pragma once

#include <string>
#include <string_view>

namespace weaveform {

// The script as Gmsh is to read it: every token where it stood, comments blanked, so that what was looked at here is
// what is read there (Gmsh's loops jump back to the beginning of a line, which may lie inside a comment). Throws
// InputError with "file:line:column: what is refused; what to do" for each place.
[[nodiscard]] std::string geometry_script(std::string_view text, const std::string& file);

// Whether scripts are read without being looked at: a setting of the whole process, made once by a command's
// --trust-geo before anything is read. They still run in a child process with limits of time and memory
// (core/guard/guarded.hpp).
void trust_geo_scripts(bool trusted);
[[nodiscard]] bool geo_scripts_are_trusted();

}  // namespace weaveform
