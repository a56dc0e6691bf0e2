#include "mesher/export/export.hpp"

#include "mesher/export/writers.hpp"

namespace weaveform {

ExportedMesh export_mesh(MeshFormat format, const Scene& scene, const Card& card, const Mesh& mesh, double duration,
                         const std::string& written_by) {
  const foreign::Gathered model = foreign::gather(scene, card, mesh, duration, written_by);
  switch (format) {
    case MeshFormat::abaqus:
      return foreign::write_abaqus(model);
    case MeshFormat::lsdyna:
      return foreign::write_lsdyna(model);
    case MeshFormat::openradioss:
      return foreign::write_openradioss(model);
    case MeshFormat::gmsh:
      break;
  }
  return foreign::write_gmsh(model);
}

}  // namespace weaveform
