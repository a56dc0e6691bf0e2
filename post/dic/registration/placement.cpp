#include "post/dic/registration/placement.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>

#include "core/error.hpp"
#include "core/vector/angle.hpp"
#include "post/dic/registration/field_match.hpp"

namespace weaveform::dic {
namespace {

Placement by_marks(const RegistrationSpec& spec) {
  std::vector<Vec2> from, to;
  for (const auto& mark : spec.measured_marks) from.push_back({mark[0], mark[1]});
  for (const auto& mark : spec.simulated_marks) to.push_back({mark[0], mark[1]});
  Placement placement;
  placement.reference = placement.current = rigid_fit(from, to);
  placement.method = fmt::format("{} marks, least squares", from.size());
  placement.used = static_cast<int>(from.size());
  for (std::size_t k = 0; k < from.size(); ++k) {
    const Vec2 at = placement.reference.moved(from[k]);
    placement.residual += std::pow(at[0] - to[k][0], 2) + std::pow(at[1] - to[k][1], 2);
  }
  placement.residual = std::sqrt(placement.residual / static_cast<double>(from.size()));
  return placement;
}

// The blank's x axis points at `angle` in the measurement, so the measurement turns back by it.
RigidMotion by_axes(const Vec2& origin, double angle) {
  RigidMotion motion;
  motion.angle = 0.0 - angle;  // 0 stays 0, not -0
  const Vec2 turned = motion.turned(origin);
  motion.shift = {0.0 - turned[0], 0.0 - turned[1]};
  return motion;
}

}  // namespace

RigidMotion rigid_fit(const std::vector<Vec2>& from, const std::vector<Vec2>& to) {
  Vec2 a = {0.0, 0.0}, b = {0.0, 0.0};
  const auto count = static_cast<double>(from.size());
  for (std::size_t i = 0; i < from.size(); ++i)
    for (std::size_t k = 0; k < 2; ++k) {
      a[k] += from[i][k] / count;
      b[k] += to[i][k] / count;
    }
  double along = 0.0, across = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const double px = from[i][0] - a[0], py = from[i][1] - a[1], qx = to[i][0] - b[0], qy = to[i][1] - b[1];
    along += px * qx + py * qy;
    across += px * qy - py * qx;
  }
  RigidMotion motion;
  motion.angle = std::atan2(across, along);
  const Vec2 turned = motion.turned(a);
  motion.shift = {b[0] - turned[0], b[1] - turned[1]};
  return motion;
}

Placement place(const MeasuredStage& stage, const Simulation& simulation, const SimulatedState& state,
                const RegistrationSpec& spec, double facet_size) {
  if (spec.method == RegistrationMethod::least_squares) return match_field(stage, simulation, state, spec, facet_size);
  Placement placement;
  if (spec.method == RegistrationMethod::marks) {
    placement = by_marks(spec);
  } else if (spec.method == RegistrationMethod::axes) {
    placement.reference = placement.current = by_axes(spec.origin, spec.angle.value_or(0.0) * degree);
    placement.method = "specimen axes as given";
  } else {
    placement.method = "none: the measurement's frame is taken for the blank's";
  }
  return placement;
}

RigidMotion follow(const MeasuredStage& stage, const Simulation& simulation, const SimulatedState& state,
                   const RigidMotion& reference, double reject) {
  std::vector<Vec2> from, points;
  for (std::size_t i = 0; i < stage.size(); ++i) {
    if (!stage.valid[i] || !std::isfinite(stage.displacement_field[i][0])) continue;
    const Vec3 &p = stage.reference[i], &u = stage.displacement_field[i];
    points.push_back(reference.moved({p[0], p[1]}));
    from.push_back({p[0] + u[0], p[1] + u[1]});
  }
  const Sampling sampling = sample_points(simulation.flat(), points);
  std::vector<Vec2> here, there;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!sampling.found(i)) continue;
    const Vec3 u = sampling.value(i, state.displacement);
    here.push_back(from[i]);
    there.push_back({points[i][0] + u[0], points[i][1] + u[1]});
  }
  RigidMotion motion = rigid_fit(here, there);
  // Twice again without the points that do not fit.
  for (int again = 0; again < 2; ++again) {
    std::vector<double> distance;
    for (std::size_t i = 0; i < here.size(); ++i) {
      const Vec2 at = motion.moved(here[i]);
      distance.push_back(std::hypot(at[0] - there[i][0], at[1] - there[i][1]));
    }
    const double limit = reject * robust_deviation(distance);
    std::vector<Vec2> kept, target;
    for (std::size_t i = 0; i < here.size(); ++i)
      if (distance[i] <= limit) {
        kept.push_back(here[i]);
        target.push_back(there[i]);
      }
    if (kept.size() >= 3) motion = rigid_fit(kept, target);
  }
  return motion;
}

}  // namespace weaveform::dic
