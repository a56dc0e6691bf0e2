// The inside of weaveform-opencascade.so: what opencascade.hpp names, and nothing else that is seen from outside.
#include "core/error.hpp"
#include "mesher/tools/cad_progress.hpp"
#include "mesher/tools/cad_shape.hpp"
#include "mesher/tools/opencascade.hpp"
#include "mesher/tools/shape_triangles.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

TopoDS_Shape sewn(const TopoDS_Shape& shape) {
  return sewn_where_open(shape, widest_gap * extent_of(shape));
}

CadSurface surface(CadFormat format, const fs::path& path, double chord_tolerance, const std::string& file) {
  CadShape read = read_shape(format, path);
  guard_signs().reading_is_done();
  CadSurface surface = triangles_of_shape(read.shape, chord_tolerance, file);
  surface.words.insert(surface.words.begin(), read.words.begin(), read.words.end());
  return surface;
}

bool rewrite(CadFormat format, const fs::path& path, CadFormat to, const fs::path& written) {
  const CadShape read = read_shape(format, path);
  guard_signs().reading_is_done();
  return write_shape(sewn(read.shape), to, written);
}

void pass_on(CadFormat format, const fs::path& path, const std::function<void(const void* shape)>& take) {
  const CadShape read = read_shape(format, path);
  const TopoDS_Shape whole = sewn(read.shape);
  take(&whole);
}

}  // namespace
}  // namespace weaveform

extern "C" [[gnu::visibility("default")]] const weaveform::OpenCascade* weaveform_opencascade_1(
    const weaveform::GuardSigns& signs) {
  weaveform::guard_signs() = signs;
  static constexpr weaveform::OpenCascade work = {
      .surface = weaveform::surface, .rewrite = weaveform::rewrite, .pass_on = weaveform::pass_on};
  return &work;
}
