// The plies of a stack draped on their tool, each on those between it and the tool.
#pragma once

#include <vector>

#include "mesher/drape/drape.hpp"
#include "mesher/resolve/resolved.hpp"

namespace weaveform {

struct DrapedPly {
  double off = 0.0;         // mm; of the ply's middle plane from the tool
  std::vector<Tool> tools;  // with the draped one at that distance
  Drape drape;
};

// Of each ply by its number. Each net lies as far off as its chords and those of the plies beneath need not to start
// inside each other; what has no place (Drape::unreachable) is left out of that. `model` is a stack, flat, with its
// tools. Throws what drape_blank throws, with the ply's name.
[[nodiscard]] std::vector<DrapedPly> drape_plies(const Resolved& model);

// Makes these drapes the start of all plies, and so of the stack's mesh. Throws PhysicsError where one is not whole.
void drape_stack(Resolved& model);

}  // namespace weaveform
