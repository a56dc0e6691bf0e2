// A folded cell is turned over: its yarns cross wrongly, and no fabric is like that. It can carry nearly the right
// load, so that the load does not tell (docs/stability.md, compression of yarns).
#include <fmt/format.h>

#include "post/trust/borders.hpp"

namespace weaveform {

void warn_of_folded_cells(const FinishedRun& run, Warnings& warnings) {
  const SolveStatistics& s = run.summary.statistics;
  if (s.folded_cells_at_end == 0) return;
  warnings.push_back(fmt::format(
      "{} of {} cells are folded over at the end (`folded` in the last frame shows where): angles there are "
      "those of a tangle; give the cells bending (model.cell) or the yarns more compression "
      "(model.compression_modulus), or move less far",
      s.folded_cells_at_end, s.cells));
}

}  // namespace weaveform
