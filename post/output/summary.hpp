// The run in numbers: gathered once, written as summary.json for scripts and printed as a table for people.
#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mesher/scene/scene.hpp"
#include "post/forming/forming.hpp"
#include "post/measure/bias_comparison.hpp"
#include "post/measure/folds.hpp"
#include "post/measure/frame_comparison.hpp"
#include "solver/result/result.hpp"

namespace weaveform {

namespace file_name {
inline constexpr const char* summary = "summary.json";
}

struct GripSummary {
  std::string name;
  double displacement = 0.0;   // mm; along the grip's motion, at the end
  double force = 0.0;          // N; along the grip's motion, at the end
  double largest_force = 0.0;  // N; of the whole run, the greatest in size with its sign
};

struct ToolSummary {
  GripSummary motion;
  bool at_rest = false;
  double contact_area = 0.0;                              // mm2; at the end
  std::optional<std::array<double, 3>> whole_force = {};  // N; x, y, z at the end; older results have none
};

struct MeasureSummary {
  std::string name;
  double mean = 0.0, sd = 0.0, least = 0.0, greatest = 0.0;  // deg; shear angle at the end
};

// One ply of a stack at the end.
struct PlySummary {
  std::string name, material;
  int cells = 0;
  double max_shear_angle = 0.0;                // deg; greatest |angle|
  std::array<double, 3> at = {0.0, 0.0, 0.0};  // mm; the centre of that cell
  double max_yarn_strain = 0.0;
  int folded = 0, beyond_card = 0;  // cells
  std::optional<Forming> forming;   // when the scene has tools
  std::optional<Folds> folds;       // when it has none
  Waves waves;
};

// What was left to the program, and whether what it took that for came true.
struct TakenSummary {
  TakenSpec taken;
  std::string assumed;  // "" where there is nothing to be seen of it at the end
  bool held = true;
};

struct Summary {
  SolveStatistics statistics;
  std::vector<GripSummary> grip;
  std::vector<ToolSummary> tool;
  std::vector<MeasureSummary> measure;
  std::optional<BiasComparison> bias;    // when the scene is a bias extension, of one ply or a stack
  std::optional<FrameComparison> frame;  // when the scene has a shear frame
  std::optional<Forming> forming;        // when the scene has tools
  std::optional<Folds> folds;            // when it has none
  Waves waves;
  std::vector<PlySummary> ply;       // of a stack, which has forming, folds and waves here
  std::vector<TakenSummary> taken;   // in the order of the scene's record
  std::vector<std::string> warning;  // what the run says against itself (post/trust/warnings.hpp)
};

// Grips, tools and measures of the scene at the history's last row. Throws InputError when the history has no row or
// lacks a column.
[[nodiscard]] std::vector<GripSummary> summarise_grips(const Scene& scene, const History& history);
[[nodiscard]] std::vector<ToolSummary> summarise_tools(const Scene& scene, const History& history);
[[nodiscard]] std::vector<MeasureSummary> summarise_measures(const Scene& scene, const History& history);

// summary.json: every statistic under its name; "folded_cells" and "folded_cells_at_end" among them; "measures",
// "grips" and "tools" by name; for a bias extension "bias_extension", "zones" (of a stack in each ply), "ideal" and "travel"; for a
// shear frame "frame"; for a scene with tools "forming", for one without "folds"; "wrinkles" (post/forming/waves.hpp); of
// a stack these in "plies" by name, and "pairs" by "LOWER/UPPER", what plies did to each other; "taken", what the program
// took where the scene left that to it: "key", "value", "why", where they are "missed" (what was wanted and is not
// reached), "assumed" and "held"; "warnings", a list of lines.
[[nodiscard]] nlohmann::ordered_json summary_json(const Summary& summary);
// That document as a file. Throws FileError.
void write_summary(const Summary& summary, const std::filesystem::path& file);
[[nodiscard]] std::string summary_table(const Summary& summary);

}  // namespace weaveform
