// The packed viewer (post/report/viewer/packed), embedded when the build is configured.
#pragma once

#include <string_view>

namespace weaveform {

[[nodiscard]] std::string_view viewer_script();  // JavaScript
[[nodiscard]] std::string_view viewer_styles();  // CSS

}  // namespace weaveform
