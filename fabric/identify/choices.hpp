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

// shear.method
enum class ShearMethod { closed_form, simulation };
constexpr auto choices_of(ShearMethod) {
  return std::to_array<Choice<ShearMethod>>(
      {{ShearMethod::closed_form, "closed_form"}, {ShearMethod::simulation, "simulation"}});
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

// bending_law.from
enum class BendingSource { automatic, moment_curvature, cantilever, peirce };
constexpr auto choices_of(BendingSource) {
  return std::to_array<Choice<BendingSource>>({{BendingSource::automatic, "auto"},
                                               {BendingSource::moment_curvature, "moment_curvature"},
                                               {BendingSource::cantilever, "cantilever"},
                                               {BendingSource::peirce, "peirce"}});
}

// direction of moment_curvature, cantilever and peirce
enum class TestedDirection { both, warp, weft };
constexpr auto choices_of(TestedDirection) {
  return std::to_array<Choice<TestedDirection>>(
      {{TestedDirection::both, "both"}, {TestedDirection::warp, "warp"}, {TestedDirection::weft, "weft"}});
}

// sense of moment_curvature and cantilever
enum class BentSense { both, face, back };
constexpr auto choices_of(BentSense) {
  return std::to_array<Choice<BentSense>>(
      {{BentSense::both, "both"}, {BentSense::face, "face"}, {BentSense::back, "back"}});
}

}  // namespace weaveform::identify
