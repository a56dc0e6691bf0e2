// A plain loop over a structured trellis, the mark that the solver's rates are told against: one membrane of one point
// and two trusses a node, a constant number of nodes a row, plain arrays, relaxed floating point, a cubic law and a
// logarithm of one cell's strain; no contact, no grips, no energies, no viscosity, nothing watched.
#pragma once

namespace weaveform {

// Million cell-steps per second on an n x n trellis, over at least `seconds`.
template <class Real>
[[nodiscard]] double plain_loop_rate(int n, double seconds);

}  // namespace weaveform
