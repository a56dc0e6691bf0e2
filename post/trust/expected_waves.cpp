#include "post/trust/expected_waves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/keys/advice.hpp"
#include "post/forming/waves.hpp"
#include "solver/bending/flexure.hpp"

namespace weaveform {
namespace {

using std::numbers::pi;

// N mm; per width, of the softer direction.
double least_rigidity(const Resolved& ply) {
  const Flexure flexure = choose_flexure(ply.card, ply.scene);
  const double curvature = WrinkleLimits{}.curvature(ply.mesh.thickness);
  const auto secant = [&](std::size_t f) {
    return (flexure.out_of_plane[f].mean_secant(curvature) + flexure.shell[f].mean_secant(curvature)) /
           ply.card.yarn[f].interval;
  };
  return std::min(secant(0), secant(1));
}

// The ring that pulls most.
const ToolSpec* holding_ring(const Scene& scene) {
  const ToolSpec* most = nullptr;
  for (const ToolSpec& tool : scene.tools)
    if (tool.shape == ToolShape::ring && tool.force && tool.opening_radius &&
        (most == nullptr || *tool.force > *most->force))
      most = &tool;
  return most;
}

}  // namespace

std::optional<ExpectedWaves> expected_waves(const Resolved& ply) {
  const ToolSpec* ring = holding_ring(ply.scene);
  if (ring == nullptr || !has_bending(ply.scene.model)) return {};
  double friction = 0.0;
  for (const ToolSpec& tool : ply.scene.tools)
    if (tool.travel == 0.0 && !tool.force) friction = std::max(friction, tool.friction);
  ExpectedWaves waves{.rigidity = least_rigidity(ply), .span = *ring->opening_radius};
  waves.tension = (ring->friction + friction) * *ring->force / (2.0 * pi * waves.span);
  if (!(waves.tension > 0.0) || !(waves.rigidity > 0.0)) return {};
  waves.wavelength = 2.0 * std::sqrt(pi) * std::pow(waves.rigidity / waves.tension, 0.25) * std::sqrt(waves.span);
  waves.cells = waves.wavelength / std::max(ply.mesh.spacing[0], ply.mesh.spacing[1]);
  return waves;
}

std::vector<std::string> warnings_before(const Resolved& model) {
  std::vector<std::string> lines = early_warnings(model);
  for (std::size_t k = 0; k < model.plies(); ++k) {
    const Resolved& ply = model.of_ply(k);
    const auto waves = expected_waves(ply);
    if (!waves || waves->cells >= pi) continue;
    const auto& coarsening = ply.scene.blank.coarsening;
    lines.push_back(
        name_before(model, k) +
        fmt::format("if it wrinkles, then at about {:.2g} mm (rigidity {:.3g} N mm, pull {:.3g} N/mm over "
                    "{:.3g} mm), and {:.2g} cells show no such wave; set blank.coarsening to {:.2g} or less "
                    "for {:g} cells a wave",
                    waves->wavelength, waves->rigidity, waves->tension, waves->span, waves->cells,
                    rounded_down(std::max(coarsening[0], coarsening[1]) * waves->cells / least_cells_per_wave, 2),
                    least_cells_per_wave));
  }
  return lines;
}

}  // namespace weaveform
