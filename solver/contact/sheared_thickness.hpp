// How thick a ply is where others and tools touch it, once it is sheared: at constant volume
//   t = t0 w,   w = 1/cos(gamma),   sin(gamma) = a.b/(|a| |b|)
// with a and b between the node's neighbours along warp and weft (ply_arms.hpp). The angle is so a mean over the whole
// cells around the node; yarns that stretch do not thin the ply. From 75 degrees on, far beyond what fabrics lock at, w stays
// 3.86.
//
// Thickness is a function of positions, and what is stored in contact one of thickness, so that contact's forces have a
// potential only with those that act through t. Contacts add dE/dw of each node to `load`, and
//   a takes  -dE/dw w^3 s (b/|b| - s a/|a|)/|a|,   b the like,   s = sin(gamma)
// on the node's neighbours: pressed fabric resists thickening, which is what a pressure does to a fabric of constant
// volume whose area shrinks. Forces and moments sum to zero.
#pragma once

#include <array>

#include "mesher/mesh/mesh.hpp"
#include "solver/contact/ply_arms.hpp"
#include "solver/state/archive.hpp"
#include "solver/state/packed.hpp"
#include "solver/state/state.hpp"
#include "solver/state/team.hpp"

namespace weaveform {

// w of yarns whose angle from 90 degrees has this sine.
[[nodiscard]] double thickening(double sine);

class ShearedThickness {
public:
  ShearedThickness(const Mesh& mesh, const PackedMesh& packed, const State& start);

  // At these positions from now on, without loads.
  void look(const State& state, Team& team);
  // 1; w per packed node, and as many more as loops go over at a time; 1 where no node is.
  [[nodiscard]] const Doubles& swell() const { return swell_; }
  // 1; what w has grown by since the look before, at the node where that is most.
  [[nodiscard]] double greatest_rise() const { return greatest_rise_; }
  // N mm; per packed node: contacts add dE/dw.
  [[nodiscard]] Doubles& load() { return load_; }
  // After all contacts, and before forces are given on to what nodes follow.
  void add_forces(State& state) const;

  // 1/mm; sum over the ends of a and b of |dw/dx|, at the last look's shear.
  [[nodiscard]] double lever(int packed, const Components& position) const;
  // Adds a share of `whole` to each end of a and b, by |dw/dx| in units of `scale` (mm): a row of stiffness sums.
  void spread(int packed, const Components& position, double scale, double whole, Doubles& bound) const;
  void archive(Archive& archive);

private:
  // 1/mm; |dw/dx| at one end of a and of b.
  [[nodiscard]] std::array<double, 2> slopes(int packed, const Components& position) const;

  PlyArms arms_;
  int nodes_;
  Doubles swell_, load_;
  double greatest_rise_ = 0.0;
};

}  // namespace weaveform
