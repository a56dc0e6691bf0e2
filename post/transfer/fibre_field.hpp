// What a structural analysis wants of a formed fabric, per cell or per element of another mesh.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/keys/length_unit.hpp"
#include "mesher/exchange/foreign_mesh.hpp"
#include "mesher/mesh/mesh.hpp"
#include "solver/result/fields.hpp"
#include "solver/result/result_folder.hpp"

namespace weaveform {

struct FibreState {
  Vec3 warp = {1.0, 0.0, 0.0}, weft = {0.0, 1.0, 0.0};  // unit
  double shear_angle = 0.0;                             // rad; sin gamma = warp.weft
  double thickness = 0.0;           // mm; volume kept: t0 / J, J = |g1 x g2| the area ratio; t0 with constant thickness
  double fibre_volume_ratio = 1.0;  // fibre volume fraction over that of the flat fabric, t0 / (J t)
  double fibre_mass_ratio = 1.0;    // fibre mass per area over that of the flat fabric, 1 / J
};

// A shell of the mesh the states belong to. Of our own cells: as `weaveform export` cuts and numbers them.
struct StateElement {
  long number = 0;
  std::vector<int> node;  // places in FibreField::position
  Vec3 centre = {};       // mm
  FibreState state;
  double distance = 0.0;  // mm; from the formed fabric; 0 on our own cells
  bool far = false;       // farther than FibreField::within: there is no fabric there, and `state` says nothing
};

struct FibreField {
  std::vector<Vec3> position;  // mm
  std::vector<long> number;    // of each node in its file; none: from 1 on
  std::vector<StateElement> element;
  double flat_thickness = 0.0;                          // mm
  std::array<Vec3, 2> flat_direction = {};              // unit; warp and weft before forming
  std::string source;                                   // what was read, for headers
  double greatest_distance = 0.0, mean_distance = 0.0;  // mm; the mean of the shells that are not far
  double within = 0.0;                                  // mm; beyond it a shell is far
  int far = 0;                                          // shells that are
  LengthUnit unit = LengthUnit::mm;                     // of the file whose shells they are; lengths above stay in mm
  int steep = 0;  // elements that the flat warp direction meets within 5 deg of their normal (drape angles are poor)
};

// From a solved folder: the last frame. Throws FileError, InputError as post_process does.
[[nodiscard]] FibreField read_fibre_field(ResultFolder& folder);
// The same of one ply of a stack.
[[nodiscard]] FibreField read_fibre_field(ResultFolder& folder, std::size_t ply);
// The same from a mesh and positions in memory.
[[nodiscard]] FibreField fibre_field(const Mesh& mesh, const Scene& scene, const std::vector<Vec3>& position);
// Mean of a shell's corners.
[[nodiscard]] Vec3 centre_of(const std::vector<int>& node, const std::vector<Vec3>& position);

// How a structural mesh lies to the formed fabric.
struct Onto {
  std::optional<LengthUnit> unit;   // of its file; none: mm, and asked about when out of proportion
  Vec3 axis = {0.0, 0.0, 1.0};      // first it is turned about this axis through its origin
  double angle = 0.0;               // deg; by the right hand
  Vec3 position = {0.0, 0.0, 0.0};  // mm; then its origin is moved here, into the place it has in the scene
  std::optional<double> within;     // mm; none: half the mean side of its shells or of the fabric's, the larger of both
};

// Shells of a structural mesh: .inp, .msh, or .vtu (triangles and quadrilaterals); of those the ones of `part`
// (shells_named), unless it is empty. Throws FileError, InputError; so when shells share a number, which those of
// several parts may.
[[nodiscard]] ForeignMesh read_structural_mesh(const std::filesystem::path& file, const std::string& part = "");

// Carried onto the shells of another mesh: each takes, at its centre's closest point of the formed fabric, directions
// and ratios interpolated from means at the nodes, turned into its own plane (nearest unit vectors in it). Positions
// and directions are in the axes of the mesh. Throws InputError when its size is out of all proportion to the fabric's
// and no unit is given, when a shell stands across the fabric, or when all of them are far from it.
[[nodiscard]] FibreField map_onto(const FibreField& fabric, const ForeignMesh& structure, const Onto& onto = {});

}  // namespace weaveform
