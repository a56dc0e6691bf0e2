// The inner loop: elements begin <= i < end of one row. Compiled once for each instruction set
// (core/instructions), each compilation for itself: it must include nothing whose inline code other files share.
#pragma once

#include "solver/element/incremental_cell.hpp"
#include "solver/element/kernel_law.hpp"
#include "solver/element/shear_cell.hpp"
#include "solver/element/yarn.hpp"

namespace weaveform {

// Read pointers of the three components at the first and the second row (or the same row shifted by one).
struct RowPair {
  const double* a[3];
  const double* b[3];
};

// Over the yarn elements of one call.
struct YarnSums {
  double power = 0.0;                    // mJ/s; of their viscosity
  double shortest = 1.0, longest = 1.0;  // 1; least and greatest (L/L0)^2, now and `ahead`, unstretched included
};

// Yarn elements from a[i] to b[i]: t[c][i] = force on node a (N), the opposite on node b. `velocity` pairs up like
// `rows`; `viscosity` (MPa s) is that of yarn.hpp; lengths `ahead` (s) go on at their present rate.
using YarnRow = YarnSums (*)(const void* law, const RowPair& rows, const RowPair& velocity, double rest,
                             double viscosity, double ahead, const double* area, int begin, int end,
                             double* const (&t)[3]);

// Cells with corners lower[i], lower[i+1], upper[i], upper[i+1]:
//   p[c][i] = force on lower[i]   (the opposite on upper[i+1])
//   q[c][i] = force on upper[i]   (the opposite on lower[i+1])
// Every loop over cells returns the greatest sin^2 gamma among them.
struct CellRowOutput {
  double* p[3];
  double* q[3];
};
using CellRow = double (*)(const void* shear, const RowPair& rows, double inverse_spacing1, double inverse_spacing2,
                           const double* area, double thickness, int begin, int end, const CellRowOutput& out);

// Loose elements (yarn ends, cut cells), one by one in vector lanes by gathering.
struct LooseYarnView {
  int count;
  const int *node0, *node1;
  const double *length, *jaw, *section;
};
using LooseYarnLoop = YarnSums (*)(const void* law, const LooseYarnView& yarns, double viscosity, double ahead,
                                   const double* const (&x)[3], const double* const (&v)[3], double* const (&t)[3]);
struct LooseCellView {
  int count;
  const int* node;            // width per cell
  const double *warp, *weft;  // coefficients, width per cell
  const double* area;
};
using LooseCellLoop = double (*)(const void* shear, const LooseCellView& cells, double thickness,
                                 const double* const (&x)[3], double* const (&warp_force)[3],
                                 double* const (&weft_force)[3]);

// The same for cells with a history: one array per member of CellHistory, in its order, read from `before` and written
// to `after` (different arrays, so that two threads may both compute the row between their blocks).
struct HistoryArrays {
  const double* before[cell_history_size];
  double* after[cell_history_size];
};
using HistoryCellRow = double (*)(const void* shear, const RowPair& rows, double inverse_spacing1,
                                  double inverse_spacing2, const double* area, double thickness, int begin, int end,
                                  const HistoryArrays& history, const CellRowOutput& out);
using HistoryLooseCellLoop = double (*)(const void* shear, const LooseCellView& cells, double thickness,
                                        const double* const (&x)[3], const HistoryArrays& history,
                                        double* const (&warp_force)[3], double* const (&weft_force)[3]);

struct YarnKernels {
  YarnRow row;
  LooseYarnLoop loose;
};
struct CellKernels {
  CellRow row;
  LooseCellLoop loose;
};

struct HistoryCellKernels {
  HistoryCellRow row;
  HistoryLooseCellLoop loose;
};

// The shear laws the loops are compiled for.
using PaperShear = KernelShear<PaperShearLaw, false>;
using StartedShear = KernelShear<PaperShearLaw>;
using GeneralShear = KernelShear<GeneralLaw>;
enum class ShearShape { paper, started, general };

// `paper` says that the law at hand is a PaperLaw; otherwise it is a GeneralLaw.
[[nodiscard]] YarnKernels yarn_kernels(Section section, bool paper);
[[nodiscard]] CellKernels cell_kernels(Formulation formulation, Thickness thickness, ShearShape shape);
[[nodiscard]] HistoryCellKernels history_cell_kernels(Frame frame, Thickness thickness, ShearShape shape);

// f[i] = along[i] - along[i-1] + p[i] - q[i-1] + across[i] + carry[i], and the carry for the next row,
// carry[i] = q[i] - p[i-1] - across[i]; arrays are readable at begin - 1.
void assemble_row(const double* along, const double* across, const double* p, const double* q, double* carry,
                  double* force, int begin, int end);
void carry_row(const double* across, const double* p, const double* q, double* carry, int begin, int end);

// One leapfrog step of nodes begin <= n < end in one component (Newmark 1959, beta = 0, velocities at half steps):
//   v+ = keep * v- + kick * f / m ,   x+ = x + drift * v+
// and, into `sums`, m v0^2 with v0 = (v- + v+)/2, in eight fixed lanes.
void advance(const double* inverse_mass, const double* mass, const double* force, double* velocity, double* position,
             double keep, double kick, double drift, int begin, int end, double* sums);

// One compilation of the functions above (core/instructions/choose_loops.hpp).
struct RowLoops {
  decltype(&weaveform::yarn_kernels) yarn_kernels;
  decltype(&weaveform::cell_kernels) cell_kernels;
  decltype(&weaveform::history_cell_kernels) history_cell_kernels;
  decltype(&weaveform::assemble_row) assemble_row;
  decltype(&weaveform::carry_row) carry_row;
  decltype(&weaveform::advance) advance;
};

// The one for this processor: for who calls row by row, and does not want to ask each time.
[[nodiscard]] const RowLoops& loops_of_rows();

}  // namespace weaveform
