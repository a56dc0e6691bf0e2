// One geometry file open in OpenCASCADE or the Gmsh SDK. Gmsh is one global state: set up for one file, gone after it.
// Everything here happens in a guarded child process (core/guard/guarded.hpp), for what reads the files does not
// survive damaged ones.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace weaveform {

// By its ending, in capital or small letters.
enum class CadFormat { none, step, iges, brep, script };
[[nodiscard]] CadFormat cad_format(const std::filesystem::path& file);

// Runs `work` in a child process and gives back the bytes it makes. `path` is where to read the file there: a script is
// looked at first (geo_script.hpp) and read from memory. With a `writable_folder` the child may write files there.
// Throws FileError when the file cannot be read, InputError as `work` does or when the child ends.
using CadWork = std::function<std::string(CadFormat format, const std::string& path)>;
[[nodiscard]] std::string with_cad_file(const std::filesystem::path& file, const CadWork& work,
                                        const std::filesystem::path& writable_folder = {});

// In the child: runs `work` with the file open in Gmsh, lengths in mm. Throws InputError when Gmsh makes nothing of it,
// with Gmsh's own words where it has any; they name `file`.
[[nodiscard]] std::string open_gmsh(CadFormat format, const std::string& path, const std::filesystem::path& file,
                                    const std::function<std::string()>& work);

// Both in one.
[[nodiscard]] std::string with_gmsh(const std::filesystem::path& file, const std::function<std::string()>& work,
                                    const std::filesystem::path& writable_folder = {});

// Who is told, about ten times a second and with 1 at the end, how much of the reading of a file is done (0 to 1); a
// setting of the whole process, made once by the program before anything is read. May not throw. Nobody at first.
using CadWatcher = std::function<void(const std::filesystem::path& file, double fraction)>;
void watch_cad_reading(CadWatcher watch);

}  // namespace weaveform
