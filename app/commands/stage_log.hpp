// What commands that run stages of the chain (app/stages) say of them, worded once.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/log/listener.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/result/result_folder.hpp"
#include "solver/solve.hpp"

namespace weaveform {

// Prints; of a quiet command the warnings alone.
[[nodiscard]] Listener console_listener(bool quiet);

// solve_folder with progress and log on the console unless options.quiet; signals that would end the program stop it
// with a checkpoint.
void solve_on_console(ResultFolder& folder, const SolveOptions& options, bool yes);

// "warning: ..." on standard error, also of a quiet command.
void log_warnings(const std::vector<std::string>& warnings);

// Each as a line of the log.
void log_lines(const std::vector<std::string>& lines);

// Logs program and command; with `verbose` every value of the scene too, so that the log alone can be run again.
void log_start(const std::string& command, const Scene& scene, bool verbose);

// Says where the command's files are, and which of them to open next.
void log_end(const std::filesystem::path& directory, const std::string& what_to_open);

}  // namespace weaveform
