// What a frame shows, computed from the mesh and the nodes' current positions.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/vector/vector.hpp"
#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/element/yarn_law.hpp"
#include "solver/state/contact_state.hpp"
#include "solver/state/ply_contact_state.hpp"

namespace weaveform {

struct Fields {
  double time = 0.0;                // s
  std::vector<Vec3> position;       // mm; per node
  std::vector<Vec3> displacement;   // mm; per node, from the mesh's initial position
  std::vector<double> shear_angle;  // rad; per cell, signed: sin gamma = g1.g2 of the unit yarn directions
  std::vector<Vec3> warp, weft;     // unit yarn directions; per cell
  // mm; per cell. With l1, l2 the yarns' stretch (mean of a full cell's sides) its area is A = A0 l1 l2 cos gamma, so
  // at constant volume t = t0 A0/A = t0/(l1 l2 cos gamma); 0 for a cell without area. model.thickness = "constant": t0.
  std::vector<double> thickness;
  std::vector<double> areal_weight;  // 1; per cell, fibre mass per area over that of the flat fabric, A0/A; 0 likewise
  std::vector<bool> folded;          // per cell: area vector turned against the cell's neighbours' (see folded_cells)
  std::vector<double> yarn_strain;   // 1; true strain per yarn element
  std::vector<double> yarn_force;    // N; axial, tension positive
  std::optional<ContactState> contact;  // per node; when the scene has tools. Not from positions alone: the solver's
  std::optional<PlyContactState> between = {};  // per node; of a stack. Likewise
};

// The fields of the next ply of a stack, of the same time, behind those of the plies before.
void append(Fields& all, const Fields& more);
// The entries of one ply.
[[nodiscard]] Fields fields_of_ply(const Fields& all, const Mesh& stack, std::size_t ply);

[[nodiscard]] Fields compute_fields(const Mesh& mesh, const Card& card, const ModelSpec& model, double time,
                                    const std::vector<Vec3>& position);

// The cell of the greatest |shear angle|; of cells that are equal but for rounding (a symmetric part) the first.
[[nodiscard]] int most_sheared_cell(const Fields& fields);

// The plane of a blank that starts planar; `normal` is 0 when it does not.
struct BlankPlane {
  Vec3 origin = {0.0, 0.0, 0.0};  // mm
  Vec3 normal = {0.0, 0.0, 0.0};  // 1
};
[[nodiscard]] BlankPlane blank_plane(const Mesh& mesh);

// What a row of history needs of the fields, for a fraction of their cost: time, position, folded, and the shear angles
// of `looked_at` cells. Those of other cells are not a number.
[[nodiscard]] Fields compute_row_fields(const Mesh& mesh, const BlankPlane& plane, double time,
                                        const std::vector<Vec3>& position, const std::vector<int>& looked_at);

// A cell is folded (inverted) when its oriented area g1 x g2 points against the mean oriented area of the whole patch
// of cells around it (cells sharing a node), or, on a planar blank, against the blank's own normal.
[[nodiscard]] std::vector<bool> folded_cells(const Mesh& mesh, const BlankPlane& plane,
                                             const std::vector<Vec3>& position);

}  // namespace weaveform
