#include "core/instructions/choose_loops.hpp"
#include "solver/contact/edge_kernel.hpp"

namespace weaveform {

WEAVEFORM_CHOOSE_LOOPS(EdgeLoops, edge_loops)

const EdgeLoops& loops_of_edges() {
  return chosen_edge_loops();
}

}  // namespace weaveform
