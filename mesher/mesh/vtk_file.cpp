#include "mesher/mesh/vtk_file.hpp"

#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkXMLWriter.h>

#include <cerrno>
#include <cstdlib>

#include "core/files/files.hpp"
#include "mesher/mesh/quick_base64.hpp"
#include "mesher/mesh/quick_compressor.hpp"
#include "mesher/mesh/vtk_messages.hpp"

namespace weaveform {
namespace {

// Where VTK's writers keep what makes text of numbers, which they show to kin only.
struct NumbersOf : vtkXMLWriter {
  static void go_through(vtkXMLWriter& writer, vtkOutputStream* stream) { (writer.*&NumbersOf::SetDataStream)(stream); }
};

}  // namespace

void keep_vtk_in_one_thread() {
  // VTK 9.1 looks once, when it first divides work; its header for the same call is no C++20
  setenv("VTK_SMP_BACKEND_IN_USE", "Sequential", 0);
}

// VTK writes to memory, for its writer does not survive a full disk in every encoding.
void write_vtk_whole(const std::filesystem::path& file, vtkXMLWriter& writer) {
  keep_vtk_in_one_thread();
  {
    const VtkMessages kept_off_the_terminal;
    // in place and as text, for meshio loses its way among raw bytes at the end; compressed it is smaller than these
    writer.SetDataModeToBinary();
    writer.SetCompressor(vtkNew<QuickCompressor>());
    NumbersOf::go_through(writer, vtkNew<QuickBase64>());
    writer.SetHeaderTypeToUInt64();
    writer.WriteToOutputStringOn();
    if (writer.Write() != 1 || writer.GetErrorCode() != vtkErrorCode::NoError) throw_cannot_write(file, ENOMEM);
  }
  write_text_whole(file, writer.GetOutputString());
}

}  // namespace weaveform
