// The charts of an evaluation: in files of their own beside the tables, and in the report.
#pragma once

#include "core/chart/chart.hpp"
#include "post/forming/forming.hpp"

namespace weaveform {

[[nodiscard]] Chart punch_chart(const PunchCurve& punch);
[[nodiscard]] Chart meridian_chart(const Forming& forming);
[[nodiscard]] Chart sphere_net_chart(const SphereNetFit& fit);

}  // namespace weaveform
