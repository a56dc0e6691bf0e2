// Whether a method holds in a case that has ended, by the conditions of [border].
#pragma once

#include <filesystem>
#include <string>

#include "app/study/case_files.hpp"
#include "app/study/study_spec.hpp"

namespace weaveform::study {

struct Judgement {
  bool holds = false;
  std::string reason;         // why it does not: "exit code 3: ...", "energy_error is 0.02, not at most 0.01"
  std::string caught = "no";  // whether the run itself said so: "error" (exit code 3), "warning", "no"
};

// `holds_results`: the result folder at the group's `holds` end, for conditions relative to it. A case that failed, or
// crashed, does not hold; exit codes 2 and 4 are none of the method's failures and not to be judged. Throws InputError,
// at the condition's place, for a measure that the case does not have; FileError.
[[nodiscard]] Judgement judge(const Study& study, const Outcome& outcome, const std::filesystem::path& results,
                              const std::filesystem::path& holds_results);

// Whether a condition is relative to the case at the `holds` end.
[[nodiscard]] bool needs_holds_end(const BorderSpec& spec);

}  // namespace weaveform::study
