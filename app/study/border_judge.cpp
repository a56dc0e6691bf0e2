#include "app/study/border_judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/study/measure.hpp"
#include "core/error.hpp"

namespace weaveform::study {

namespace fs = std::filesystem;

namespace {

// A measure by name; a complaint about it points to the condition.
class Measured {
public:
  Measured(const Study& study, const BorderCondition& condition) : study_(study), condition_(condition) {}
  [[nodiscard]] double value(const fs::path& results, const std::string& name) const {
    try {
      return measure(results, name);
    } catch (const InputError& error) {
      Complaints complaints(study_.file.string());
      complaints.add(condition_.where, error.what());
      complaints.throw_if_any();
      throw;
    }
  }

private:
  const Study& study_;
  const BorderCondition& condition_;
};

// Comparisons are written so that a value which is not a number meets none.
std::string unmet(const Study& study, const BorderCondition& condition, const fs::path& results,
                  const fs::path& holds_results) {
  if (condition.no_warnings) {
    const auto warnings = warnings_of(results);
    if (!warnings.empty()) return "warning: " + warnings.front();
  }
  if (condition.measure.empty()) return "";
  const Measured one(study, condition);
  const double value = one.value(results, condition.measure);
  const std::string is = fmt::format("{} is {:.6g}, not ", condition.measure, value);
  if (condition.at_most.value && !(value <= *condition.at_most.value))
    return is + fmt::format("at most {:g}", *condition.at_most.value);
  if (condition.at_least.value && !(value >= *condition.at_least.value))
    return is + fmt::format("at least {:g}", *condition.at_least.value);
  if (!condition.within.value) return "";
  const std::string& name = condition.of.name;
  const double of = condition.of.number    ? *condition.of.number
                    : name == at_holds_end ? one.value(holds_results, condition.measure)
                                           : one.value(results, name);
  if (std::abs(value - of) <= *condition.within.value * std::abs(of)) return "";
  return is + fmt::format("within {:g} % of {:.6g}", 100.0 * *condition.within.value, of);
}

}  // namespace

bool needs_holds_end(const BorderSpec& spec) {
  return std::any_of(spec.condition.begin(), spec.condition.end(),
                     [](const BorderCondition& condition) { return condition.of.name == at_holds_end; });
}

Judgement judge(const Study& study, const Outcome& outcome, const fs::path& results, const fs::path& holds_results) {
  if (outcome.exit_code != static_cast<int>(ExitCode::done)) {
    const bool said = outcome.exit_code == static_cast<int>(ExitCode::physics);
    return {false, fmt::format("exit code {}: {}", outcome.exit_code, outcome.error), said ? "error" : "no"};
  }
  Judgement judgement{true, "", warnings_of(results).empty() ? "no" : "warning"};
  for (const BorderCondition& condition : study.border->condition) {
    judgement.reason = unmet(study, condition, results, holds_results);
    judgement.holds = judgement.reason.empty();
    if (!judgement.holds) return judgement;
  }
  return judgement;
}

}  // namespace weaveform::study
