// The value of a place where nothing was measured or can be said: fields, tables and charts leave it out.
#pragma once

#include <limits>

namespace weaveform {

inline constexpr double missing = std::numeric_limits<double>::quiet_NaN();

}  // namespace weaveform
