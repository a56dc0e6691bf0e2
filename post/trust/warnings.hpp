// What a finished run says against itself: the borders of docs/stability.md that its own numbers show to be crossed.
// A border that ends a run (energy balance, torn yarns, lost contact) is an error of the solver and never gets here.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/tools/tool.hpp"
#include "post/output/summary.hpp"
#include "solver/result/fields.hpp"
#include "solver/result/result.hpp"

namespace weaveform {

// The finished run: what was asked, with what, and what came out.
struct FinishedRun {
  const Scene& scene;
  const Card& card;
  const Mesh& mesh;
  const std::vector<Tool>& tools;
  std::array<double, 2> extent;  // mm; of the flat blank, along its own axes
  const Fields& end;
  const History& history;
  const Summary& summary;
};

// Which borders: all, those of a run as a whole, or those of one ply of a stack, whose own scene, card, mesh and fields
// the run then has.
enum class WarningsOf { all, whole_run, one_ply };

// One line each: what is wrong, the number against its border, what to do. Empty when nothing is.
[[nodiscard]] std::vector<std::string> warnings(const FinishedRun& run, WarningsOf of = WarningsOf::all);

}  // namespace weaveform
