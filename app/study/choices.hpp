// The choices of a study file; docs/study.md says what each of them means.
#pragma once

#include "core/keys/choice.hpp"

namespace weaveform::study {

// convergence.finer
enum class Finer { smaller, larger };
constexpr auto choices_of(Finer) {
  return std::to_array<Choice<Finer>>({{Finer::smaller, "smaller"}, {Finer::larger, "larger"}});
}

// work_precision.reference: of the errors.
enum class ErrorReference { limit, one_case, value };
constexpr auto choices_of(ErrorReference) {
  return std::to_array<Choice<ErrorReference>>(
      {{ErrorReference::limit, "limit"}, {ErrorReference::one_case, "case"}, {ErrorReference::value, "value"}});
}

// border.scale
enum class BisectionScale { linear, logarithmic };
constexpr auto choices_of(BisectionScale) {
  return std::to_array<Choice<BisectionScale>>(
      {{BisectionScale::linear, "linear"}, {BisectionScale::logarithmic, "logarithmic"}});
}

}  // namespace weaveform::study
