// gnuplot as a child process.
#pragma once

#include <string>

namespace weaveform {

// What gnuplot writes to standard output for a script. Neither the user's settings (~/.gnuplot, environment, language)
// nor a shell take part. Throws FileError, with the package to install when gnuplot is not on the PATH, else with how
// it ended and its last complaint.
[[nodiscard]] std::string run_gnuplot(const std::string& script);

}  // namespace weaveform
