// How much of the loads is inertia. What moves the fabric (grips, frame, tools) does work on it, per time
//   sum_i F_i v_i = d(stored)/dt + friction + dK/dt + 2 alpha K ,
// K the kinetic energy and alpha the mass-proportional damping. Loaded slowly, the fabric passes through the same
// states at the same displacements, and the last two terms are gone: with one part that moves, x its way,
//   F - F_slow = d(K + integral 2 alpha K dt)/dx .
// That is exact but for what inertia changes of the states themselves. With several, each is weighed by its greatest
// load F_i: with the measure of the way S = sum_i F_i |x_i|, the share of the loads is d(K + ...)/dS.
#pragma once

#include "mesher/scene/scene.hpp"
#include "solver/result/result.hpp"

namespace weaveform {

inline constexpr double inertia_window = 1.0 / 20.0;  // of S; the share is a mean over so much of the way
inline constexpr double inertia_begins = 1.0 / 10.0;  // of S; before, most fabrics are slack and loads are nothing

struct InertiaShare {
  double share = 0.0;           // 1; greatest in size over the windows
  double from = 0.0, to = 0.0;  // s; that window
};

// None (0) where nothing travels, or where gravity or a perturbed start set the fabric in motion, so that its kinetic
// energy is not the loading's. Throws InputError when the history lacks a column.
[[nodiscard]] InertiaShare inertia_share(const Scene& scene, const History& history, double damping);

}  // namespace weaveform
