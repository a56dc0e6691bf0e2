#include "mesher/exchange/export.hpp"

#include <array>

#include "core/error.hpp"
#include "mesher/exchange/writers.hpp"

namespace weaveform {

ExportedMesh export_mesh(MeshFormat format, const Scene& scene, const Card& card, const Mesh& mesh,
                         const std::vector<Tool>& tools, double duration, const std::string& written_by,
                         const ExportOptions& options) {
  if (options.is_static && format != MeshFormat::calculix)
    throw InputError("--static goes with --format calculix; the other formats write the motion over its duration");
  if (options.materials == Materials::user && (format == MeshFormat::calculix || format == MeshFormat::gmsh))
    throw InputError("--materials user goes with --format abaqus, lsdyna and openradioss");
  foreign::Gathered model = foreign::gather(scene, card, mesh, tools, duration, written_by);
  switch (format) {
    case MeshFormat::abaqus:
      return foreign::write_abaqus(model);
    case MeshFormat::calculix:
      return foreign::write_calculix(model, options.is_static);
    case MeshFormat::lsdyna:
      return foreign::write_lsdyna(model, options.materials);
    case MeshFormat::openradioss:
      return foreign::write_openradioss(model, options.materials, options.run_name);
    case MeshFormat::gmsh:
      break;
  }
  if (mesh.frame.present()) model.not_carried.push_back("shear frame: its members are not written");
  if (scene.analysis.gravity != std::array<double, 3>{0.0, 0.0, 0.0})
    model.not_carried.push_back("analysis.gravity is not written");
  return foreign::write_gmsh(model);
}

}  // namespace weaveform
