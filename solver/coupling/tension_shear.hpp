// The coupling of tension and shear on a ply, beside the loops of its yarns and cells: what a card with tension_coupling
// adds to their energy,
//   E = sum_y A_y L0_y [ phi(e_y + d_y) - phi(e_y) ] ,   d_y = sum_c share_yc w(s_c)       (coupled_lattice.hpp)
// phi the integral of the yarn's stress where it pulls, and 0 where it does not: a slack or pressed yarn couples nothing.
// Forces are its exact derivatives,
//   on a yarn's ends   A_y L0_y [ s(e_y + d_y) - s(e_y) ] / L_y   along it
//   on a cell          V_c a T_c dw/ds ds/dx ,   T_c the mean tension of its yarns ,
// so that energy is kept, rigid motions give no force, and cells have the stress sigma (1 + a T). Its state are the strains
// of the last forces, which its energy is asked of.
#pragma once

#include <array>
#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "solver/coupling/coupled_lattice.hpp"
#include "solver/coupling/shear_energy_table.hpp"
#include "solver/element/kernel_law.hpp"
#include "solver/element/strain_range.hpp"
#include "solver/state/actor.hpp"
#include "solver/state/packed.hpp"

namespace weaveform {

class TensionShear final : public Actor {
public:
  // Mesh and laws must outlive it. Throws InputError when a law has more pieces than inner loops take.
  TensionShear(const Mesh& mesh, const PackedMesh& packed, const Card& card,
               const std::array<TangentLaw, 2>& yarn_laws);

  [[nodiscard]] std::string name() const override { return "the coupling of tension and shear"; }
  void add_forces(State& state, double step) override;
  [[nodiscard]] StoredEnergy stored_energy() const override;
  // Of d alone: yarns as stiff as at e + d are in the woven net's own bound, which is told of those strains (strains()).
  void add_stiffness_bound(const std::vector<Vec3>& position, double fabric_frequency,
                           std::vector<double>& bound) const override;
  void archive(Archive& archive) override;

  // 1; e + d of the last forces, of warp and weft.
  [[nodiscard]] const std::array<StrainRange, 2>& strains() const { return strains_; }

private:
  // Cells of up to `width` nodes, unused entries with coefficient 0 on the first node, unused yarns the idle one.
  template <int width>
  struct Cells {
    std::array<std::vector<int>, width> node, yarn;
    std::array<std::vector<double>, width> warp, weft, part;  // 1/mm, 1/mm, 1
    std::vector<double> volume;                               // mm^3
    int first = 0;                                            // number of its first cell among all
    [[nodiscard]] int size() const { return static_cast<int>(volume.size()); }
  };
  template <int width>
  void add_cell(const Mesh& mesh, const PackedMesh& packed, int cell, const std::vector<CoupledPair>& pairs,
                Cells<width>& cells);
  template <int width>
  void look_at_cells(const State& state, const Cells<width>& cells);
  void pull_yarns(State& state);
  template <int width>
  void shear_cells(State& state, const Cells<width>& cells) const;

  const Mesh& mesh_;
  const std::array<TangentLaw, 2>& laws_;
  CoupledLattice lattice_;
  ShearCard shear_;
  ShearEnergyTable table_;
  std::array<GeneralLaw, 2> packed_law_;
  Cells<4> quads_;
  Cells<6> others_;
  // Of the yarn elements that bound cells, warp first; the last entry is idle.
  struct Yarns {
    std::vector<int> mesh_number, node0, node1;
    std::vector<double> length, section;              // mm, mm^2
    std::array<std::vector<int>, 2> cell;             // beside it; the idle one, without energy, where there is none
    std::array<std::vector<double>, 2> share;         // 1/MPa
    std::vector<double> strain, shortening, tension;  // 1, 1, N/mm; at the last forces
    int warps = 0;
    [[nodiscard]] int size() const { return static_cast<int>(mesh_number.size()); }
  };
  Yarns yarns_;
  std::vector<double> energy_, stress_,
      sine_;  // mJ/mm^3, MPa, 1; of every cell at the last forces, and of the idle one
  std::array<StrainRange, 2> strains_;
};

}  // namespace weaveform
