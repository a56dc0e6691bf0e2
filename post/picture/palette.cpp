#include "post/picture/palette.hpp"

#include <vtkColorTransferFunction.h>
#include <vtkNew.h>

namespace weaveform {
namespace {

constexpr int shades = 256;

// sRGB of viridis at eighths.
constexpr std::array<std::array<double, 3>, 9> viridis = {{{0.267, 0.005, 0.329},
                                                           {0.279, 0.175, 0.483},
                                                           {0.230, 0.322, 0.546},
                                                           {0.173, 0.449, 0.558},
                                                           {0.128, 0.567, 0.551},
                                                           {0.158, 0.684, 0.502},
                                                           {0.369, 0.789, 0.383},
                                                           {0.678, 0.864, 0.190},
                                                           {0.993, 0.906, 0.144}}};

void one_sign(vtkColorTransferFunction& function) {
  function.SetColorSpaceToLab();
  for (std::size_t k = 0; k < viridis.size(); ++k)
    function.AddRGBPoint(static_cast<double>(k) / (viridis.size() - 1), viridis[k][0], viridis[k][1], viridis[k][2]);
}

void two_signs(vtkColorTransferFunction& function) {
  function.SetColorSpaceToDiverging();
  function.AddRGBPoint(0.0, 0.230, 0.299, 0.754);
  function.AddRGBPoint(1.0, 0.706, 0.016, 0.150);
}

}  // namespace

vtkSmartPointer<vtkLookupTable> colours(Palette palette, const std::array<double, 2>& range) {
  vtkNew<vtkColorTransferFunction> function;
  palette == Palette::one_sign ? one_sign(*function) : two_signs(*function);
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(shades);
  for (int k = 0; k < shades; ++k) {
    std::array<double, 3> colour{};
    function->GetColor(k / (shades - 1.0), colour.data());
    table->SetTableValue(k, colour[0], colour[1], colour[2], 1.0);
  }
  table->SetRange(range[0], range[1]);
  return table;
}

}  // namespace weaveform
