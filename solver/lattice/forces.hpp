// Internal forces of the woven fabric: truss yarns and shear cells, rows of the lattice first, then the loose elements that
// the outline left. Every node's force is summed in one fixed order, so the bits do not depend on the number of threads.
#pragma once

#include <array>
#include <memory>

#include "mesher/material/card.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/lattice/packed.hpp"
#include "solver/lattice/state.hpp"

namespace weaveform {

class FabricForces {
public:
  // Throws InputError when a law of the card has more pieces or a higher degree than the inner loop takes (8, 6).
  FabricForces(const PackedMesh& packed, const Card& card, const std::array<TangentLaw, 2>& yarn_laws,
               const ModelSpec& model, int threads);
  ~FabricForces();
  FabricForces(const FabricForces&) = delete;
  FabricForces& operator=(const FabricForces&) = delete;

  // Sets state.force from state.position (N; all nodes).
  void compute(State& state);

private:
  struct Kernels;
  std::unique_ptr<Kernels> kernels_;
};

}  // namespace weaveform
