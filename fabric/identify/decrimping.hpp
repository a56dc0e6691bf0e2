// The tension law of a yarn in the fabric, from the modulus of the straight yarn and its crimp: what the paper calls
// the 4th-order extrapolation of the decrimping section (Table 2), worked out from its numbers.
#pragma once

#include <vector>

#include "fabric/law/tangent_law.hpp"

namespace weaveform::identify {

// A yarn longer than its fabric by the crimp ratio c would lie straight, yet unstretched, at the true strain
//   e0 = ln(1 + c) ,
// and from there on follow s = E (e - e0). The law starts at zero with s = a e^4 and joins that line at e1 in value
// and slope,
//   a e1^4 = E (e1 - e0) ,  4 a e1^3 = E   =>   e1 = 4/3 e0 ,  4 a = E / e1^3 ,
// so the tangent is C = 4 a e^3 below e1 and E above. With the paper's crimp ratios (2, 4.4, 0.8 %) e1 is 0.0264,
// 0.0574, 0.0106, and with its moduli 4 a is 1.07e9, 1.06e8, 1.68e10 MPa: the numbers of Table 2. Without crimp the law
// is E throughout. Modulus in MPa, > 0; crimp ratio >= 0.
[[nodiscard]] std::vector<TangentPiece> decrimping_law(double linear_modulus, double crimp);

}  // namespace weaveform::identify
