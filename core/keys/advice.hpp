// Numbers in advice. Printed with few digits, a bound must stay on its good side: who follows the advice is not refused
// again.
#pragma once

namespace weaveform {

// The least number of `digits` significant digits that is not below `value`, and the greatest that is not above it. For
// fmt's {:.Ng} with the same N. Not a number and 0 are given back.
[[nodiscard]] double rounded_up(double value, int digits);
[[nodiscard]] double rounded_down(double value, int digits);

}  // namespace weaveform
