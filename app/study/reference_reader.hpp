// Reads [work_precision] of a study file and the tables below it.
#pragma once

#include "app/study/study_spec.hpp"

namespace weaveform::study {

// Adds study.work_precision and study.reference when the file has the table; everything wrong becomes a complaint. The
// axes and [convergence] are to be read before.
void read_work_precision(const toml::table& root, Study& study, Complaints& complaints);

}  // namespace weaveform::study
