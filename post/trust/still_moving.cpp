// Where nothing is moved, what is asked for is a state of rest; a run that ends before it is reached shows some other one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/keys/advice.hpp"
#include "post/trust/borders.hpp"

namespace weaveform {
namespace {

constexpr double last_part = 0.05;              // of the duration; a swing stands still at its ends
constexpr double greatest_moving_share = 0.01;  // kinetic energy over the internal
constexpr double greatest_way = 0.01;  // of the blank's longer side; at the speed of the end, in as long a time again

bool is_to_rest(const Scene& scene) {
  const auto moves = [](const auto& part) { return part.travel != 0.0; };
  return scene.analysis.perturbation == 0.0 && !scene.frame &&
         std::none_of(scene.grip.begin(), scene.grip.end(), moves) &&
         std::none_of(scene.tools.begin(), scene.tools.end(), moves);
}

}  // namespace

void warn_of_unrest(const FinishedRun& run, Warnings& warnings) {
  if (!is_to_rest(run.scene) || run.history.row.empty()) return;
  if (run.history.index("kinetic_energy_mJ") < 0 || run.history.index("internal_energy_mJ") < 0) return;
  const auto time = run.history.values("time_s"), energy = run.history.values("kinetic_energy_mJ"),
             stored = run.history.values("internal_energy_mJ");
  const double duration = time.back();
  double kinetic = 0.0;  // mJ
  for (std::size_t k = 0; k < time.size(); ++k)
    if (time[k] >= (1.0 - last_part) * duration) kinetic = std::max(kinetic, energy[k]);
  const auto& mass = run.mesh.nodes.mass;
  const double moved = run.scene.analysis.mass_scale * std::accumulate(mass.begin(), mass.end(), 0.0);  // tonne
  const double speed = std::sqrt(2.0 * kinetic / moved);                                                // mm/s; rms
  const double length = std::max(run.extent[0], run.extent[1]);
  const bool much_energy = kinetic > greatest_moving_share * stored.back() && kinetic > 0.0;
  const bool long_way = speed * duration > greatest_way * length;
  if (!much_energy && !long_way) return;
  warnings.push_back(fmt::format(
      "nothing is moved, but the fabric has not come to rest: at the end it still moves at {:.3g} mm/s, its kinetic "
      "energy {:.2g} % of the internal; places and loads are those of a moment. Set analysis.duration to more than "
      "{:.3g} s{}",
      speed, stored.back() > 0.0 ? 100.0 * kinetic / stored.back() : 100.0, duration,
      run.scene.analysis.damping ? ", or analysis.damping (now given) to that of the slowest sway" : ""));
}

}  // namespace weaveform
