#include "mesher/tools/cad.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <system_error>

#include "core/error.hpp"
#include "core/files/bytes.hpp"
#include "core/files/files.hpp"
#include "core/guard/guarded.hpp"
#include "core/vector/vector.hpp"
#include "mesher/tools/gmsh_session.hpp"
#include "mesher/tools/opencascade.hpp"
#include "mesher/tools/script_triangles.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

std::string encoded(const CadSurface& surface) {
  ByteWriter bytes;
  bytes.value(surface.chord_error);
  bytes.list(surface.list.point);
  bytes.list(surface.list.triangle);
  bytes.value<std::uint64_t>(surface.words.size());
  for (const std::string& word : surface.words) bytes.text(word);
  return bytes.take();
}

// What a child sends is believed no more than the file it read.
CadSurface decoded(const std::string& bytes, const fs::path& file) {
  CadSurface surface;
  try {
    ByteReader reader(bytes);
    surface.chord_error = reader.value<double>();
    surface.list.point = reader.list<Vec3>();
    surface.list.triangle = reader.list<std::array<int, 3>>();
    for (std::size_t left = reader.count_of(sizeof(std::uint64_t)); left > 0; --left)
      surface.words.push_back(reader.text());
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

// In the child: a script's geometry as a BREP file in `folder`.
fs::path shape_of_script(const std::string& path, const fs::path& file, const fs::path& folder) {
  const fs::path shape = folder / "script.brep";
  (void)open_gmsh(CadFormat::script, path, file, [&] {
    if (!is_all_opencascade())
      throw InputError(file.string() +
                       ": this script's geometry is of Gmsh's own kernel, which no CAD format holds; begin it with "
                       "SetFactory(\"OpenCASCADE\"), or write STL");
    gmsh::write(shape.string());
    return std::string();
  });
  return shape;
}

// In the child: through a BREP file to OpenCASCADE's triangles, or by Gmsh's own where the script's kernel is Gmsh's.
CadSurface script_surface(const std::string& path, const fs::path& file, const fs::path& folder,
                          double chord_tolerance) {
  const std::string shape = (folder / "script.brep").string();
  CadSurface surface;
  const auto in_gmsh = [&] {
    if (!is_all_opencascade()) {
      surface = triangles_of_script(chord_tolerance, file.string());
      return std::string("triangles");
    }
    gmsh::write(shape);
    return std::string("shape");
  };
  if (open_gmsh(CadFormat::script, path, file, in_gmsh) == "triangles") return surface;
  return opencascade().surface(CadFormat::brep, shape, chord_tolerance, file.string());
}

}  // namespace

bool is_cad_file(const fs::path& file) {
  return cad_format(file) != CadFormat::none;
}

bool names_its_unit(const fs::path& file) {
  return cad_format(file) == CadFormat::step || cad_format(file) == CadFormat::iges;
}

CadSurface read_cad(const fs::path& file, double chord_tolerance) {
  const PrivateFolder folder;
  const bool is_script = cad_format(file) == CadFormat::script;
  const std::string bytes = with_cad_file(
      file,
      [&](CadFormat format, const std::string& path) {
        return encoded(is_script ? script_surface(path, file, folder.path(), chord_tolerance)
                                 : opencascade().surface(format, path, chord_tolerance, file.string()));
      },
      is_script ? folder.path() : fs::path());
  return decoded(bytes, file);
}

void convert_cad(const fs::path& from, const fs::path& to) {
  const PrivateFolder folder;
  const fs::path written = folder.path() / "part";
  const std::string done = with_cad_file(
      from,
      [&](CadFormat format, const std::string& path) {
        const fs::path source =
            format == CadFormat::script ? shape_of_script(path, from, folder.path()) : fs::path(path);
        const CadFormat read_as = format == CadFormat::script ? CadFormat::brep : format;
        return std::string(opencascade().rewrite(read_as, source, cad_format(to), written) ? "written" : "not");
      },
      folder.path());
  if (done != "written") throw FileError(to.string() + ": cannot be written so; end its name in .step or .brep");
  std::error_code trouble;
  if (!fs::is_regular_file(fs::symlink_status(written, trouble)))
    throw FileError(to.string() + ": nothing came of writing it; the part may be empty");
  write_whole(to, [&](const fs::path& temporary) {
    fs::copy_file(written, temporary, fs::copy_options::overwrite_existing, trouble);
    if (trouble) throw_cannot_write(to, trouble.value());
  });
}

}  // namespace weaveform
