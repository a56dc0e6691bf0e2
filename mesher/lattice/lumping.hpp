// Masses, soft ends and jaws: the freedoms the mesher has with short stubs, used so that they do not set the stable
// step.
//
// The solver's step obeys (central difference, Gershgorin's row sums; elements to a held neighbour count once)
//   step <= 2 / sqrt(max_i c_i / m_i) ,   c_i = greatest eigenvalue of sum_e f_e k_e n_e n_e^T , f_e = 2 or 1 ,
//   k_e = modulus * section * softening / (rest length + jaw) .
// An endless lattice has c/m = 4 max(K_warp, K_weft) / m, K the stiffness of a whole element, m the mass of a crossing.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh.hpp"

namespace weaveform::lattice {

// The step of every mesh is meant to reach this fraction of the endless lattice's. Very narrow blanks have not mass
// enough where it is needed; they are tried with a little less, down to the second value.
constexpr double step_share = 0.95;
constexpr double least_step_share = 0.90;
// A free yarn end takes at least this share of a whole element's mass: light enough for the crossing to spare, heavy
// enough for the thin shear cells it belongs to.
constexpr double free_end_share = 0.1;
// A held yarn end moves as its jaws do and needs no mass for the step; the crossing gets the rest of the stub's.
constexpr double held_end_share = 0.1;
// What a crossing beside the jaws may count on getting from its neighbours, as a fraction of its own mass.
constexpr double lendable_share = 0.15;
// How far mass may move, in spacings, and what share of its own a held crossing keeps.
constexpr int farthest_shift = 6;
constexpr double held_crossing_keeps = 0.5;

enum class Hold : std::uint8_t { free, guided, rigid };  // guided: by a grip that leaves some components free

// Fills jaw, softening and mass of a mesh whose topology, rest lengths, sections and yarn counts are done.
//   Mass is lumped half and half, but a stub's goes mostly to its crossing.
//   Free stubs, which carry no tension, are softened until their end's own c/m is that of the lattice.
//   Short held stubs reach into the jaws by what is missing to a stiffness their crossing can bear.
//   A crossing still too light for what meets there takes mass from crossings nearby that have some to spare.
// The total mass stays.
void lump(Mesh& mesh, const Card& card, const std::array<double, 2>& coarsening, const std::vector<Hold>& hold);

}  // namespace weaveform::lattice
