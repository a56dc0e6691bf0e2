#include "core/instructions/choose_loops.hpp"
#include "solver/lattice/row_kernels.hpp"

namespace weaveform {

WEAVEFORM_CHOOSE_LOOPS(RowLoops, row_loops)

const RowLoops& loops_of_rows() {
  return chosen_row_loops();
}

YarnKernels yarn_kernels(Section section, bool paper) {
  return chosen_row_loops().yarn_kernels(section, paper);
}

CellKernels cell_kernels(Formulation formulation, Thickness thickness, ShearShape shape) {
  return chosen_row_loops().cell_kernels(formulation, thickness, shape);
}

HistoryCellKernels history_cell_kernels(Frame frame, Thickness thickness, ShearShape shape) {
  return chosen_row_loops().history_cell_kernels(frame, thickness, shape);
}

void assemble_row(const double* along, const double* across, const double* p, const double* q, double* carry,
                  double* force, int begin, int end) {
  chosen_row_loops().assemble_row(along, across, p, q, carry, force, begin, end);
}

void carry_row(const double* across, const double* p, const double* q, double* carry, int begin, int end) {
  chosen_row_loops().carry_row(across, p, q, carry, begin, end);
}

void advance(const double* inverse_mass, const double* mass, const double* force, double* velocity, double* position,
             double keep, double kick, double drift, int begin, int end, double* sums) {
  chosen_row_loops().advance(inverse_mass, mass, force, velocity, position, keep, kick, drift, begin, end, sums);
}

}  // namespace weaveform
