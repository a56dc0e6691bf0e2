// Moment-curvature laws in the shapes that the inner loops of bending are compiled for.
#pragma once

#include <memory>

#include "fabric/law/bending_law.hpp"
#include "solver/bending/long_law.hpp"
#include "solver/element/kernel_law.hpp"

namespace weaveform {

// The simplest shape that holds the law: up to 6 pieces (8 with those beyond finite ends) are short, up to 255 long.
// Throws InputError for more pieces than that, or a stiffness above degree 5. A law without pieces is constant: 0.
[[nodiscard]] MomentShape moment_shape(const TangentLaw& law);
// The same of a law out of the plane: of an odd one that of its half, else sided.
[[nodiscard]] MomentShape moment_shape(const BendingLaw& law);

// Zero for a law without pieces. For shapes no simpler than that of the law itself.
[[nodiscard]] GeneralLaw packed_moment(const TangentLaw& law);
[[nodiscard]] std::shared_ptr<const LongLaw> long_moment(const TangentLaw& law);
[[nodiscard]] std::shared_ptr<const SidedLaw> sided_moment(const BendingLaw& law);

}  // namespace weaveform
