// What no sound state of a ply has.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "solver/ply/ply.hpp"

namespace weaveform {

std::string Ply::trouble(const std::function<std::string()>& advice, bool is_hasty) const {
  const std::string lost = lost_position(advice);
  return lost.empty() ? torn_yarn(advice, is_hasty) : lost;
}

std::string Ply::lost_position(const std::function<std::string()>& advice) const {
  for (int n = 0; n < mesh_.node_count(); ++n) {
    const int p = packed_.packed_of_mesh[n];
    if (!std::isfinite(state_.position[0][p] + state_.position[1][p] + state_.position[2][p]))
      return fmt::format("the position of node {} is not a number; {}", mesh_.shown_node(n), advice());
  }
  return "";
}

std::string Ply::torn_yarn(const std::function<std::string()>& advice, bool is_hasty) const {
  for (int e = 0; e < mesh_.yarn_count(); ++e) {
    double square = 0.0;
    for (int c = 0; c < 3; ++c) {
      const double d = state_.position[c][packed_.packed_of_mesh[mesh_.yarns.node[e][1]]] -
                       state_.position[c][packed_.packed_of_mesh[mesh_.yarns.node[e][0]]];
      square += d * d;
    }
    const double rest = mesh_.yarns.rest_length[e] + mesh_.yarns.jaw[e];
    const double strain = std::log((std::sqrt(square) + mesh_.yarns.jaw[e]) / rest);
    const bool bears = mesh_.yarns.softening[e] > 0.0;
    const double tearing = yarn_limits_.tearing[mesh_.yarns.family[e] == Family::warp ? 0 : 1];
    // a perturbed start may stretch yarns by its own size
    const double start = std::log1p(2.0 * std::numbers::sqrt2 * scene_.analysis.perturbation / rest);
    if (strain <= (bears ? tearing : torn_strain) + start) continue;
    if (strain > torn_strain + start)
      return fmt::format(
          "{} is stretched to a true strain of {:.3g}: the scene tears the fabric, or the analysis is unstable; {}",
          yarn_place(mesh_, e), strain, advice());
    return fmt::format(
        "{} is torn: its true strain is {:.3g}, and it bears what the card's yarns tear at ({:.3g}); pull the fabric "
        "less{}, or give the card its measured tearing_strain",
        yarn_place(mesh_, e), strain, tearing, is_hasty ? ", or " + advice() : "");
  }
  return "";
}

}  // namespace weaveform
