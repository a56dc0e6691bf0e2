#include "mesher/tools/surface_file.hpp"

#include <algorithm>
#include <list>
#include <mutex>

#include "core/error.hpp"
#include "core/files/digest.hpp"
#include "core/files/files.hpp"
#include "core/files/text_words.hpp"
#include "mesher/tools/cad.hpp"
#include "mesher/tools/geo_script.hpp"
#include "mesher/tools/mesh_surface.hpp"
#include "mesher/tools/stl.hpp"

namespace weaveform {

namespace {

namespace fs = std::filesystem;

// The last few surfaces from CAD, found again by what the file holds. A run asks for each of its tools three times and
// more; the cases of a study do so at once.
class KnownSurfaces {
public:
  CadSurface find_or_read(const fs::path& file, double chord_tolerance) {
    if (geo_scripts_are_trusted()) return read_cad(file, chord_tolerance);  // such a script may look elsewhere as well
    Digest digest;
    digest.add(file.extension().string());
    digest.add(chord_tolerance);
    digest.add(read_text_file(file));
    const std::string key = digest.hex();
    const std::lock_guard<std::mutex> one_at_a_time(mutex_);
    const auto found = std::find_if(known_.begin(), known_.end(), [&](const Known& known) { return known.key == key; });
    if (found != known_.end()) {
      known_.splice(known_.begin(), known_, found);
      return known_.front().surface;
    }
    known_.push_front({key, read_cad(file, chord_tolerance)});
    constexpr std::size_t most = 8;
    if (known_.size() > most) known_.pop_back();
    return known_.front().surface;
  }

private:
  struct Known {
    std::string key;
    CadSurface surface;
  };
  std::mutex mutex_;
  std::list<Known> known_;  // the last asked for first
};

KnownSurfaces& known_surfaces() {
  static KnownSurfaces surfaces;
  return surfaces;
}

FileSurface of_mesh(const fs::path& file, const std::string& set) {
  MeshSurface surface = read_mesh_surface(file, set);
  return {std::move(surface.list), 0.0, std::move(surface.notes)};
}

FileSurface as_it_stands(const fs::path& file, const SurfaceRequest& request) {
  switch (surface_kind(file)) {
    case SurfaceKind::stl:
      return {read_stl(file), 0.0, {}};
    case SurfaceKind::mesh:
      return of_mesh(file, request.set);
    case SurfaceKind::cad:
      break;
  }
  CadSurface surface = known_surfaces().find_or_read(file, request.chord_tolerance / request.millimetres);
  return {std::move(surface.list), surface.chord_error, std::move(surface.words)};
}

}  // namespace

SurfaceKind surface_kind(const fs::path& file) {
  if (is_cad_file(file)) return SurfaceKind::cad;
  const std::string ending = lower(file.extension().string());
  return ending == ".inp" || ending == ".msh" ? SurfaceKind::mesh : SurfaceKind::stl;
}

FileSurface read_surface(const fs::path& file, const SurfaceRequest& request) {
  if (request.millimetres != 1.0 && names_its_unit(file))
    throw InputError(file.string() + ": STEP and IGES files name their unit and come in mm; leave `unit` out");
  FileSurface surface = as_it_stands(file, request);
  for (auto& point : surface.list.point)
    for (double& x : point) x *= request.millimetres;
  surface.chord_error *= request.millimetres;
  return surface;
}

}  // namespace weaveform
