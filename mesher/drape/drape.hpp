// A blank draped on a tool: places of all its nodes, what it shears, and what is wrong with it, by place. See net.hpp
// for the kinematics; the scene's [drape] says where and which way.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "mesher/tools/tool.hpp"

namespace weaveform {

// Radii of the tool below this many cell sides are reported: there the chords of the net cut corners, and shear comes
// out of nothing. On a cylinder of radius r, with the yarns at an angle b to its axis, the net of chords a has
//   gamma = (a/r)^2 sin(2b)/12   (both helices' mean chords at a cell's centre; measured: the same to 2 % for r >= 2 a)
// which is 0.53 deg at r = 3 a. Below r = a there is no bound: across a sharp bend of 45 deg chords shear by 19 deg
// whatever their length, across one of 90 deg the net folds (docs/drape.md).
inline constexpr double least_radius_in_cells = 3.0;

struct DrapePlace {
  std::string what;                            // a sentence without the place
  std::array<double, 3> at = {0.0, 0.0, 0.0};  // mm
  int count = 0;                               // crossings or cells of this connected region
};

struct Drape {
  std::string tool;
  std::array<double, 3> seed = {0.0, 0.0, 0.0};  // mm; of the fabric's middle plane
  std::vector<std::array<double, 3>> position;   // mm; per node; not a number where there is no place
  // mm; per node: the same, but free yarn ends lie on the tool, as the net has them, and not in line with their yarn,
  // as a solve has them
  std::vector<std::array<double, 3>> laid;
  std::vector<char> placed;                    // per node
  std::vector<std::array<double, 3>> carried;  // mm; per node: of crossings beyond a rim, else not a number
  // rad; per cell, not a number unless all its nodes have a place; of cells that the outline cuts the net's at the
  // centre of their shape (outline_cells.hpp)
  std::vector<double> shear_angle;
  std::vector<char> extrapolated;  // per cell: cut, and the net beyond the outline leaves the tool there
  std::vector<char> folded;        // per cell: its orientation is against the tool's normal
  std::vector<DrapePlace> unreachable, folds, tight;
  double length_error = 0.0;  // 1; greatest relative error of a yarn element between crossings
  int net_cells = 0;          // of the whole net, with what lies outside the blank but carries it
  double wall_s = 0.0;        // for the net alone
  [[nodiscard]] bool whole() const { return unreachable.empty() && folds.empty(); }
};

// `mesh` flat, as build_flat_mesh leaves it; `tools` are the scene's. Throws InputError: no such tool, a seed off the
// surface, a blank that misses the tool, a warp direction across the surface, curves that miss the seed.
[[nodiscard]] Drape drape_blank(const Scene& scene, const Mesh& mesh, const std::vector<Tool>& tools);

// "at (x, y, z) mm: what (count)"
[[nodiscard]] std::string place_line(const DrapePlace& place);

// Makes the drape the mesh's start; its flat places stay in nodes.flat_position. Throws PhysicsError, with the places,
// unless the drape is whole.
void lay_drape(const Scene& scene, const Drape& drape, Mesh& mesh);

}  // namespace weaveform
