// The writers, one per format: each gives the whole file and adds to model.not_carried what its own format cannot say.
#pragma once

#include "mesher/exchange/export.hpp"
#include "mesher/exchange/gathered.hpp"

namespace weaveform::foreign {

[[nodiscard]] ExportedMesh write_abaqus(const Gathered& model);
[[nodiscard]] ExportedMesh write_calculix(const Gathered& model, bool is_static);
[[nodiscard]] ExportedMesh write_lsdyna(const Gathered& model, Materials materials);
[[nodiscard]] ExportedMesh write_openradioss(const Gathered& model, Materials materials, const std::string& run_name);
[[nodiscard]] ExportedMesh write_gmsh(const Gathered& model);

}  // namespace weaveform::foreign
