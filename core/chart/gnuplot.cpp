#include "core/chart/gnuplot.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/guard/run_program.hpp"

namespace weaveform {

std::string run_gnuplot(const std::string& script) {
  const std::string purpose = "charts cannot be drawn";
  // -d: without any start-up file.
  const ProgramEnd end = run_program({"gnuplot", "-d", "-"}, script, purpose, "gnuplot-nox");
  if (end.signal != 0)
    throw FileError(fmt::format("{}: gnuplot was ended by signal {} (package gnuplot-nox)", purpose, end.signal));
  // Its last line is the reason: it repeats the command and points at the place before it.
  if (end.exit_code != 0)
    throw FileError(fmt::format("{}: gnuplot (package gnuplot-nox, 5.4 or later) ended with exit code {}: {}", purpose,
                                end.exit_code, end.complaint));
  return end.output;
}

}  // namespace weaveform
