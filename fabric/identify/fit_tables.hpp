// Tables and charts of a fit: data, fit and band.
#pragma once

#include <string>

#include "core/chart/chart.hpp"
#include "fabric/identify/identify.hpp"

namespace weaveform::identify {

// A [[tensile]]: every point as measured and, in its elastic part, as the yarn would follow it in the fabric.
[[nodiscard]] std::string yarn_csv(const YarnFit& fit, double crimp);
[[nodiscard]] Chart yarn_chart(const YarnFit& fit, double crimp, double confidence);

// A shear fit on its grid. `load` says that the specimens' values are loads (bias extension), not stresses.
[[nodiscard]] std::string shear_csv(const ShearFit& fit, bool load);
[[nodiscard]] Chart shear_chart(const ShearFit& fit, const std::string& title, double confidence);
// Measured and fitted loads of a bias extension.
[[nodiscard]] Chart load_chart(const ShearFit& fit);

}  // namespace weaveform::identify
