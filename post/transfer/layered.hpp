// The plies of a formed stack as the layers of shells for structural analysis: one orientation and thickness per ply, each
// mapped onto the same shells by its closest points (map_onto).
#pragma once

#include <string>
#include <vector>

#include "post/transfer/write_fibre.hpp"

namespace weaveform {

struct FibreLayer {
  std::string ply;       // name
  std::string material;  // name of its card
  FibreField field;      // of the same shells as every other layer's
};

// Each layer on the shells of the lowest ply's own cells, numbered as in read_fibre_field; the lowest as it is.
void map_onto_lowest(std::vector<FibreLayer>& layers);

// All plies of a solved stack, bottom to top. Throws what read_fibre_field throws.
[[nodiscard]] std::vector<FibreLayer> read_fibre_layers(ResultFolder& folder);

// Layers stand bottom to top along a shell's own normal, whichever way that points; where a ply is far from a shell, the
// shell has no such layer, and a shell far from all of them is left out. The fabric's up is warp x weft.
//
// Per group of shells with the same directions (within `group_angle`, deg, of one another) and thicknesses (within 1 %) in
// every layer an element set and a *SHELL SECTION, COMPOSITE: a line per layer with its thickness, material (the card's
// name as an identifier) and *ORIENTATION WARP_n_PLY.
[[nodiscard]] FibreText layers_calculix(const std::vector<FibreLayer>& layers, double group_angle,
                                        const std::string& written_by);
// *DISTRIBUTIONs of each ply's directions and thickness, and a *SHELL SECTION, COMPOSITE for each set of shells that have
// the same layers in the same order.
[[nodiscard]] FibreText layers_abaqus(const std::vector<FibreLayer>& layers, const std::string& written_by);
// /DRAPE/2k+1 of the k-th ply's warp and /DRAPE/2k+2 of its weft, as drape_openradioss.
[[nodiscard]] FibreText layers_openradioss(const std::vector<FibreLayer>& layers, const std::string& written_by);
// *ELEMENT_SHELL_COMPOSITE: each shell again, of part 1, with a material, a thickness and an angle for each layer. The
// angle is that of the warp from the shell's first edge, counter-clockwise about its normal, as materials take it whose
// AOPT is 0; materials are numbered in the order of the plies.
[[nodiscard]] FibreText layers_lsdyna(const std::vector<FibreLayer>& layers, const std::string& written_by);
// The rows of fibre_csv with the ply's name first, ply after ply.
[[nodiscard]] FibreText layers_csv(const std::vector<FibreLayer>& layers);

// Letters, digits and '_' of a name, in capitals, as decks name things.
[[nodiscard]] std::string deck_name(const std::string& name);

}  // namespace weaveform
