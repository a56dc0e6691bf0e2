// weaveform run SCENE --accuracy 2%: coarse levels are solved, their limit extrapolated (post/convergence), and the
// coarsest mesh taken whose error bound is within the tolerance for every measure.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/files/owned_files.hpp"

namespace weaveform::study {

namespace report_name {
inline constexpr const char* accuracy = "accuracy.md";
// The folder of the levels that were solved, each under its scene's digest: it is no result, and is taken up again.
inline constexpr const char* levels = "accuracy";
}  // namespace report_name

[[nodiscard]] inline FileNames accuracy_files() {
  return {report_name::accuracy};
}

struct AccuracyOptions {
  double tolerance = 0.02;            // relative
  double finest = 1.0;                // least factor on the scene's blank.coarsening
  std::vector<std::string> measures;  // empty: the scene's own (measure.hpp)
  int threads = 1;                    // of each run
  std::function<void(const std::string&)> log = [](const std::string&) {};
  std::function<bool()> stop_requested = {};  // as in RunOptions
};

struct Accuracy {
  bool met = false;
  double factor = 0.0;            // on the scene's coarsening, of the level taken; of the finest one when not met
  std::filesystem::path results;  // its result folder
  std::string table;              // levels, bounds, and how sure they are (Markdown)
  nlohmann::ordered_json json;    // the same: "met", "coarsening_factor", "levels" coarsest first, "verdicts"
};

// Solves factors 8, 4, 2, 1, ... >= finest on the scene's coarsening, into DIR/accuracy, coarsest first, until the
// tolerance is met; a level too coarse to mesh is left out, one solved before is not solved again. Throws what reading
// the scene throws; InputError for an unknown measure; PhysicsError when the finest level fails; Interrupted.
[[nodiscard]] Accuracy find_accuracy(const std::filesystem::path& scene_file, const std::vector<std::string>& overrides,
                                     const std::filesystem::path& directory, const AccuracyOptions& options);

// 0.02 of "2%", "2 %" or "0.02". Throws InputError unless it is between 0 and 1, both excluded.
[[nodiscard]] double parse_accuracy(const std::string& text);

}  // namespace weaveform::study
