// Slots of the lattice (bands.hpp) as loops take them.
#pragma once

namespace weaveform {

// The slots of a row or more: `count` blocks, block[k] the packed index of the first slot of one. What is computed goes
// to index slot - origin of the output.
struct SlotBlocks {
  const int* block;
  int count;
  int origin;
};

}  // namespace weaveform
