// One geometry file open in the Gmsh SDK. Gmsh is one global state: set up for one file, gone after it. Everything here
// happens in a guarded child process (mesher/base/guarded.hpp), for what reads the files does not survive damaged ones.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace weaveform {

// By its ending, in capital or small letters.
enum class CadFormat { none, step, iges, brep, script };
[[nodiscard]] CadFormat cad_format(const std::filesystem::path& file);

// Runs `work` on the open file in a child process and gives back the bytes it makes. Lengths are in mm. A script is
// looked at first (geo_script.hpp). With a `writable_folder` the child may write files there. Throws FileError when the
// file cannot be read, InputError when Gmsh makes nothing of it, with Gmsh's own words where it has any.
[[nodiscard]] std::string with_gmsh(const std::filesystem::path& file, const std::function<std::string()>& work,
                                    const std::filesystem::path& writable_folder = {});

}  // namespace weaveform
