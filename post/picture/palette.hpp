// Colours of fields: even to the eye and told apart by the colour-blind.
#pragma once

#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

#include <array>

namespace weaveform {

// Of what has one sign: dark to bright (viridis; Smith and van der Walt 2015). Of what has two, the range then about 0:
// blue over white to red (Moreland 2009).
enum class Palette { one_sign, two_signs };

[[nodiscard]] vtkSmartPointer<vtkLookupTable> colours(Palette palette, const std::array<double, 2>& range);

}  // namespace weaveform
