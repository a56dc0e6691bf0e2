// Output files are written whole or not at all: under a temporary name in the same folder, then renamed over the old
// one. A reader therefore never meets half a file, and a full disk leaves the last good one in place.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

class vtkXMLWriter;

namespace weaveform {

// Calls write(temporary) and renames what it left there to `file`; when write throws, the temporary file is removed and
// the exception passes on. Throws FileError when the folder cannot be made or the file cannot be renamed.
void write_whole(const std::filesystem::path& file,
                 const std::function<void(const std::filesystem::path& temporary)>& write);

// The text becomes the file's whole content. Throws FileError.
void write_text_whole(const std::filesystem::path& file, std::string_view text);

// Runs a VTK XML writer (its input already set) as appended raw binary. Throws FileError, with VTK's own messages kept
// off the terminal.
void write_vtk_whole(const std::filesystem::path& file, vtkXMLWriter& writer);

// The whole content of a text file. Throws FileError.
[[nodiscard]] std::string read_text(const std::filesystem::path& file);

}  // namespace weaveform
