// Every key of a study file's own: one row each. The other keys of [set], [grid], [[paired]] and [[case]] are the
// scene's.
#pragma once

#include <vector>

#include "app/study/study_spec.hpp"
#include "core/keys/key_table.hpp"

namespace weaveform::study {

[[nodiscard]] const std::vector<Key<StudyHead>>& head_keys();
[[nodiscard]] const std::vector<Key<ConvergenceSpec>>& convergence_keys();
[[nodiscard]] const std::vector<Key<WorkPrecisionSpec>>& work_precision_keys();
[[nodiscard]] const std::vector<Key<BorderSpec>>& border_keys();
[[nodiscard]] const std::vector<Key<BorderCondition>>& condition_keys();

}  // namespace weaveform::study
