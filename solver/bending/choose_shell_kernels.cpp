#include "core/instructions/choose_loops.hpp"
#include "solver/bending/shell_kernels.hpp"

namespace weaveform {

WEAVEFORM_CHOOSE_LOOPS(ShellLoops, shell_loops)

EdgeKernels edge_kernels(MomentShape shape) {
  return chosen_shell_loops().edge_kernels(shape);
}

void shell_twist_row(const ShellRows& rows, double inverse_spacing1, double inverse_spacing2, const double* stiffness,
                     int begin, int end, const ShellTwistOutput& out) {
  chosen_shell_loops().shell_twist_row(rows, inverse_spacing1, inverse_spacing2, stiffness, begin, end, out);
}

void shell_position_assemble(const double* along, const double* across, const double* across_below, const double* p,
                             const double* q, const double* p_below, const double* q_below, double* force, int begin,
                             int end) {
  chosen_shell_loops().shell_position_assemble(along, across, across_below, p, q, p_below, q_below, force, begin, end);
}

void shell_director_assemble(const DirectorRow& row, double* force, int begin, int end) {
  chosen_shell_loops().shell_director_assemble(row, force, begin, end);
}

void drift_directors(double* const (&d)[3], double* const (&v)[3], double time, int begin, int end) {
  chosen_shell_loops().drift_directors(d, v, time, begin, end);
}

void kick_directors(const double* const (&d)[3], double* const (&v)[3], const double* const (&force)[3],
                    const double* inertia, const double* inverse_inertia, double keep, double kick, int begin, int end,
                    double* sums) {
  chosen_shell_loops().kick_directors(d, v, force, inertia, inverse_inertia, keep, kick, begin, end, sums);
}

}  // namespace weaveform
