#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "mesher/exchange/foreign_mesh.hpp"
#include "mesher/exchange/import.hpp"
#include "mesher/tools/geo_script.hpp"
#include "mesher/tools/mesh_surface.hpp"
#include "mesher/tools/profile.hpp"
#include "mesher/tools/stl.hpp"
#include "mesher/tools/triangle_report.hpp"
#include "mesher/tools/triangles.hpp"
#include "tests/fuzz/rooms.hpp"
#include "tests/fuzz/scratch_file.hpp"

namespace weaveform::fuzz {
namespace {

void foreign(const std::filesystem::path& file) {
  answered([&] {
    const ForeignMesh read = read_foreign_mesh(file);
    static_cast<void>(tool_surface(read, "punch"));
    answered([&] { static_cast<void>(read_mesh_surface(file, "punch")); });
    answered([&] { static_cast<void>(import_own(read)); });
    answered([&] { static_cast<void>(import_foreign(read, plain_scene(), plain_card())); });
  });
}

void abaqus(std::string_view bytes) {
  const ScratchFile file("mesh.inp", bytes);
  foreign(file.path());
}

void gmsh_mesh(std::string_view bytes) {
  const ScratchFile file("mesh.msh", bytes);
  foreign(file.path());
}

// As a tool's file goes: read, looked at, turned alike, asked for distances.
void stl(std::string_view bytes) {
  answered([&] {
    const TriangleList list = parse_stl(bytes, "tool.stl");
    static_cast<void>(describe_faults(inspect(list)));
    const TriangleSurface surface(turned_alike(list, {0.0, 0.0, 1e3}), "tool.stl");
    for (const auto& point : list.point) {
      const auto near = surface.distance({point[0] + 1.0, point[1], point[2] - 0.5});
      hold(std::isfinite(near.distance) && near.triangle >= 0 && near.triangle < surface.size());
    }
  });
}

// What Gmsh gets to read has every line where it was, and would pass once more.
void geo(std::string_view bytes) {
  answered([&] {
    const std::string kept = geometry_script(bytes, "blank.geo");
    hold(kept.size() == bytes.size() &&
         std::count(kept.begin(), kept.end(), '\n') == std::count(bytes.begin(), bytes.end(), '\n'));
    hold(geometry_script(kept, "blank.geo") == kept);
  });
}

// A corner on each line; whatever is no number stands between two.
std::vector<std::vector<double>> corners_of(std::string_view bytes) {
  std::vector<std::vector<double>> corners(1);
  const char *at = bytes.data(), *const end = at + bytes.size();
  while (at < end) {
    if (*at == '\n') corners.emplace_back();
    double x = 0.0;
    const auto [after, error] = std::from_chars(at, end, x);
    if (error == std::errc()) corners.back().push_back(x);
    at = error == std::errc() ? after : at + 1;
  }
  if (corners.back().empty()) corners.pop_back();
  return corners;
}

// A profile that was taken answers with numbers everywhere.
void profile(std::string_view bytes) {
  answered([&] {
    const auto corners = corners_of(bytes);
    const Profile outline = make_profile(corners, "profile");
    for (const auto& corner : corners)
      for (const double off : {0.0, 1e-7, 3.0}) {
        const ProfileDistance near = profile_distance(outline, corner[0] + off, corner[1] - off);
        hold(std::isfinite(near.distance) && std::abs(std::hypot(near.normal_r, near.normal_z) - 1.0) < 1e-6);
      }
  });
}

}  // namespace

std::vector<Target> geometry_targets() {
  return {{"abaqus", abaqus}, {"gmsh_mesh", gmsh_mesh}, {"stl", stl}, {"geo", geo}, {"profile", profile}};
}

}  // namespace weaveform::fuzz
