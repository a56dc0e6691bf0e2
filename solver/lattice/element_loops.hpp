// The inner loop: the elements of some rows of the lattice in blocks of eight slots (bands.hpp), and the listed ones
// (yarn ends, cut cells) one after another, by the same bodies. Compiled once for each instruction set
// (core/instructions), each compilation for itself: it must include nothing whose inline code other files share.
//
// In double or in single precision. Single precision is that of what an element computes and of the forces that it
// returns. Differences of positions, and those of a yarn's squared lengths, which its strain hangs on, are taken in double
// precision and then narrowed, so that no digit is lost where a blank is large; powers are summed in double precision.
// What is left is the rounding of a force, some 1e-7 of it.
//
// Where a scene is flat, all z and all velocities along it zero, loops over x and y alone give the same bits in three
// quarters of the time. They leave z's arrays as they are.
#pragma once

#include "solver/element/incremental_cell.hpp"
#include "solver/element/kernel_law.hpp"
#include "solver/element/lanes.hpp"
#include "solver/element/shear_cell.hpp"
#include "solver/element/yarn.hpp"
#include "solver/lattice/slot_blocks.hpp"

namespace weaveform {

// Where the nodes are and how they move: packed arrays of the three components.
struct NodeArrays {
  const double* position[3];
  const double* velocity[3];
};

// Sums are kept for each lane, so that no block ends with one.
struct YarnLanes {
  double power[lane_count];     // mJ/s; of their viscosity
  double shortest[lane_count];  // 1; least and greatest (L/L0)^2, now and `ahead`, unstretched included
  double longest[lane_count];
};
// Viscosity (MPa s) is that of yarn.hpp; lengths `ahead` (s) go on at their present rate.
struct YarnStep {
  double viscosity;
  double ahead;
};

// Yarn elements of the lattice, from the node at slot n to that at n + next.
struct RowYarns {
  SlotBlocks slots;
  int next;
  double rest;            // mm
  const double* section;  // mm^2; per slot
};
// Listed ones, from node0 to node1 (LooseYarns of packed.hpp), in whole blocks.
struct ListedYarns {
  int blocks;
  const int *node0, *node1;
  const double *length, *jaw, *section;
};
// t[c] = force on the first node (N), the opposite on the second.
template <class Yarns, class Real>
using YarnLoop = void (*)(const void* law, const Yarns& yarns, const NodeArrays& nodes, const YarnStep& step,
                          Real* const (&t)[3], YarnLanes& lanes);

// Greatest sin^2 gamma of cells.
struct CellLanes {
  double sharpest[lane_count];
};

// Cells of the lattice between the nodes n, n + 1, n + next, n + next + 1 of slot n:
//   p[c] = force on n         (the opposite on n + next + 1)
//   q[c] = force on n + next  (the opposite on n + 1)
struct RowCells {
  SlotBlocks slots;
  int next;
  double inverse_spacing[2];  // 1/mm
  const double* area;         // mm^2; per slot
};
template <class Real>
struct RowCellForces {
  Real* p[3];
  Real* q[3];
};
// Listed ones (LooseCells of packed.hpp), in whole blocks: forces conjugate to their directions.
struct ListedCells {
  int blocks;
  const int* node;            // width per cell
  const double *warp, *weft;  // coefficients, width per cell
  const double* area;
};
template <class Real>
struct ListedCellForces {
  Real* warp[3];
  Real* weft[3];
};
template <class Cells, class Forces>
using CellLoop = void (*)(const void* shear, const Cells& cells, double thickness, const NodeArrays& nodes,
                          const Forces& forces, CellLanes& lanes);

// Cells with a history: one array per member of CellHistory, in its order, read from before[n] and written to
// after[n - after_origin] (different arrays, so that two threads may both compute the row between their bands). There is
// none in the slots between elements: a loop goes from begin to end, over nothing but cells.
struct HistoryArrays {
  const double* before[cell_history_size];
  double* after[cell_history_size];
  int after_origin;
};
template <class Cells, class Forces>
using HistoryCellLoop = void (*)(const void* shear, const Cells& cells, double thickness, int begin, int end,
                                 const NodeArrays& nodes, const HistoryArrays& history, const Forces& forces,
                                 CellLanes& lanes);

// `near` is right where all that it finds is near (L/L0)^2 = 1 (half_log.hpp), with the bits of `any`.
template <class Yarns, class Real>
struct YarnLoopsOver {
  YarnLoop<Yarns, Real> near = nullptr;
  YarnLoop<Yarns, Real> any = nullptr;
};
template <class Real>
struct YarnLoops {
  YarnLoopsOver<RowYarns, Real> row;
  YarnLoopsOver<ListedYarns, Real> listed;
};
template <class Real>
struct CellLoops {
  CellLoop<RowCells, RowCellForces<Real>> row = nullptr;
  CellLoop<ListedCells, ListedCellForces<Real>> listed = nullptr;
};
struct HistoryCellLoops {
  HistoryCellLoop<RowCells, RowCellForces<double>> row;
  HistoryCellLoop<ListedCells, ListedCellForces<double>> listed;
};

// The shear laws the loops are compiled for.
using PaperShear = KernelShear<PaperShearLaw, false>;
using StartedShear = KernelShear<PaperShearLaw>;
using GeneralShear = KernelShear<GeneralLaw>;
enum class ShearShape { paper, started, general };

// `paper` says that the law at hand is a PaperLaw; otherwise it is a GeneralLaw.
template <class Real>
struct LoopsOf {
  YarnLoops<Real> (*yarns)(Section section, bool paper);
  CellLoops<Real> (*cells)(Formulation formulation, Thickness thickness, ShearShape shape);
};

// One compilation of all of it (core/instructions/choose_loops.hpp). Cells with a history are computed in double
// precision, for they add up what every step brings.
struct ElementLoops {
  LoopsOf<double> of_double;
  LoopsOf<float> of_single;
  LoopsOf<double> flat;  // compiled for the paper's laws in their default forms; null for others
  HistoryCellLoops (*history_cells)(Frame frame, Thickness thickness, ShearShape shape);

  template <class Real>
  [[nodiscard]] const LoopsOf<Real>& of() const {
    if constexpr (sizeof(Real) == sizeof(double))
      return of_double;
    else
      return of_single;
  }
};

// The one for this processor.
[[nodiscard]] const ElementLoops& element_loops();

}  // namespace weaveform
