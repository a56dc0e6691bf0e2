#include "mesher/tools/cad.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <system_error>
#include <unordered_map>

#include "mesher/base/bytes.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/files.hpp"
#include "mesher/tools/gmsh_session.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

constexpr double first_per_turn = 16.0;    // triangles around a full circle, to begin with
constexpr double greatest_per_turn = 400;  // a tolerance that wants more is a slip of the pen

using Point = std::array<double, 3>;

// Greatest distance of the sides' midpoints and centres of a face's triangles from that face.
double face_error(int face, const std::vector<Point>& point, const std::vector<std::array<int, 3>>& triangle) {
  std::vector<double> probe;
  for (const auto& t : triangle) {
    Point centre = {0.0, 0.0, 0.0};
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < 3; ++c) {
        probe.push_back(0.5 * (point[t[k]][c] + point[t[(k + 1) % 3]][c]));
        centre[c] += point[t[k]][c] / 3.0;
      }
    probe.insert(probe.end(), centre.begin(), centre.end());
  }
  double worst = 0.0;
  // a face without curvature needs no probing, and most triangles of a part may lie on such
  std::string type;
  gmsh::model::getType(2, face, type);
  if (type == "Plane") return 0.0;
  std::vector<double> nearest, parameter;
  gmsh::model::getClosestPoint(2, face, probe, nearest, parameter);
  for (std::size_t k = 0; k + 2 < probe.size() && k + 2 < nearest.size(); k += 3)
    worst = std::max(worst,
                     std::hypot(probe[k] - nearest[k], probe[k + 1] - nearest[k + 1], probe[k + 2] - nearest[k + 2]));
  return worst;
}

CadSurface triangulate(double per_turn) {
  gmsh::model::mesh::clear();
  gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", per_turn);
  gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 1);
  gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
  gmsh::model::mesh::generate(2);
  CadSurface surface;
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters);
  std::unordered_map<std::size_t, int> index;
  for (std::size_t n = 0; n < tags.size(); ++n) {
    index.emplace(tags[n], static_cast<int>(n));
    surface.list.point.push_back({coordinates[3 * n], coordinates[3 * n + 1], coordinates[3 * n + 2]});
  }
  gmsh::vectorpair faces;
  gmsh::model::getEntities(faces, 2);
  for (const auto& [dimension, face] : faces) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> elements, nodes;
    gmsh::model::mesh::getElements(types, elements, nodes, dimension, face);
    std::vector<std::array<int, 3>> triangle;
    for (std::size_t t = 0; t < types.size(); ++t)
      for (std::size_t k = 0; types[t] == 2 && k + 2 < nodes[t].size(); k += 3)
        triangle.push_back({index[nodes[t][k]], index[nodes[t][k + 1]], index[nodes[t][k + 2]]});
    surface.chord_error = std::max(surface.chord_error, face_error(face, surface.list.point, triangle));
    surface.list.triangle.insert(surface.list.triangle.end(), triangle.begin(), triangle.end());
  }
  return surface;
}

// In the child: finer and finer until the measured error is within the tolerance.
CadSurface within_tolerance(const fs::path& file, double chord_tolerance) {
  for (double per_turn = first_per_turn;;) {
    CadSurface surface = triangulate(per_turn);
    if (surface.list.triangle.empty())
      throw InputError(file.string() + ": holds no surface; write the part's faces or solid into it");
    if (surface.chord_error <= chord_tolerance) return surface;
    // the error goes with the square of the side; a little more than that asks for
    const double factor = 1.1 * std::sqrt(surface.chord_error / chord_tolerance);
    if (!(per_turn * factor <= greatest_per_turn))
      throw InputError(
          fmt::format("{}: triangles come within {:.3g} mm of the surface, not within chord_tolerance = {:.3g} "
                      "mm; ask for less",
                      file.string(), surface.chord_error, chord_tolerance));
    per_turn *= std::clamp(factor, 1.2, 4.0);
  }
}

std::string encoded(const CadSurface& surface) {
  ByteWriter bytes;
  bytes.value(surface.chord_error);
  bytes.list(surface.list.point);
  bytes.list(surface.list.triangle);
  return bytes.take();
}

// What a child sends is believed no more than the file it read.
CadSurface decoded(const std::string& bytes, const fs::path& file) {
  CadSurface surface;
  try {
    ByteReader reader(bytes);
    surface.chord_error = reader.value<double>();
    surface.list.point = reader.list<Point>();
    surface.list.triangle = reader.list<std::array<int, 3>>();
  } catch (const std::runtime_error& trouble) {
    throw InputError(
        fmt::format("{}: its surface came back in pieces ({}); write the file again", file.string(), trouble.what()));
  }
  require_sound(surface.list, file.string());
  return surface;
}

class PrivateFolder {
public:
  PrivateFolder() {
    std::string name = (fs::temp_directory_path() / "weaveform-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw_cannot_write(name, errno);
    path_ = name;
  }
  ~PrivateFolder() {
    std::error_code unimportant;
    fs::remove_all(path_, unimportant);
  }
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

private:
  fs::path path_;
};

}  // namespace

bool is_cad_file(const fs::path& file) {
  return cad_format(file) != CadFormat::none;
}

CadSurface read_cad(const fs::path& file, double chord_tolerance) {
  const std::string bytes = with_gmsh(file, [&] { return encoded(within_tolerance(file, chord_tolerance)); });
  return decoded(bytes, file);
}

void convert_cad(const fs::path& from, const fs::path& to) {
  const PrivateFolder folder;
  const fs::path written = folder.path() / ("part" + to.extension().string());
  (void)with_gmsh(
      from,
      [&] {
        gmsh::write(written.string());
        return std::string("written");
      },
      folder.path());
  std::error_code trouble;
  if (!fs::is_regular_file(fs::symlink_status(written, trouble)))
    throw FileError(to.string() + ": Gmsh cannot write this; end its name in .step or .brep");
  fs::copy_file(written, to, fs::copy_options::overwrite_existing, trouble);
  if (trouble) throw_cannot_write(to, trouble.value());
}

}  // namespace weaveform
