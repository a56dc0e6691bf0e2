// Tools from CAD as triangles within a chord tolerance of the true surface: OpenCASCADE reads and cuts, Gmsh runs its
// scripts. Files are read in a child process with limits of time and memory; scripts are taken as data
// (gmsh_session.hpp, geo_script.hpp).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesher/tools/triangles.hpp"

namespace weaveform {

// By its ending, in any case of letters: .step .stp .iges .igs .brep .brp .geo (Gmsh script).
[[nodiscard]] bool is_cad_file(const std::filesystem::path& file);

// STEP and IGES.
[[nodiscard]] bool names_its_unit(const std::filesystem::path& file);

struct CadSurface {
  TriangleList list;               // faces as the file orients them
  double chord_error = 0.0;        // mm; greatest distance found from a triangle's sides and centre to the true surface
  std::vector<std::string> words;  // what the reader complained of and passed over, with its place in the file
};

// All surfaces of the file, in mm (STEP and IGES name their units, which are converted; BREP and .geo are taken as mm).
// Sides are as long as the sagitta allows: a flat face has few triangles, whatever lies beside it; they are made finer
// until the measured error is within `chord_tolerance` (mm). Throws FileError when the file cannot be read, InputError
// when it holds no surface or the tolerance is not reached, with the reader's own words.
[[nodiscard]] CadSurface read_cad(const std::filesystem::path& file, double chord_tolerance);

// The same geometry in another format, by the ending of `to` (.step, .brep). Throws FileError.
void convert_cad(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace weaveform
