// The inner loop: the elements of some rows of the lattice in blocks of eight slots (bands.hpp), and the listed ones
// (yarn ends, cut cells) one after another, by the same bodies. Compiled once for each instruction set
// (core/instructions), each compilation for itself: it must include nothing whose inline code other files share.
#pragma once

#include "solver/element/incremental_cell.hpp"
#include "solver/element/kernel_law.hpp"
#include "solver/element/lanes.hpp"
#include "solver/element/shear_cell.hpp"
#include "solver/element/yarn.hpp"

namespace weaveform {

// Where the nodes are and how they move: packed arrays of the three components.
struct NodeArrays {
  const double* position[3];
  const double* velocity[3];
};

// The slots of a row or more: `count` blocks, block[k] the packed index of the first slot of one. What is computed goes
// to index slot - origin of the output.
struct SlotBlocks {
  const int* block;
  int count;
  int origin;
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
template <class Yarns>
using YarnLoop = void (*)(const void* law, const Yarns& yarns, const NodeArrays& nodes, const YarnStep& step,
                          double* const (&t)[3], YarnLanes& lanes);

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
struct RowCellForces {
  double* p[3];
  double* q[3];
};
// Listed ones (LooseCells of packed.hpp), in whole blocks: forces conjugate to their directions.
struct ListedCells {
  int blocks;
  const int* node;            // width per cell
  const double *warp, *weft;  // coefficients, width per cell
  const double* area;
};
struct ListedCellForces {
  double* warp[3];
  double* weft[3];
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

struct YarnLoops {
  YarnLoop<RowYarns> row;
  YarnLoop<ListedYarns> listed;
};
struct CellLoops {
  CellLoop<RowCells, RowCellForces> row;
  CellLoop<ListedCells, ListedCellForces> listed;
};
struct HistoryCellLoops {
  HistoryCellLoop<RowCells, RowCellForces> row;
  HistoryCellLoop<ListedCells, ListedCellForces> listed;
};

// The shear laws the loops are compiled for.
using PaperShear = KernelShear<PaperShearLaw, false>;
using StartedShear = KernelShear<PaperShearLaw>;
using GeneralShear = KernelShear<GeneralLaw>;
enum class ShearShape { paper, started, general };

// The force on the node of each slot n, from the elements of its row at slot n - origin and of the row below at
// n - below_origin of theirs:
//   f = along[n] - along[n-1] + p[n] - q[n-1] + across[n]  +  q'[n'] - p'[n'-1] - across'[n'] ,  n' = n - next below
struct RowForces {
  const double *along[3], *across[3], *p[3], *q[3];
  int origin;
};
using AssembleLoop = void (*)(const int* block, int count, int next, const RowForces& here, const RowForces& below,
                              double* const (&force)[3]);

// Zero in the blocks of each of the arrays.
using ClearLoop = void (*)(const SlotBlocks& slots, double* const* arrays, int count);

// One leapfrog step of nodes (Newmark 1959, beta = 0, velocities at half steps), in each component
//   v+ = keep * v- + kick * f / m ,   x+ = x + drift * v+
// and, into the lanes of `sums`, m v0^2 with v0 = (v- + v+)/2.
struct NodeMotion {
  const double *inverse_mass, *mass;  // 1/tonne, tonne; 0 where no node is
  const double* force[3];             // N
  double* velocity[3];
  double* position[3];
};
struct LeapfrogStep {
  double keep, kick, drift;  // 1, s, s
};
// Of the nodes in [begin[r], end[r]).
using AdvanceLoop = void (*)(const NodeMotion& nodes, const LeapfrogStep& step, const int* begin, const int* end,
                             int ranges, double (&sums)[lane_count]);

// One compilation of all of it (core/instructions/choose_loops.hpp). `paper` says that the law at hand is a PaperLaw;
// otherwise it is a GeneralLaw.
struct ElementLoops {
  YarnLoops (*yarns)(Section section, bool paper);
  CellLoops (*cells)(Formulation formulation, Thickness thickness, ShearShape shape);
  HistoryCellLoops (*history_cells)(Frame frame, Thickness thickness, ShearShape shape);
  ClearLoop clear;
  AssembleLoop assemble;
  AdvanceLoop advance;
};

// The one for this processor.
[[nodiscard]] const ElementLoops& element_loops();

}  // namespace weaveform
