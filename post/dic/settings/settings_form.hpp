// A settings file to be filled in: every key with its meaning, unit, range and default; what is asked stands out.
#pragma once

#include <string>

#include "post/dic/readers/question.hpp"
#include "post/dic/settings/settings.hpp"

namespace weaveform::dic {

// Values that differ from their defaults are written, all other keys stand behind '#'; a question stands above its key,
// with "ANSWER" in it to search for. read_settings reads the text as it is. Lists of tables are shown as examples.
[[nodiscard]] std::string settings_form(const Settings& settings, const Questions& questions);

}  // namespace weaveform::dic
