#include "post/measure/frame_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "fabric/trellis/shear_frame.hpp"
#include "post/unit_cell/closed_form.hpp"

namespace weaveform {

namespace {

// Below it the load is so small that inertia and noise make any relative error.
constexpr double least_angle = 5.0 * std::numbers::pi / 180.0;

}  // namespace

FrameComparison compare_shear_frame(const Scene& scene, const std::vector<const Card*>& cards, const History& history) {
  const ShearFrame frame{scene.frame->length, scene.blank.size[0]};
  const std::vector<double> travel = history.values(scene.frame->grip + ".displacement_mm");
  const std::vector<double> load = history.values(scene.frame->grip + ".force_N");
  if (travel.empty()) throw InputError("history has no row; solve again");
  FrameComparison found;
  for (std::size_t k = 0; k < travel.size(); ++k) {
    found.angle = frame_shear_angle(frame, travel[k]);
    found.load = load[k];
    found.ideal_load = 0.0;
    for (const Card* card : cards)
      found.ideal_load += frame_load(frame, analytical_shear_force(*card, found.angle), found.angle);
    if (std::abs(found.angle) >= least_angle)
      found.worst_error = std::max(found.worst_error, std::abs(found.load / found.ideal_load - 1.0));
  }
  return found;
}

}  // namespace weaveform
