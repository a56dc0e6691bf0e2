// What a cell-step of the lattice costs: operations, counted by running the element bodies with a number that counts
// (counted.hpp), and bytes.
#pragma once

#include "bench/counted.hpp"

namespace weaveform {

// One cell with its two yarns and one node, plain weave of twintex (incompressible sections, energy formulation,
// constant volume), viscosity and the look at strains included.
[[nodiscard]] Operations operations_of_a_cell_step();

// Read and written once each, what a blank larger than the caches cannot do without in double precision.
inline constexpr double bytes_of_a_cell_step = 8.0 * (2 * 6  // position and velocity, read and written
                                                      + 2    // mass and its inverse
                                                      + 3);  // two sections, one area
// What passes when forces and motion are two passes: forces written (a line is read before) and read, position and
// velocity read twice.
inline constexpr double bytes_in_two_passes = bytes_of_a_cell_step + 8.0 * (3 * 3 + 6);

}  // namespace weaveform
