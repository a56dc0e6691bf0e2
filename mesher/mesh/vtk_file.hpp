// VTK's XML files, written whole or not at all.
#pragma once

#include <filesystem>

class vtkXMLWriter;

namespace weaveform {

// From here on VTK starts no threads: a process that has some must not be forked for a guarded reading (guarded.hpp),
// for what they hold at that moment, such as a lock of the memory's allocator, nobody releases in the child.
void keep_vtk_in_one_thread();

// Runs a VTK XML writer (its input already set): numbers exact, in place, base64 of zlib blocks, which VTK, ParaView
// and meshio read. For meshio no array may be empty, and none hold texts. Throws FileError, with VTK's own messages
// kept off the terminal.
void write_vtk_whole(const std::filesystem::path& file, vtkXMLWriter& writer);

}  // namespace weaveform
