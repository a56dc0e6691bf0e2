// VTK reports trouble on the terminal; we report it once, in our own words.
#pragma once

#include <vtkSmartPointer.h>

class vtkOutputWindow;

namespace weaveform {

// While it lives, VTK's errors and warnings are counted instead of printed.
class VtkMessages {
public:
  VtkMessages();
  ~VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;
  [[nodiscard]] int count() const;

private:
  vtkSmartPointer<vtkOutputWindow> before_;
  vtkSmartPointer<vtkOutputWindow> counter_;
  int verbosity_before_;
};

}  // namespace weaveform
