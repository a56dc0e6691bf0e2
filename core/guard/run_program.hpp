// Another program (node, ffmpeg) as a child process, run to its end.
#pragma once

#include <string>
#include <vector>

namespace weaveform {

struct ProgramEnd {
  int exit_code = 0;      // when it ended by itself
  int signal = 0;         // that ended it; 0: none
  std::string output;     // all of its standard output
  std::string complaint;  // the last line that it said on standard error, "no reason given" for none
};

// `words`: the program, looked for on the PATH, and its arguments; no shell takes part, and of the environment nothing but
// PATH (its language is C). `input` is its standard input. Throws FileError that begins with `purpose` ("charts cannot be
// drawn"): with `package` to install when the program is not on the PATH, else with why it cannot be run.
[[nodiscard]] ProgramEnd run_program(std::vector<std::string> words, const std::string& input,
                                     const std::string& purpose, const std::string& package);

}  // namespace weaveform
