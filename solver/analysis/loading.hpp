// How fast to load and how much to damp, when the scene leaves it to us.
//
// The loads of a fabric specimen are a few newtons, so inertia and damping forces of an explicit run show in them long
// before they show in the energies. Both scale with how often the fabric's slowest wave, in-plane shear at the least
// tangent of the card, crosses the blank during the run:
//   tau      = L / sqrt(C_min t / (area density))
//   duration = crossings * tau * sqrt(max(1, 8 travel/L))
//   damping  = decays / duration
// The two constants were chosen from measured load errors (docs/theory.md, "Loading speed and damping").
//
// Where only its own weight moves the fabric, it is to come to rest: with omega the slowest sway of the blank's length
// as a cantilever, stiff (beam, 1.875^4 = 12.36) or limp (hanging chain, (2.405/2)^2 = 1.446),
//   omega^2  = max(12.36 D/(area density L^4), 1.446 g/L)
//   damping  = 2 omega (critical)
//   duration = settling / omega ,
// which leaves (1 + 12) exp(-12) = 1e-4 of the way. A bending law that softens is taken where the load has it: at the
// moment of the whole weight on the whole length, w L^2/2, and D is the least of its stiffness at rest, its secant and
// its tangent there. Damped by more than what is left of its stiffness, a strip would creep and be stopped on the way;
// damped by less, it swings and comes to rest as fast. A strip that has yielded at the clamp is hinged there by a
// moment that hardly grows: down by an angle theta it sways with omega^2 = 3/2 g/L sin(theta), so that of g/L only a
// quarter counts (theta = 14 deg); a law that does not soften has all of it.
#pragma once

#include <array>
#include <string>

#include "fabric/card/card.hpp"
#include "mesher/resolve/resolved.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

inline constexpr double default_crossings = 16.0;
inline constexpr double default_decays = 2.0;
inline constexpr double default_settling = 12.0;
inline constexpr double default_tool_speed = 1000.0;  // mm/s; greatest, of forming tools

struct Loading {
  double crossing_time = 0.0;  // s; tau
  double duration = 0.0;       // s
  double damping = 0.0;        // 1/s; mass-proportional
};

// A duration below this share of the automatic one is the first to blame when an analysis breaks down: inertia forces
// go with the square of the speed, 25 times those of the automatic one.
inline constexpr double hasty_share = 0.2;

// s; the duration of choose_loading when the scene names neither duration nor speed.
// `extent` (mm) is the blank's along its own axes (mesher/outline/blank_outline.hpp).
[[nodiscard]] double automatic_duration(const Scene& scene, const Card& card, const std::array<double, 2>& extent);

[[nodiscard]] Loading choose_loading(const Scene& scene, const Card& card, const std::array<double, 2>& extent);

// The same of a scene with all its plies: those of the ply that wants the longest duration.
[[nodiscard]] double automatic_duration(const Resolved& model);
[[nodiscard]] Loading choose_loading(const Resolved& model);

// One line on the duration of a scene that gives neither duration nor loading_speed: how long, by what, and what else may
// be asked for. "" of any other scene.
[[nodiscard]] std::string describe_automatic_duration(const Resolved& model);

}  // namespace weaveform
