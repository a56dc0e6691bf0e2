// STEP, IGES and BREP files as shapes of OpenCASCADE. In a guarded child only (core/guard/guarded.hpp).
#pragma once

#include <TopoDS_Shape.hxx>
#include <filesystem>
#include <string>
#include <vector>

#include "mesher/tools/gmsh_session.hpp"

namespace weaveform {

struct CadShape {
  TopoDS_Shape shape;              // lengths in mm: STEP and IGES name their unit, BREP is taken as mm
  std::vector<std::string> words;  // what OpenCASCADE complained of, with its place in the file; a few at most
};

// `format` says what the file is, whatever its name. Throws InputError with OpenCASCADE's words when nothing comes of
// it.
[[nodiscard]] CadShape read_shape(CadFormat format, const std::filesystem::path& file);

// As STEP (in mm) or BREP. False when OpenCASCADE cannot.
[[nodiscard]] bool write_shape(const TopoDS_Shape& shape, CadFormat format, const std::filesystem::path& file);

}  // namespace weaveform
