// What the machine can do at best, measured: arithmetic of a given mix from registers, and bytes from memory.
#pragma once

namespace weaveform {

// G operations/s of one core in double precision: sums and products in equal parts on independent numbers, not fused; and
// divisions.
[[nodiscard]] double arithmetic_rate(double seconds);
[[nodiscard]] double division_rate(double seconds);

// GB/s of one core: x = x + a v over arrays of `doubles` numbers each, bytes read and written.
[[nodiscard]] double memory_rate(long doubles, double seconds);

}  // namespace weaveform
