#include "mesher/mesh/vtk_file.hpp"

#include <vtkErrorCode.h>
#include <vtkXMLWriter.h>

#include <cerrno>
#include <cstdlib>

#include "mesher/base/files.hpp"
#include "mesher/mesh/mesh_format.hpp"
#include "mesher/mesh/vtk_messages.hpp"

namespace weaveform {

void keep_vtk_in_one_thread() {
  // VTK 9.1 looks once, when it first divides work; its header for the same call is no C++20
  setenv("VTK_SMP_BACKEND_IN_USE", "Sequential", 0);
}

void write_vtk_whole(const std::filesystem::path& file, vtkXMLWriter& writer) {
  write_whole(file, [&](const std::filesystem::path& temporary) {
    keep_vtk_in_one_thread();
    const VtkMessages kept_off_the_terminal;
    // in place and as text, for meshio loses its way among raw bytes at the end; compressed it is smaller than these
    writer.SetDataModeToBinary();
    writer.SetCompressorTypeToZLib();
    writer.SetCompressionLevel(1);
    writer.SetHeaderTypeToUInt64();
    writer.SetFileName(temporary.c_str());
    errno = 0;
    const bool written = writer.Write() == 1 && mesh_format::ends_with_closing_tag(temporary);
    const unsigned long error = writer.GetErrorCode();
    if (error == vtkErrorCode::OutOfDiskSpaceError) throw_cannot_write(file, ENOSPC);
    if (!written || error != vtkErrorCode::NoError) throw_cannot_write(file, errno);
  });
}

}  // namespace weaveform
