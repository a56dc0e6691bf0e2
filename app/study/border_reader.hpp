// Reads [border] of a study file.
#pragma once

#include "app/study/study_spec.hpp"

namespace weaveform::study {

// Adds study.border when the file has the table; everything wrong becomes a complaint. The axes are to be read before.
void read_border(const toml::table& root, Study& study, Complaints& complaints);

}  // namespace weaveform::study
