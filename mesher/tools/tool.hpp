// Rigid tools as the scene describes them, made ready: shape, place, direction.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "mesher/tools/distance.hpp"
#include "mesher/tools/triangles.hpp"

namespace weaveform {

struct Tool {
  std::string name;
  ToolShape shape = ToolShape::plane;
  double radius = 0.0;         // mm; sphere, cylinder; of a ring's opening
  double fillet_radius = 0.0;  // mm; ring
  Profile profile;
  std::shared_ptr<const TriangleSurface> surface;
  std::string surface_digest;                          // of the triangles, as they are used; "" without any
  Placement start;                                     // where it is at time 0
  std::array<double, 3> direction = {0.0, 0.0, -1.0};  // unit; of its motion
  double friction = 0.0;                               // 1
  double offset = 0.0;                                 // mm; from the fabric's middle plane to its face
  std::vector<std::string> notes;                      // what its file's reader complained of and passed over
};

// The chord tolerance of CAD that a scene leaves open, for each mm of a cell's shorter edge h. A cell's own edge, laid
// as a chord over a radius R, misses it by h^2 / 8 R: more than h / 100 wherever R < 12.5 h, so that the tool is the
// finer of the two wherever it bends the fabric.
inline constexpr double chord_per_cell = 0.01;
inline constexpr double usual_cell_edge = 5.0;  // mm; where there is no mesh

// The scene's tools in its order. `thickness` of the fabric (mm) gives the offsets left open, the cells' shorter edge
// (mm) the chord tolerances. Throws InputError when a profile or surface is none, FileError when a file cannot be read.
[[nodiscard]] std::vector<Tool> make_tools(const Scene& scene, const Mesh& mesh);
[[nodiscard]] std::vector<Tool> make_tools(const Scene& scene, double thickness, double cell_edge = usual_cell_edge);

// One of them, of the scene's `spec`.
[[nodiscard]] Tool make_tool(const ToolSpec& spec, const Scene& scene, const Mesh& mesh);
[[nodiscard]] Tool make_tool(const ToolSpec& spec, const Scene& scene, double thickness, double cell_edge);
[[nodiscard]] double cell_edge_of(const Mesh& mesh);  // mm; the shorter

// mm; from the tool's surface to the middle plane of a fabric of this thickness that touches it.
[[nodiscard]] inline double offset_of(const ToolSpec& spec, double thickness) {
  return spec.offset.value_or(0.5 * thickness);
}
// Whether a tool without a position is laid on the blank's lower face: a plane or ring that faces up, a sphere whose
// shank leads down.
[[nodiscard]] inline bool lies_below(const ToolSpec& spec) {
  return (spec.shape == ToolShape::sphere) != (spec.axis[2] > 0.0);
}

// Signed distances of up to points_at_a_time points from the tool standing at `place`. `hint` holds one number a point,
// kept from call to call by whoever cares for speed (triangles only; any value gives the same distance).
void tool_distances(const Tool& tool, const Placement& place, const Coordinates& x, int count, int* hint,
                    Distances& out);

// Where make_tools looks for a tool's file.
[[nodiscard]] std::filesystem::path tool_path(const std::string& path, const std::filesystem::path& scene_file);

}  // namespace weaveform
