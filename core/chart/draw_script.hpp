// The packed script that draws charts (core/chart/echarts/packed), embedded when the build is configured.
#pragma once

#include <string_view>

namespace weaveform {

[[nodiscard]] std::string_view draw_script();  // JavaScript for node

}  // namespace weaveform
