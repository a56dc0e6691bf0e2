// Nodes alone touch tools: where chords are long against a tool's radius, fabric is dragged over a polygon instead.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "core/keys/advice.hpp"
#include "mesher/automatic/mesh_rules.hpp"
#include "mesher/scene/taken.hpp"
#include "post/trust/borders.hpp"
#include "post/trust/chords.hpp"

namespace weaveform {
namespace {

// L/R. A chain of chords over a quarter turn with friction 0.3 is 5 % off by its formula at 0.96; hemispheres drawn
// through fillets of 15, 20 and 30 mm left the force of fine chords by 5 % at 1.4, 1.1 and 0.86 (docs/stability.md).
constexpr double longest = 0.8;
// With contact that knows the curve hemispheres left that force by 4 % at 1.3, by 10 % at 1.65 (docs/contact.md).
constexpr double longest_curved = 1.3;
// A chord's radius is told from its depth and length, both changed by what the fabric stretches and sinks in.
constexpr double room = 1.1;
constexpr double edge = 1.5;  // L/R; a chord that bends so much may lie on an edge of no radius at all

std::string place(const CutChord& chord) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) mm", chord.at[0], chord.at[1], chord.at[2]);
}

}  // namespace

double longest_chord(const Scene& scene) {
  const bool curved = scene.analysis.curved_contact;
  const double usual = curved ? longest_curved : longest;
  if (find_taken(scene, "blank.coarsening") == nullptr) return usual;
  const AccuracySpec wanted = scene.accuracy.value_or(AccuracySpec{});
  return std::min(usual, room * longest_chord_ratio(forming_errors(curved), wanted));
}

void warn_of_coarse_on_tools(const FinishedRun& run, Warnings& warnings) {
  if (run.scene.tools.empty()) return;
  const auto placed = place_tools(run.tools, run.history, run.end.time);
  const bool curved = run.scene.analysis.curved_contact;
  const CutChord worst = worst_chord(run.mesh, run.end.position, placed, curved);
  const double border = longest_chord(run.scene);
  if (worst.ratio() <= border) return;
  const std::string& tool = placed[worst.tool].tool.name;
  if (worst.unnoticed) {
    warnings.push_back(
        fmt::format("tool '{}' pokes {:.2g} mm deep through the fabric between nodes at {}, none of which touches it, "
                    "so that it feels nothing; make blank.coarsening smaller: chords are {:.3g} mm",
                    tool, worst.depth, place(worst), worst.length));
    return;
  }
  const bool sharp = worst.ratio() > edge;
  const std::string beyond =
      find_taken(run.scene, "blank.coarsening") == nullptr
          ? "forces are 5 % off or more"
          : fmt::format("the accuracy that blank.coarsening was taken for is lost ({:.3g} % of force, {:.3g} deg)",
                        100.0 * run.scene.accuracy.value_or(AccuracySpec{}).force,
                        run.scene.accuracy.value_or(AccuracySpec{}).angle);
  const auto& coarsening = run.scene.blank.coarsening;
  warnings.push_back(fmt::format(
      "chords of {:.3g} mm cut {:.2g} mm off tool '{}' at {}, whose radius there is {} {:.2g} mm: beyond {:.2g} of it "
      "{}; set blank.coarsening to {:.2g} or less{}",
      worst.length, worst.depth, tool, place(worst), sharp ? "at most" : "about", worst.radius(), border, beyond,
      rounded_down(std::max(coarsening[0], coarsening[1]) * border / worst.ratio(), 2),
      sharp ? ", or round the edge" : ""));
}

}  // namespace weaveform
