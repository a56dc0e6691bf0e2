// What one border of post/trust says of a run in memory.
#pragma once

#include "post/trust/borders.hpp"
#include "solver/solve.hpp"

namespace weaveform::test {

using Border = void (*)(const FinishedRun& run, Warnings& warnings);

inline Warnings ask(Border border, const Scene& scene, const Card& card, const Mesh& mesh, const SolveResult& result) {
  const Fields end = compute_fields(mesh, card, scene.model, result.statistics.duration_s, result.position);
  Summary summary;
  summary.statistics = result.statistics;
  Warnings said;
  const std::vector<Tool> tools = make_tools(scene, mesh);
  border({scene, card, mesh, tools, blank_extent(scene.blank, read_blank_outline(scene)), end, result.history, summary},
         said);
  return said;
}

}  // namespace weaveform::test
