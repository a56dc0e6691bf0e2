#include "post/trust/assumptions.hpp"

#include <fmt/format.h>

#include <cmath>

#include "mesher/scene/taken.hpp"
#include "post/trust/borders.hpp"
#include "post/trust/chords.hpp"
#include "post/trust/inertia.hpp"

namespace weaveform {
namespace {

TakenSummary judge_mesh(const FinishedRun& run, const TakenSpec& taken) {
  if (run.scene.tools.empty()) return {taken, ""};
  const double border = longest_chord(run.scene);
  const auto placed = place_tools(run.tools, run.history, run.end.time);
  const CutChord worst = worst_chord(run.mesh, run.end.position, placed, run.scene.analysis.curved_contact);
  return {taken, fmt::format("no chord is longer than {:.2g} of the radius of the tool it lies on", border),
          worst.ratio() <= border};
}

TakenSummary judge_cell(const FinishedRun& run, const TakenSpec& taken) {
  if (run.scene.model.cell != CellElement::membrane) return {taken, ""};
  return {taken, "nothing folds", folded_share(run.summary) <= 0.0};
}

TakenSummary judge_duration(const FinishedRun& run, const TakenSpec& taken) {
  const double most = greatest_inertia(run.scene);
  const double share = inertia_share(run.scene, run.history, run.summary.statistics.damping_per_s).share;
  return {taken, fmt::format("inertia is at most {:.2g} % of the loads", 100.0 * most), std::abs(share) <= most};
}

}  // namespace

std::vector<TakenSummary> judge_taken(const FinishedRun& run) {
  std::vector<TakenSummary> judged;
  for (const TakenSpec& taken : run.scene.taken) {
    if (taken.key == "blank.coarsening")
      judged.push_back(judge_mesh(run, taken));
    else if (taken.key == "model.cell")
      judged.push_back(judge_cell(run, taken));
    else if (taken.key == duration_key)
      judged.push_back(judge_duration(run, taken));
    else
      judged.push_back({taken, ""});
  }
  return judged;
}

}  // namespace weaveform
