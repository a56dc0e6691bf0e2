// VTK's XML files, written whole or not at all.
#pragma once

#include <filesystem>

class vtkXMLWriter;

namespace weaveform {

// Runs a VTK XML writer (its input already set) as appended raw binary. Throws FileError, with VTK's own messages kept
// off the terminal.
void write_vtk_whole(const std::filesystem::path& file, vtkXMLWriter& writer);

}  // namespace weaveform
