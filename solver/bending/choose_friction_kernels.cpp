#include "core/instructions/choose_loops.hpp"
#include "solver/bending/friction_kernels.hpp"

namespace weaveform {

WEAVEFORM_CHOOSE_LOOPS(FrictionLoops, friction_table)

const FrictionLoops& friction_loops() {
  return chosen_friction_table();
}

}  // namespace weaveform
