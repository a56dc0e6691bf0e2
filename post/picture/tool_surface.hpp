// The tools of a scene as surfaces to be drawn.
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "post/forming/tools_near.hpp"

namespace weaveform {

// In the same order, where they stand at the start (mm).
[[nodiscard]] std::vector<vtkSmartPointer<vtkPolyData>> tool_surfaces(const std::vector<NearTool>& tools);

}  // namespace weaveform
