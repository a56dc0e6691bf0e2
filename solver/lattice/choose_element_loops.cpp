#include "core/instructions/choose_loops.hpp"
#include "solver/lattice/element_loops.hpp"

namespace weaveform {

WEAVEFORM_CHOOSE_LOOPS(ElementLoops, loops_of_elements)

const ElementLoops& element_loops() {
  return chosen_loops_of_elements();
}

}  // namespace weaveform
