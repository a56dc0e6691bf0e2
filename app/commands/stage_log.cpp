#include "app/commands/stage_log.hpp"

#include <fmt/format.h>

#include "app/console.hpp"
#include "app/interrupt.hpp"
#include "app/stages/stages.hpp"
#include "core/log/progress.hpp"
#include "core/version/version.hpp"
#include "mesher/scene/reader.hpp"

namespace weaveform {

Listener console_listener(bool quiet) {
  Listener listener{.line = log_line, .warning = log_warning};
  if (quiet) listener.line = {};
  return listener;
}

namespace {

ProgressWatch watch_on(Progress& bar) {
  return {.due = [&bar](double fraction) { return bar.due(fraction); },
          .update = [&bar](double fraction, const std::string& note) { bar.update(fraction, note); },
          .finish = [&bar](const std::string& note) { bar.finish(note); }};
}

}  // namespace

void solve_on_console(ResultFolder& folder, const SolveOptions& options, bool yes) {
  const InterruptWatch signals;
  Progress bar("solve", options.quiet);
  SolveOptions how = options;
  how.progress = watch_on(bar);
  how.stop_requested = InterruptWatch::requested;
  solve_folder(folder, how, console_listener(options.quiet), yes);
}

void log_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& line : warnings) log_warning(line);
}

void log_lines(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) log_line(line);
}

void log_start(const std::string& command, const Scene& scene, bool verbose) {
  log_line(fmt::format("{}: {} {}", version_line(), command, scene.file));
  if (verbose) log_line(scene_to_toml(scene));
}

void log_end(const std::filesystem::path& directory, const std::string& what_to_open) {
  log_line(fmt::format("written to {}: {}", directory.string(), what_to_open));
}

}  // namespace weaveform
