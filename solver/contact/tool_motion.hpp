// How a rigid tool moves: along its direction, by a prescribed way or pushed by a force.
#pragma once

#include <optional>
#include <vector>

#include "mesher/scene/scene.hpp"
#include "solver/state/archive.hpp"

namespace weaveform {

// Part of the travel made after part x of the duration: the integral of the speed table over its whole, or the smooth
// step where the table is empty. 0 at 0, 1 at 1.
[[nodiscard]] double travel_part(const std::vector<std::vector<double>>& speed, double x);
// Its greatest slope: greatest speed = slope * travel / duration.
[[nodiscard]] double greatest_slope(const std::vector<std::vector<double>>& speed);

// A force comes on by a smooth step over this part of the duration: sudden, it would hammer the tool on the fabric.
inline constexpr double force_rise = 0.03;

// One tool's motion along its direction. Times of a step as in motion.hpp: the velocity is that of the step just made,
// half a step behind the displacement.
class ToolMotion {
public:
  // `mass` (tonne) moves a tool pushed by a force.
  ToolMotion(const ToolSpec& spec, double duration, double mass);

  // To `time`, `step` later than the call before (s); `reaction` is the tool's force on the fabric along its direction
  // at the time left (N). A pushed tool takes a leapfrog step with
  //   mass * acceleration = force - reaction - damping * mass * velocity,
  // its viscous force taken half before and half after the kick, as for the nodes (motion.hpp).
  void advance(double time, double step, double reaction);
  // Adds to the work of the outside on the tool what a prescribed way took: `reaction` at the ends of the step.
  void add_travel_work(double reaction_before, double reaction);

  [[nodiscard]] bool pushed() const { return force_.has_value(); }
  [[nodiscard]] double mass() const { return mass_; }                        // tonne
  [[nodiscard]] double displacement() const { return state_.displacement; }  // mm
  [[nodiscard]] double velocity() const { return state_.velocity; }          // mm/s
  // mJ; m v- v+/2 at the time of the last advance, which may be a little below zero where the tool turns
  [[nodiscard]] double kinetic_energy(double time, double reaction) const;
  [[nodiscard]] double work() const { return state_.work; }                  // mJ; put in from outside
  [[nodiscard]] double damping_work() const { return state_.damping_work; }  // mJ; of the guide

  struct State {
    double displacement = 0.0, velocity = 0.0, step = 0.0, way = 0.0, work = 0.0, damping_work = 0.0;
  };
  [[nodiscard]] const State& state() const { return state_; }
  void archive(Archive& archive);

private:
  [[nodiscard]] double force_at(double time) const;  // N
  double travel_, duration_, mass_, damping_;
  std::vector<std::vector<double>> speed_;
  std::optional<double> force_;
  State state_;
};

}  // namespace weaveform
