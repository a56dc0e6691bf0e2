#include "core/instructions/choose_loops.hpp"
#include "solver/lattice/node_loops.hpp"

namespace weaveform {

WEAVEFORM_CHOOSE_LOOPS(NodeLoops, loops_of_nodes)

const NodeLoops& node_loops() {
  return chosen_loops_of_nodes();
}

}  // namespace weaveform
