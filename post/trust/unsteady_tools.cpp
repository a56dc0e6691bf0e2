// A binder that lags or swings holds the fabric with another force than the scene says.
#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "core/keys/advice.hpp"
#include "post/trust/borders.hpp"
#include "post/trust/pushed_tools.hpp"
#include "solver/contact/contact.hpp"

namespace weaveform {
namespace {

constexpr double border = 0.01;  // of the force; the binder's part of the punch force follows its force one to one

// tonne; of a tool that names none.
double free_tool_mass(const FinishedRun& run) {
  const auto& mass = run.mesh.nodes.mass;
  const double blank = run.scene.analysis.mass_scale * std::accumulate(mass.begin(), mass.end(), 0.0);
  return default_tool_mass(run.scene.analysis, blank);
}

}  // namespace

void warn_of_unsteady_tools(const FinishedRun& run, Warnings& warnings) {
  const double free_mass = free_tool_mass(run);
  for (const PushedTool& found : pushed_tools(run.scene, run.history, free_mass, border)) {
    if (found.off <= border) continue;
    const ToolSpec& spec = run.scene.tools[static_cast<std::size_t>(found.tool)];
    const double missing = std::abs(found.felt - *spec.force);
    const bool viscous = std::abs(found.viscous) > 0.5 * missing;
    const std::string advice =
        viscous
            ? fmt::format("the guide's damping takes {:.3g} N; set tools.{}.damping to {:.2g} 1/s or less (now {:.4g})",
                          std::abs(found.viscous), spec.name, rounded_down(spec.damping * border / found.off, 2),
                          spec.damping)
            : fmt::format(
                  "its inertia takes the rest; make tools.{0}.mass smaller (now {1:.3g} tonne), "
                  "tools.{0}.damping larger (now {2:.4g} 1/s) or the loading slower",
                  spec.name, spec.mass.value_or(free_mass), spec.damping);
    warnings.push_back(
        fmt::format("tool '{}' is pushed by {:.4g} N, but the fabric feels {:.4g} N at {:.4g} s, and is off by more "
                    "than {:.2g} % in "
                    "{:.2g} % of the time, out of touch in {:.2g} %: {}",
                    spec.name, *spec.force, found.felt, found.time, 100.0 * border, 100.0 * found.share_off,
                    100.0 * found.share_free, advice));
  }
}

}  // namespace weaveform
