// The choices of the settings of a comparison; docs/dic_settings.md says what each of them means.
#pragma once

#include "core/keys/choice.hpp"

namespace weaveform::dic {

// stages.match
enum class MatchBy { automatic, displacement, force, frame };
constexpr auto choices_of(MatchBy) {
  return std::to_array<Choice<MatchBy>>({{MatchBy::automatic, "auto"},
                                         {MatchBy::displacement, "displacement"},
                                         {MatchBy::force, "force"},
                                         {MatchBy::frame, "frame"}});
}

// registration.method
enum class RegistrationMethod { least_squares, marks, axes, none };
constexpr auto choices_of(RegistrationMethod) {
  return std::to_array<Choice<RegistrationMethod>>({{RegistrationMethod::least_squares, "least-squares"},
                                                    {RegistrationMethod::marks, "marks"},
                                                    {RegistrationMethod::axes, "axes"},
                                                    {RegistrationMethod::none, "none"}});
}

// registration.motion
enum class SpecimenMotion { fixed, free };
constexpr auto choices_of(SpecimenMotion) {
  return std::to_array<Choice<SpecimenMotion>>({{SpecimenMotion::fixed, "fixed"}, {SpecimenMotion::free, "free"}});
}

// comparison.symmetry
enum class FieldSymmetry { none, x, y, xy, rotation };
constexpr auto choices_of(FieldSymmetry) {
  return std::to_array<Choice<FieldSymmetry>>({{FieldSymmetry::none, "none"},
                                               {FieldSymmetry::x, "x"},
                                               {FieldSymmetry::y, "y"},
                                               {FieldSymmetry::xy, "xy"},
                                               {FieldSymmetry::rotation, "rotation"}});
}

// comparison.fields
enum class FieldsWritten { all, last, none };
constexpr auto choices_of(FieldsWritten) {
  return std::to_array<Choice<FieldsWritten>>(
      {{FieldsWritten::all, "all"}, {FieldsWritten::last, "last"}, {FieldsWritten::none, "none"}});
}

}  // namespace weaveform::dic
