// How stiff the fabric is through its thickness where rigid tools press it (N/mm^3, pressure over depth).
//
// Contact as stiff as the step allows, k = omega^2 m, grows with 1/h^2 as cells shrink (per area, at the default step:
// 1.2 N/mm^3 for cells of 10 mm of the plain weave). No fabric does, and where bending is borne by contact alone it
// matters: at the entry of a clamp, between die and binder, the sheet is flat and on the fillet it has the curvature 1/R, so
// that Kirchhoff's moment jumps by D/R per width. A clamp of stiffness k per area bears it by pressures over the length of
// a beam on an elastic foundation, (4 D/k)^(1/4) (Hetenyi 1946, "Beams on Elastic Foundation"); one that is rigid by two
// line loads a cell apart, P = D/(R h), and friction on them has no limit.
#pragma once

#include "fabric/card/card.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

// N/mm^3; of a card that does not say, where the step would allow more.
inline constexpr double usual_thickness_stiffness = 5.0;

// 1/s; omega of the springs to rigid tools, for a fabric whose own stable step is `fabric_step` (s). The card's
// stiffness as it stands, though the step be shortened for it; but not more than a factor that the scene gives
// (analysis.contact_stiffness) allows. Of a card that is silent: the scene's factor, if it gives one, else what
// contact_frequency gives by itself, but not more than the usual stiffness. Springs go by mass, which is area but at edges, where free yarn ends weigh too.
[[nodiscard]] double tool_contact_frequency(const AnalysisSpec& analysis, const Card& card, double fabric_step);

}  // namespace weaveform
