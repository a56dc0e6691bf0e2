// Fibres break at a few hundredths of elastic strain, and a card's tension law is measured or meant to less than that.
// A yarn is beyond its card when it bears more than the card's law gives at valid_to (solver/ply/torn_yarns.hpp);
// one that is torn ended the run.
#include <fmt/format.h>

#include "post/trust/borders.hpp"
#include "solver/ply/torn_yarns.hpp"

namespace weaveform {

void warn_of_stretch_beyond_card(const FinishedRun& run, Warnings& warnings) {
  const YarnLimits limits = yarn_limits(run.card, run.scene.model);
  std::size_t beyond = 0;
  double greatest = 0.0;  // of the strain over its limit
  int most = 0;
  for (std::size_t e = 0; e < run.end.yarn_strain.size(); ++e) {
    const std::size_t family = run.mesh.yarns.family[e] == Family::warp ? 0 : 1;
    if (run.mesh.yarns.softening[e] == 0.0) continue;  // a tied free end, which bears nothing
    const double share = run.end.yarn_strain[e] / limits.valid_to[family];
    if (!(share > 1.0)) continue;
    ++beyond;
    if (share <= greatest) continue;
    greatest = share;
    most = static_cast<int>(e);
  }
  if (beyond == 0) return;
  const std::size_t family = run.mesh.yarns.family[most] == Family::warp ? 0 : 1;
  warnings.push_back(fmt::format(
      "{} of {} yarn elements bear more than the card's tension law is meant to hold to (true strain {:.3g}), the most "
      "{} with a strain of {:.3g}; fibres tear at {:.3g}: pull less, or give the card the valid_to of its tests",
      beyond, run.end.yarn_strain.size(), limits.valid_to[family], yarn_place(run.mesh, most),
      run.end.yarn_strain[most], limits.tearing[family]));
}

}  // namespace weaveform
