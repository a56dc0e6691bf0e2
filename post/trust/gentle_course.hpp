// The course of a tool's speed that starts and stops gently, from how much of the fabric the tool moves on its way.
//
// Let p run from 0 to 1 over the tool's way, and K be the fabric's kinetic energy. At each p the fabric follows the tool
// with a mass of its own, K = M(p) (dp/dt)^2 / 2, so that any run tells M = 2 K / (dp/dt)^2. Inertia adds dK/dp to the
// force along the way (inertia.hpp). Of all courses from a rest on whose |dK/dp| nowhere passes a bound while K rises, nor
// another while it falls, the fastest has them everywhere: K rises evenly and falls evenly,
//   K(p) = K_m p/p_m  up to p_m,   K_m (1 - (1 - k)(p - p_m)/(1 - p_m))  from there on,   dp/dt = sqrt(2 K(p)/M(p)) .
// With a mass that stays the same that is a speed that grows and falls evenly in time. A punch meets little fabric at
// first and moves the whole flange at last: it begins fast and becomes slower and slower.
// Mass-proportional damping adds 2 alpha K/(dp/dt) all the way, to what the rise takes and off what the fall gives: with
// the program's own damping the two come out alike for a rise over five eighths of the way. At the end an energy of
// k = 1/16 is left, a quarter of the speed: friction that comes to rest lets go of the fabric, and the last stretch to
// rest would take a third of the time. Both were chosen by measured forces (docs/stability.md).
#pragma once

#include <string>
#include <vector>

#include "solver/result/result.hpp"

namespace weaveform {

// [part of the duration, relative speed] as the `speed` of a tool has them, with three decimals, the greatest speed 1;
// from the history of a run in which `tool` made its whole way, at any course. Masses are means between the halves of
// the gaps to the neighbouring points, and an eighth of the greatest at least. None where nothing moved. Throws
// InputError when the history lacks a column.
[[nodiscard]] std::vector<std::vector<double>> gentle_course(const History& history, const std::string& tool);

}  // namespace weaveform
