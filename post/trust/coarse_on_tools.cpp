// Nodes alone touch tools: where chords are long against a tool's radius, fabric is dragged over a polygon instead.
#include <fmt/format.h>

#include <algorithm>

#include "post/trust/borders.hpp"
#include "post/trust/chords.hpp"

namespace weaveform {
namespace {

// L/R. Measured on hemispheres drawn through fillets of 15 to 30 mm (docs/stability.md): the force is less than 7 % off
// below, 6 to 20 % and without order above, where it may agree by luck. Friction of a chain of chords over a round edge
// gives 5 % at 0.7 to 1.1 by its formula.
constexpr double longest = 1.0;
constexpr double edge = 1.5;  // L/R; a chord that bends so much may lie on an edge of no radius at all

}  // namespace

void warn_of_coarse_on_tools(const FinishedRun& run, Warnings& warnings) {
  if (run.scene.tools.empty()) return;
  const auto placed = place_tools(make_tools(run.scene, run.mesh.thickness), run.history, run.end.time);
  const CutChord worst = worst_chord(run.mesh, run.end.position, placed);
  if (worst.ratio() <= longest) return;
  if (worst.unnoticed) {
    warnings.push_back(fmt::format(
        "tool '{}' pokes {:.2g} mm deep through the fabric between nodes at ({:.4g}, {:.4g}, {:.4g}) mm, where none "
        "touches it and the solver knows nothing of it; make blank.coarsening so small that its chords of {:.3g} mm "
        "are "
        "shorter than the tool is wide",
        placed[worst.tool].tool.name, worst.depth, worst.at[0], worst.at[1], worst.at[2], worst.length));
    return;
  }
  const auto& coarsening = run.scene.blank.coarsening;
  warnings.push_back(
      fmt::format("between nodes the fabric cuts {:.2g} mm deep through tool '{}' at ({:.4g}, {:.4g}, {:.4g}) mm: its "
                  "chords of {:.3g} "
                  "mm are longer than the radius there, {} {:.2g} mm; forces are 5 % off and more, set "
                  "blank.coarsening to {:.2g} or "
                  "less{}",
                  worst.depth, placed[worst.tool].tool.name, worst.at[0], worst.at[1], worst.at[2], worst.length,
                  worst.ratio() > edge ? "at most" : "about", worst.radius(),
                  std::max(coarsening[0], coarsening[1]) * longest / worst.ratio(),
                  worst.ratio() > edge ? " and see whether the tool has an edge that must be rounded" : ""));
}

}  // namespace weaveform
