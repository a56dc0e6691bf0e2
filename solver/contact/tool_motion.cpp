#include "solver/contact/tool_motion.hpp"

#include <algorithm>

#include "solver/constraint/grips.hpp"

namespace weaveform {
namespace {

// Integral of the speed table up to part x.
double way(const std::vector<std::vector<double>>& speed, double x) {
  double sum = 0.0;
  for (std::size_t n = 1; n < speed.size(); ++n) {
    const double from = speed[n - 1][0], to = speed[n][0];
    if (x <= from) break;
    const double end = std::min(x, to), t = (end - from) / (to - from);
    const double at_end = speed[n - 1][1] + t * (speed[n][1] - speed[n - 1][1]);
    sum += 0.5 * (end - from) * (speed[n - 1][1] + at_end);
  }
  return sum;
}

}  // namespace

double travel_part(const std::vector<std::vector<double>>& speed, double x) {
  return speed.empty() ? smooth_step(x) : way(speed, x) / way(speed, 1.0);
}

double greatest_slope(const std::vector<std::vector<double>>& speed) {
  if (speed.empty()) return smooth_step_greatest_slope;
  double greatest = 0.0;
  for (const auto& point : speed) greatest = std::max(greatest, point[1]);
  return greatest / way(speed, 1.0);
}

ToolMotion::ToolMotion(const ToolSpec& spec, double duration, double mass)
    : travel_(spec.travel),
      duration_(duration),
      mass_(mass),
      damping_(spec.damping),
      speed_(spec.speed),
      force_(spec.force) {}

double ToolMotion::force_at(double time) const {
  return *force_ * smooth_step(time / (force_rise * duration_));
}

void ToolMotion::advance(double time, double step, double reaction) {
  if (step <= 0.0) return;
  if (pushed()) {
    const double force = force_at(time - step);
    const double kick = 0.5 * (state_.step + step), half = 0.5 * damping_ * kick;
    const double before = state_.velocity, way_before = state_.way;
    state_.velocity = ((1.0 - half) * before + kick * (force - reaction) / mass_) / (1.0 + half);
    state_.way = step * state_.velocity;
    state_.displacement += state_.way;
    state_.work += 0.5 * (force + force_at(time)) * state_.way;
    // its work over half the way before and half the way after, as the step has it (contact_kernel.hpp)
    const double drag = damping_ * mass_ * 0.5 * (before + state_.velocity);
    state_.damping_work += 0.5 * drag * (way_before + state_.way);
  } else {
    const double displacement = travel_ * travel_part(speed_, time / duration_);
    state_.way = displacement - state_.displacement;
    state_.displacement = displacement;
    state_.velocity = state_.way / step;
  }
  state_.step = step;
}

void ToolMotion::add_travel_work(double reaction_before, double reaction) {
  if (!pushed()) state_.work += 0.5 * (reaction_before + reaction) * state_.way;
}

double ToolMotion::kinetic_energy(double time, double reaction) const {
  if (!pushed()) return 0.0;
  const double acceleration = (force_at(time) - reaction) / mass_ - damping_ * state_.velocity;
  // m v- v+/2: from one step to the next it grows by (F_n + F_n+1)/2 . way, which is how every work is counted here
  return 0.5 * mass_ * state_.velocity * (state_.velocity + state_.step * acceleration);
}

void ToolMotion::archive(Archive& archive) {
  for (double* value :
       {&state_.displacement, &state_.velocity, &state_.step, &state_.way, &state_.work, &state_.damping_work})
    archive.number("a tool's motion", *value);
}

}  // namespace weaveform
