// The force of the first tool that travels, the punch, over its travel; and how well the tools' forces balance.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesher/scene/scene.hpp"
#include "mesher/tools/tool.hpp"
#include "solver/result/result.hpp"

namespace weaveform {

struct PunchCurve {
  std::string punch;
  std::vector<std::string> tool;           // all, in the scene's order
  std::vector<double> travel;              // mm; per history row
  std::vector<std::vector<double>> force;  // N; [tool][row], along the tool's own direction
  int punch_number = 0;
  double greatest = 0.0, greatest_at = 0.0;  // N, mm; of the punch, the greatest in size with its sign
  // The history's row nearest to a part of the final travel.
  [[nodiscard]] std::size_t row_at(double part) const;
};

// None when no tool travels. Throws InputError when the history lacks a column.
[[nodiscard]] std::optional<PunchCurve> punch_curve(const Scene& scene, const History& history);

struct ForceBalance {
  double greatest = 0.0;  // 1; greatest over the rows of |sum of the tools' forces| over half the sum of their sizes
  double at_time = 0.0;   // s
};

// Tools alone hold the fabric, so that their forces along one line add up to its inertia and damping, nothing else.
// Rows while forces set in (tool_motion.hpp: force_rise) or with less than 1 % of the run's greatest sum are left out.
// None where tools face across each other, or grips or gravity act too.
[[nodiscard]] std::optional<ForceBalance> force_balance(const Scene& scene, const std::vector<Tool>& tools,
                                                        const History& history);

}  // namespace weaveform
