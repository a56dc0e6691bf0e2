// The page itself: one HTML file with viewer and data in it, which opens without any network.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace weaveform {

// `data` as post/report/viewer/README.md says; its "title" is the page's.
[[nodiscard]] std::string report_page(const nlohmann::ordered_json& data);

// The page's first line begins so, by which a report is known as ours.
inline constexpr const char* report_mark = "<!DOCTYPE html><!-- Written by weaveform";

}  // namespace weaveform
