// Internal forces of the woven fabric: truss yarns and shear cells, rows of the lattice first, then the loose elements
// that the outline left. Every node's force is summed in one fixed order, so the bits do not depend on the number of
// threads.
#pragma once

#include <array>
#include <memory>

#include "fabric/card/card.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/element/strain_range.hpp"
#include "solver/lattice/moving_nodes.hpp"
#include "solver/state/archive.hpp"
#include "solver/state/packed.hpp"
#include "solver/state/state.hpp"
#include "solver/state/team.hpp"

namespace weaveform {

class FabricForces {
public:
  // `start` gives the directions that cells with a history (incremental, side-frame) count their increments from; where
  // it is sheared, as in a draped blank, they start with the stress of their angle (element/sheared_start.hpp).
  // Throws InputError when a law of the card has more pieces or a higher degree than the inner loop takes, and of cells
  // with a history in single precision (element_loops.hpp).
  FabricForces(const PackedMesh& packed, const Card& card, const std::array<TangentLaw, 2>& yarn_laws,
               const ModelSpec& model, const State& start, Team& team,
               Precision precision = Precision::double_precision);
  ~FabricForces();
  FabricForces(const FabricForces&) = delete;
  FabricForces& operator=(const FabricForces&) = delete;

  // Whether all along z is zero, and is left alone (element_loops.hpp): the same bits sooner. Not until set; needs loops.
  [[nodiscard]] bool has_flat_loops() const;
  void set_flat(bool flat);

  // MPa s; the yarns' axial viscosity (yarn.hpp), warp and weft. 0 until set.
  void set_viscosity(const std::array<double, 2>& viscosity);

  // Sets state.force from state.position and, with viscosity, state.velocity (N; all nodes).
  // Cells with a history move on with every call.
  void compute(State& state);
  // The same, and moves the free nodes of the lattice at once (moving_nodes.hpp): their place in state.force keeps what
  // it held. The bits are those of compute() and move_free_nodes() one after the other.
  void compute_and_move(State& state, const BandMove& move);
  [[nodiscard]] const Bands& bands() const;

  // s; how far ahead strains() looks. 0 until set.
  void set_look_ahead(double time);
  // True strains that the yarns of each family, warp and weft, had in the last call, or come to within the look-ahead
  // at the rate they had; zero strain is among them.
  [[nodiscard]] std::array<StrainRange, 2> strains() const;

  // sin^2 gamma of the most sheared cell in the last call.
  [[nodiscard]] double sharpest() const;

  // mJ/s; power of the yarns' viscosity in the last call.
  [[nodiscard]] double viscous_power() const;
  // mJ; work done on the cells so far, for formulations with a history (0 for the others).
  [[nodiscard]] double cell_work() const;
  // What the last call left behind: the yarns' viscous power, and the history of all cells where the formulation has
  // one. The same for any number of threads.
  void archive(Archive& archive);

private:
  struct Kernels;
  template <class Real>
  struct KernelsOf;
  std::unique_ptr<Kernels> kernels_;
};

}  // namespace weaveform
