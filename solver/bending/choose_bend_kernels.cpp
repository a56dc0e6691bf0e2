#include "core/instructions/choose_loops.hpp"
#include "solver/bending/bend_kernels.hpp"

namespace weaveform {

WEAVEFORM_CHOOSE_LOOPS(BendLoops, bend_loops)

BendKernels bend_kernels(MomentShape shape, bool isotropic) {
  return chosen_bend_loops().bend_kernels(shape, isotropic);
}

void twist_row(const BendRows& rows, const double* stiffness, int begin, int end, const TwistRowOutput& out) {
  chosen_bend_loops().twist_row(rows, stiffness, begin, end, out);
}

void bend_assemble(const double* centre, const double* warp_after, const double* warp_before,
                   const double* below_weft_after, const double* above_weft_before, double* force, int begin, int end) {
  chosen_bend_loops().bend_assemble(centre, warp_after, warp_before, below_weft_after, above_weft_before, force, begin,
                                    end);
}

void twist_assemble(const double* a, const double* d, const double* e, const double* below_a, const double* below_d,
                    const double* below_e, double* force, int begin, int end) {
  chosen_bend_loops().twist_assemble(a, d, e, below_a, below_d, below_e, force, begin, end);
}

}  // namespace weaveform
