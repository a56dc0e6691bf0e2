// A step a little above the stable one makes energy without blowing up: viscosity takes what each step makes, loads and
// angles look right, and the energy balance is the first to tell, long before the run's own limit
// (analysis.energy_limit) ends it. Sound runs of the examples stay below 0.7 %, most below 0.2 %; at the border of the
// step (docs/stability.md) the error goes from below 0.3 % to above 1 % within a hundredth of the step.
#include <fmt/format.h>

#include <string>

#include "post/trust/borders.hpp"
#include "solver/analysis/loading.hpp"

namespace weaveform {
namespace {

constexpr double sound_error = 0.01;  // 1; of the greatest energy

}  // namespace

void warn_of_energy_error(const FinishedRun& run, Warnings& warnings) {
  const double error = run.summary.statistics.energy_error;
  if (error <= sound_error) return;
  const double chosen = automatic_duration(run.scene, run.card, run.extent),
               duration = run.summary.statistics.duration_s;
  const std::string advice =
      duration < hasty_share * chosen
          ? fmt::format("load more slowly: analysis.duration is {:.3g} s, and {:.3g} s would be chosen for this scene",
                        duration, chosen)
          : fmt::format(
                "lower analysis.step_factor (now {:g}); if that changes nothing, load more slowly (analysis.duration)",
                run.scene.analysis.step_factor);
  warnings.push_back(
      fmt::format("the energy balance is off by {:.3g} % at worst, where sound runs stay below {:g} %: {}",
                  100.0 * error, 100.0 * sound_error, advice));
}

}  // namespace weaveform
