// Which yarn elements bound which cells, and how the shear of the ones shortens the others, where the card couples
// tension and shear (fabric/trellis/tension_shear.hpp). For a mesh of yarn elements y and cells c,
//   E = sum_c V_c w(s_c) + sum_y A_y L0_y phi_y(e_y + d_y) ,   d_y = sum_c share_yc w(s_c) ,
//   share_yc = a (A/h)_y m_yc V_c / (A_y L0_y) ,
// m_yc the part of yarn element y in the mean tension of cell c: half for each family, divided evenly among the elements
// of the family that bound the cell. Then dE/dw_c = V_c (1 + a sum_y m_yc T_y), whatever the cells' outlines. Elements
// that are short in a grip or soft at a free end (mesh.hpp: jaw, softening) tell nothing of the fabric's tension and have
// no part in it; a family without others has no tension there.
#pragma once

#include <array>
#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

struct CoupledPair {
  int cell = 0, yarn = 0;  // of the mesh
  double part = 0.0;       // 1; m_yc
  double share = 0.0;      // 1/MPa; share_yc
};

struct CoupledLattice {
  std::vector<CoupledPair> pair;        // cells rising
  std::array<double, 2> section_width;  // mm; A/h of warp and weft
  double coupling = 0.0;                // mm/N; a
};

[[nodiscard]] CoupledLattice couple_lattice(const Mesh& mesh, const Card& card);

// 1; d_y of every yarn element of the mesh, from the energy per volume (mJ/mm^3) of every cell.
[[nodiscard]] std::vector<double> shortenings(const CoupledLattice& lattice, const std::vector<double>& cell_energy,
                                              std::size_t yarns);

// Throws InputError when the card couples tension and shear, and the model cannot: what stands in its way in words.
void require_coupling(const Card& card, const ModelSpec& model);

}  // namespace weaveform
