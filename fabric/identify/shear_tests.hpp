// Shear-frame and bias-extension tests as observations of the shear law.
#pragma once

#include <filesystem>
#include <vector>

#include "fabric/identify/fit_spec.hpp"
#include "fabric/identify/shear_fit.hpp"

namespace weaveform::identify {

// Eqs. 12 and 13 on every specimen of every test, F_sh over the thickness as stress (Eq. 5), fitted as [shear] says.
[[nodiscard]] ShearFit fit_shear_frames(const FitSpec& spec);

// Eq. 14 for the angle and the balance of power over the three zones for the load (fabric/trellis/bias_rectangle.hpp),
// which is linear in the stress at the angle and at half of it: the law follows from the loads by the same least
// squares. It is the law of pinned yarns that would give these loads; yarns that slip, or decrimp, are in it without
// being said.
[[nodiscard]] ShearFit fit_bias_extensions(const FitSpec& spec);

}  // namespace weaveform::identify
