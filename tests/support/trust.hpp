// What a run solved in memory says against itself (post/trust/warnings.hpp), as post-processing its folder would.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "post/measure/folds.hpp"
#include "post/trust/warnings.hpp"
#include "tests/support/scene_run.hpp"

namespace weaveform::test {

inline std::vector<std::string> warnings_of(const Solved& run) {
  const auto time = run.result.history.values("time_s").back();
  const Fields end = compute_fields(run.mesh, run.card, run.scene.model, time, run.result.position);
  Summary summary;
  summary.statistics = run.result.statistics;
  const std::vector<Tool> tools = make_tools(run.scene, run.mesh);
  summary.forming = evaluate_forming(run.scene, run.mesh, tools, end, run.result.history);
  summary.folds = find_folds(run.scene, run.mesh, end.position);
  summary.waves = summary.forming ? summary.forming->waves : evaluate_waves(run.scene.model, run.mesh, end, nullptr);
  return warnings({run.scene, run.card, run.mesh, tools, run.extent(), end, run.result.history, summary});
}

// Whether one of the lines holds `words`.
inline bool says(const std::vector<std::string>& lines, const std::string& words) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(words) != std::string::npos; });
}

// A strip of fabric, its warp along x, between a grip at rest and one that moves along x by `travel` (mm).
inline Scene strip_scene(const std::string& material, std::array<double, 2> size, double coarsening, double travel) {
  Scene scene;
  scene.fabric.material = material;
  scene.blank.size = size;
  scene.blank.yarn_angle = 0.0;
  scene.blank.coarsening = {coarsening, coarsening};
  GripSpec left, right;
  left.name = "left", left.edge = BlankEdge::left;
  right.name = "right", right.edge = BlankEdge::right;
  right.travel = travel;
  scene.grip = {left, right};
  scene.output = {.frames = 0, .history = 100, .contour_step = 5.0};
  return scene;
}

}  // namespace weaveform::test
