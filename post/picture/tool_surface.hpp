// The tools of a scene as surfaces to be drawn; those that go on for ever end where the fabric cannot get to.
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "mesher/resolve/resolved.hpp"

namespace weaveform {

// In the scene's order, where they stand at the start (mm).
[[nodiscard]] std::vector<vtkSmartPointer<vtkPolyData>> tool_surfaces(const Resolved& model);

}  // namespace weaveform
