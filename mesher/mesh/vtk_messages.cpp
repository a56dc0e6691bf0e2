#include "mesher/mesh/vtk_messages.hpp"

#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

namespace weaveform {

namespace {

class CountingWindow : public vtkOutputWindow {
public:
  static CountingWindow* New();
  void DisplayText(const char*) override {}
  void DisplayErrorText(const char*) override { ++count; }
  void DisplayWarningText(const char*) override { ++count; }
  int count = 0;
};
vtkStandardNewMacro(CountingWindow);

}  // namespace

// VTK sends each message two ways, to its output window and to its logger.
VtkMessages::VtkMessages()
    : before_(vtkOutputWindow::GetInstance()),
      counter_(vtk::TakeSmartPointer(CountingWindow::New())),
      verbosity_before_(vtkLogger::GetCurrentVerbosityCutoff()) {
  vtkOutputWindow::SetInstance(counter_);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

VtkMessages::~VtkMessages() {
  vtkLogger::SetStderrVerbosity(static_cast<vtkLogger::Verbosity>(verbosity_before_));
  vtkOutputWindow::SetInstance(before_);
}

int VtkMessages::count() const {
  return static_cast<const CountingWindow*>(counter_.Get())->count;
}

}  // namespace weaveform
