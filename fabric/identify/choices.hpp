// The choices of a fit file; docs/fit.md says what each of them means.
#pragma once

#include "core/keys/choice.hpp"

namespace weaveform::identify {

// shear.from
enum class ShearSource { automatic, shear_frame, bias_extension };
constexpr auto choices_of(ShearSource) {
  return std::to_array<Choice<ShearSource>>({{ShearSource::automatic, "auto"},
                                             {ShearSource::shear_frame, "shear_frame"},
                                             {ShearSource::bias_extension, "bias_extension"}});
}

// shear.form
enum class FormAsked { automatic, polynomial, polynomial_start };
constexpr auto choices_of(FormAsked) {
  return std::to_array<Choice<FormAsked>>({{FormAsked::automatic, "auto"},
                                           {FormAsked::polynomial, "polynomial"},
                                           {FormAsked::polynomial_start, "polynomial+start"}});
}

// tensile.yarn
enum class TestedYarn { warp, weft, both };
constexpr auto choices_of(TestedYarn) {
  return std::to_array<Choice<TestedYarn>>(
      {{TestedYarn::warp, "warp"}, {TestedYarn::weft, "weft"}, {TestedYarn::both, "both"}});
}

// tensile.strain
enum class StrainKind { true_strain, engineering };
constexpr auto choices_of(StrainKind) {
  return std::to_array<Choice<StrainKind>>(
      {{StrainKind::true_strain, "true"}, {StrainKind::engineering, "engineering"}});
}

// tensile.stress
enum class StressKind { true_stress, nominal };
constexpr auto choices_of(StressKind) {
  return std::to_array<Choice<StressKind>>({{StressKind::true_stress, "true"}, {StressKind::nominal, "nominal"}});
}

}  // namespace weaveform::identify
