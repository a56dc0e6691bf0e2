// Registration by the displacement field: the rotation and shift for which the measured displacements agree best with
// the simulated ones, robustly. Several starts (quarter turns and shifts) are tried, so that no first guess is needed.
#pragma once

#include "post/dic/registration/placement.hpp"

namespace weaveform::dic {

[[nodiscard]] Placement match_field(const MeasuredStage& stage, const Simulation& simulation,
                                    const SimulatedState& state, const RegistrationSpec& spec, double facet_size);

// Standard deviation of one component of two-dimensional normal residuals, from the median of their lengths: that is
// 1.1774 standard deviations (Rayleigh). Outliers below one half do not move it far.
[[nodiscard]] double robust_deviation(std::vector<double> length);

}  // namespace weaveform::dic
