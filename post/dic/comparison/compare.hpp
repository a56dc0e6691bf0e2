// The whole comparison: a measurement's files against a result folder, stage by stage, so that only one stage is in
// memory at a time.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/files/owned_files.hpp"
#include "post/dic/comparison/statistics.hpp"
#include "post/dic/settings/settings.hpp"

namespace weaveform::dic {

namespace file_name {
inline constexpr const char *comparison = "comparison.json", *stage_table = "stages.csv", *line_table = "lines.csv";
inline constexpr const char *load_table = "loads.csv", *load_chart = "loads.svg", *angle_chart = "angles.svg";
inline constexpr const char* stage_fields = "stages";            // the folder of stage_NNN.csv, .vtu and _isolines.vtp
inline constexpr const char* default_comparison = "comparison";  // the folder below the result's
}  // namespace file_name

[[nodiscard]] FileNames comparison_files();

// A profile along a line of the settings, and how wide the step between its ends is (10 to 90 %, docs/dic.md); not a
// number where the fields do not reach or the ends do not differ.
struct LineProfile {
  std::string name;
  std::vector<double> distance;                                        // mm; from `from`
  std::vector<Vec2> place;                                             // mm; blank frame
  std::vector<double> measured, levelled, raw;                         // rad
  double measured_width = 0.0, levelled_width = 0.0, raw_width = 0.0;  // mm
};

struct ComparedStage {
  std::string label;
  double travel = 0.0, simulated_force = 0.0;  // mm, N
  std::optional<double> measured_force;        // N; of the stage's header or the settings, or of the load curve
  int points = 0, missing = 0, failed = 0;
  double displacement_uncertainty = 0.0;  // mm
  bool estimated = false;                 // the uncertainty was
  RigidMotion current;                    // where the deformed specimen was laid
  FieldStatistics all;
  std::vector<FieldStatistics> zone;
  std::vector<LineProfile> line;
  Verdict verdict;
  std::vector<std::string> notes;
};

struct LoadCurve {
  std::vector<double> travel, simulated, measured;  // mm, N, N; measured not a number beyond the measured curve
  double rms = 0.0, ratio = 0.0;                    // N; of the difference; measured over simulated, least squares
  double measured_end = 0.0;                        // mm; last travel of the measured curve
};

struct Comparison {
  std::filesystem::path result;
  std::vector<std::string> files;
  std::string grip;
  std::string ply;  // of a stack, that is seen
  Instrument instrument;
  Placement placement;
  double coverage = 2.0;
  FieldSymmetry symmetry = FieldSymmetry::none;
  std::vector<ComparedStage> stage;
  std::optional<LoadCurve> load;
};

// Reads, compares and writes into `output`: stages/stage_NNN.csv, .vtu and _isolines.vtp as the settings ask,
// stages.csv, lines.csv, loads.csv, angles.svg, loads.svg and, last, comparison.json. Throws FileError, InputError.
[[nodiscard]] Comparison compare(const std::filesystem::path& result, const std::vector<std::string>& measurement,
                                 const Settings& settings, const std::filesystem::path& output);

// What must be answered before the measurement can be compared. Throws FileError, InputError.
[[nodiscard]] Questions questions_of(const std::vector<std::string>& measurement, const Settings& settings);

// What the user sees at the end: placement, instrument, one row per stage, zones of the last stage, load, verdict.
[[nodiscard]] std::string verdict_table(const Comparison& comparison);

// comparison.json, as a document.
[[nodiscard]] nlohmann::ordered_json comparison_json(const Comparison& comparison);

// The tables, charts and comparison.json.
void write_report(const Comparison& comparison, const std::filesystem::path& output);

}  // namespace weaveform::dic
