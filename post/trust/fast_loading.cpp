// Loads of a fabric are small, and inertia shows in them long before it shows in the energies.
#include <fmt/format.h>

#include <cmath>

#include "core/keys/advice.hpp"
#include "post/trust/borders.hpp"
#include "post/trust/inertia.hpp"

namespace weaveform {
namespace {

// Means of the loads over the same part of the way are off by this to 1.4 times as much (friction on a rounded edge
// multiplies it); docs/stability.md has the measurements.
constexpr double usual_share = 0.02;

}  // namespace

double greatest_inertia(const Scene& scene) {
  return scene.analysis.inertia.value_or(usual_share);
}

void warn_of_fast_loading(const FinishedRun& run, Warnings& warnings) {
  if (run.history.index("kinetic_energy_mJ") < 0) return;  // a history that another program wrote
  const SolveStatistics& solved = run.summary.statistics;
  const InertiaShare inertia = inertia_share(run.scene, run.history, solved.damping_per_s);
  const double share = std::abs(inertia.share), greatest_share = greatest_inertia(run.scene);
  if (share <= greatest_share) return;
  warnings.push_back(fmt::format(
      "inertia and damping are {:.2g} % of the loads between {:.4g} and {:.4g} s (limit {:.2g} %): they go with the "
      "square of the speed; set analysis.duration to {:.2g} s or more (now {:.4g})",
      100.0 * share, inertia.from, inertia.to, 100.0 * greatest_share,
      rounded_up(solved.duration_s * std::sqrt(share / greatest_share), 2), solved.duration_s));
}

}  // namespace weaveform
