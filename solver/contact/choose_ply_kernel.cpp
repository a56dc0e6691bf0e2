#include "core/instructions/choose_loops.hpp"
#include "solver/contact/ply_kernel.hpp"

namespace weaveform {

WEAVEFORM_CHOOSE_LOOPS(PlyLoops, ply_loops)

const PlyLoops& loops_of_plies() {
  return chosen_ply_loops();
}

}  // namespace weaveform
