#include "post/dic/registration/field_match.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/error.hpp"
#include "core/vector/angle.hpp"
#include "post/dic/virtual/facet.hpp"

namespace weaveform::dic {
namespace {

constexpr std::size_t trial_points = 600, final_points = 20000;
constexpr int trial_steps = 12, final_steps = 30;

// The measured points of the match, thinned evenly to at most `count`.
struct Cloud {
  std::vector<Vec2> reference, current;
  Vec2 centre = {0.0, 0.0};
  std::vector<Vec2> levelling;  // mm; facet's minus point's simulated displacement, blank frame; empty: none
};

Cloud cloud_of(const MeasuredStage& stage, std::size_t count) {
  std::vector<std::size_t> good;
  for (std::size_t i = 0; i < stage.size(); ++i)
    if (stage.valid[i] && std::isfinite(stage.displacement_field[i][0])) good.push_back(i);
  Cloud cloud;
  const std::size_t taken = std::min(count, good.size());
  for (std::size_t k = 0; k < taken; ++k) {
    const std::size_t i = good[k * good.size() / taken];
    const Vec3 &p = stage.reference[i], &u = stage.displacement_field[i];
    cloud.reference.push_back({p[0], p[1]});
    cloud.current.push_back({p[0] + u[0], p[1] + u[1]});
    for (std::size_t c = 0; c < 2; ++c) cloud.centre[c] += p[c] / static_cast<double>(taken);
  }
  return cloud;
}

// Deformation gradient of each cell in the plane: takes its flat yarn directions to its present ones.
std::vector<Eigen::Matrix2d> cell_gradients(const FlatMesh& flat, const std::vector<Vec3>& displacement) {
  const MeshCells& cells = flat.mesh().cells;
  std::vector<Eigen::Matrix2d> gradient(cells.size());
  for (int cell = 0; cell < cells.size(); ++cell) {
    Eigen::Matrix2d before = Eigen::Matrix2d::Zero(), now = Eigen::Matrix2d::Zero();
    for (int a = cells.offset[cell]; a < cells.offset[cell + 1]; ++a) {
      const Vec2& x = flat.nodes()[cells.node[a]];
      const Vec3& u = displacement[cells.node[a]];
      for (int family = 0; family < 2; ++family) {
        const double c = cells.coefficient[a][static_cast<std::size_t>(family)];
        before.col(family) += c * Eigen::Vector2d(x[0], x[1]);
        now.col(family) += c * Eigen::Vector2d(x[0] + u[0], x[1] + u[1]);
      }
    }
    gradient[cell] = now * before.inverse();
  }
  return gradient;
}

// At most six unknowns, on the stack.
using Normal = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
using Unknowns = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
using Rows = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 6>;

// Unknowns: angle and shift of the reference, and of the current configuration where it is free.
struct Match {
  RigidMotion reference, current;
  double deviation = std::numeric_limits<double>::infinity();  // mm; robust, of a displacement component
  int used = 0, rejected = 0, off_fabric = 0;
  double sum_of_squares = 0.0;
  Normal normal;  // of the last step
};

class Matcher {
public:
  Matcher(const FlatMesh& flat, const SimulatedState& state, bool free, double reject)
      : flat_(flat), state_(state), gradient_(cell_gradients(flat, state.displacement)), free_(free), reject_(reject) {}

  // Gauss-Newton on r = R1 x + t1 - phi(R0 X + t0), phi the simulated motion; points off the fabric or beyond
  // `reject` robust deviations are left out of a step. Rotations are about the cloud's centre, to part them from
  // shifts.
  [[nodiscard]] Match run(const Cloud& cloud, Match match, int steps) const {
    for (int step = 0; step < steps; ++step) {
      const auto terms = residuals(cloud, match);
      if (!terms) return match;
      const int unknowns = free_ ? 6 : 3;
      Normal normal = Normal::Zero(unknowns, unknowns);
      Unknowns right = Unknowns::Zero(unknowns);
      for (const Term& term : *terms) {
        if (!term.used) continue;
        const Rows row = jacobian(term);
        normal += row.transpose() * row;
        right -= row.transpose() * term.residual;
      }
      match.normal = normal;
      // A field that leaves a direction open must not throw the unknowns about: a little of the diagonal is added.
      normal.diagonal() *= 1.0 + 1e-9;
      Unknowns change = normal.ldlt().solve(right);
      if (!change.allFinite()) return match;
      change[0] = std::clamp(change[0], -0.2, 0.2);
      advance(cloud, change, match);
      if (change.cwiseAbs().maxCoeff() < 1e-12) break;
    }
    residuals(cloud, match);
    return match;
  }

private:
  struct Term {
    Eigen::Vector2d residual, arm, current_arm;  // arms: from the cloud's centre, turned
    Eigen::Matrix2d gradient;
    bool used = false;
  };

  std::optional<std::vector<Term>> residuals(const Cloud& cloud, Match& match) const {
    std::vector<Term> terms;
    std::vector<double> length;
    std::vector<FlatMesh::Entry> row;
    match.off_fabric = 0;
    for (std::size_t i = 0; i < cloud.reference.size(); ++i) {
      const Vec2 at = match.reference.moved(cloud.reference[i]);
      const int cell = flat_.cell_at(at);
      if (cell < 0) {
        ++match.off_fabric;
        continue;
      }
      row.clear();
      flat_.add_weights(cell, at, 1.0, row);
      Eigen::Vector2d there(at[0], at[1]);
      for (const auto& [node, weight] : row)
        there += weight * Eigen::Vector2d(state_.displacement[node][0], state_.displacement[node][1]);
      if (!cloud.levelling.empty()) there += Eigen::Vector2d(cloud.levelling[i][0], cloud.levelling[i][1]);
      const Vec2 here = match.current.moved(cloud.current[i]);
      const Vec2 arm =
          match.reference.turned({cloud.reference[i][0] - cloud.centre[0], cloud.reference[i][1] - cloud.centre[1]});
      const Vec2 other =
          match.current.turned({cloud.current[i][0] - cloud.centre[0], cloud.current[i][1] - cloud.centre[1]});
      terms.push_back(
          {Eigen::Vector2d(here[0], here[1]) - there, {arm[0], arm[1]}, {other[0], other[1]}, gradient_[cell], false});
      length.push_back(terms.back().residual.norm());
    }
    match.deviation = std::numeric_limits<double>::infinity();
    // A placement that leaves most points off the fabric is none.
    if (terms.size() < 8 || 2 * terms.size() < cloud.reference.size()) return std::nullopt;
    match.deviation = robust_deviation(length);
    const double limit = reject_ * match.deviation + 1e-12;
    match.used = match.rejected = 0;
    match.sum_of_squares = 0.0;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      terms[i].used = length[i] <= limit;
      ++(terms[i].used ? match.used : match.rejected);
      if (terms[i].used) match.sum_of_squares += length[i] * length[i];
    }
    return terms;
  }

  [[nodiscard]] Rows jacobian(const Term& term) const {
    const auto quarter = [](const Eigen::Vector2d& v) { return Eigen::Vector2d(-v[1], v[0]); };
    Rows row(2, free_ ? 6 : 3);
    row.col(0) = -term.gradient * quarter(term.arm);
    row.block<2, 2>(0, 1) = -term.gradient;
    if (free_) {
      row.col(3) = quarter(term.current_arm);
      row.block<2, 2>(0, 4) = Eigen::Matrix2d::Identity();
    } else {
      row.col(0) += quarter(term.current_arm);
      row.block<2, 2>(0, 1) += Eigen::Matrix2d::Identity();
    }
    return row;
  }

  // Turns about the cloud's centre by change[0] and shifts by change[1], change[2].
  static void turn(const Vec2& centre, double angle, double dx, double dy, RigidMotion& motion) {
    const Vec2 before = motion.moved(centre);
    motion.angle += angle;
    const Vec2 turned = motion.turned(centre);
    motion.shift = {before[0] - turned[0] + dx, before[1] - turned[1] + dy};
  }

  void advance(const Cloud& cloud, const Unknowns& change, Match& match) const {
    turn(cloud.centre, change[0], change[1], change[2], match.reference);
    if (free_)
      turn(cloud.centre, change[3], change[4], change[5], match.current);
    else
      match.current = match.reference;
  }

  const FlatMesh& flat_;
  const SimulatedState& state_;
  std::vector<Eigen::Matrix2d> gradient_;
  bool free_;
  double reject_;
};

// Orientation of the cloud's longer axis; the blank's is that of its longer side.
double long_axis(const std::vector<Vec2>& points, const Vec2& centre) {
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const Vec2& p : points) {
    const double x = p[0] - centre[0], y = p[1] - centre[1];
    xx += x * x;
    xy += x * y;
    yy += y * y;
  }
  return 0.5 * std::atan2(2.0 * xy, xx - yy);
}

std::vector<double> starting_angles(const Cloud& cloud, const FlatMesh& flat, const RegistrationSpec& spec) {
  if (spec.angle) return {-*spec.angle * degree};
  const auto box = flat.extent();
  const double blank_axis = box[2] - box[0] >= box[3] - box[1] ? 0.0 : 0.5 * std::numbers::pi;
  const double turn = blank_axis - long_axis(cloud.reference, cloud.centre);
  std::vector<double> angles = {0.0};
  for (int quarter = 0; quarter < 4; ++quarter) angles.push_back(turn + 0.5 * std::numbers::pi * quarter);
  return angles;
}

std::vector<RigidMotion> starts(const Cloud& cloud, const FlatMesh& flat, const RegistrationSpec& spec) {
  const auto box = flat.extent();
  std::vector<RigidMotion> all;
  if (!spec.angle) all.emplace_back();  // as it is
  for (const double angle : starting_angles(cloud, flat, spec))
    for (const double right : {0.0, -0.15, 0.15})
      for (const double up : {0.0, -0.15, 0.15}) {
        RigidMotion motion;
        motion.angle = angle;
        const Vec2 turned = motion.turned(cloud.centre);
        motion.shift = {0.5 * (box[0] + box[2]) + right * (box[2] - box[0]) - turned[0],
                        0.5 * (box[1] + box[3]) + up * (box[3] - box[1]) - turned[1]};
        all.push_back(motion);
      }
  return all;
}

bool same_place(const RigidMotion& a, const RigidMotion& b, const Vec2& centre, double size) {
  const Vec2 p = a.moved(centre), q = b.moved(centre);
  return std::abs(std::remainder(a.angle - b.angle, 2.0 * std::numbers::pi)) < 0.02 &&
         std::hypot(p[0] - q[0], p[1] - q[1]) < 0.02 * size;
}

// The best of all starts; a question when another place fits as well.
Match best_trial(const Matcher& matcher, const Cloud& cloud, const FlatMesh& flat, const MeasuredStage& stage,
                 const RegistrationSpec& spec) {
  std::vector<Match> trials;
  for (const RigidMotion& start : starts(cloud, flat, spec)) {
    Match match;
    match.reference = match.current = start;
    trials.push_back(matcher.run(cloud, match, trial_steps));
  }
  const auto better = [](const Match& a, const Match& b) { return a.deviation < b.deviation; };
  const Match best = *std::min_element(trials.begin(), trials.end(), better);
  if (!std::isfinite(best.deviation))
    throw InputError(
        fmt::format("{}: no placement lays most of the points on the blank; is the length unit or pixel "
                    "size right? else give marks or axes in [registration]",
                    stage.label));
  const auto box = flat.extent();
  const double size = std::hypot(box[2] - box[0], box[3] - box[1]);
  for (const Match& other : trials) {
    const bool as_good = other.deviation < 1.1 * best.deviation + 1e-6 * size;
    if (!as_good || same_place(best.reference, other.reference, cloud.centre, size)) continue;
    const auto degrees = [](const RigidMotion& motion) {
      return -std::remainder(motion.angle, 2.0 * std::numbers::pi) / degree;
    };
    throw InputError(
        fmt::format("{}: the field fits the blank as well at {:.1f} deg as at {:.1f} deg: which way does "
                    "the blank's x axis point in the measurement? set angle of [registration] (--set "
                    "registration.angle=DEGREES), or give marks",
                    stage.label, degrees(best.reference), degrees(other.reference)));
  }
  return best;
}

// What the facets' averaging adds to the simulated displacements at the present placement: without it the rounded kinks
// of the measurement would pull at the placement and count as outliers.
void set_levelling(const FlatMesh& flat, const SimulatedState& state, const RigidMotion& placement, double facet_size,
                   Cloud& cloud) {
  std::vector<Vec2> points;
  for (const Vec2& p : cloud.reference) points.push_back(placement.moved(p));
  const Sampling point = sample_points(flat, points);
  const Sampling facet = sample_facets(flat, points, facet_size, 0.5, placement.angle);
  cloud.levelling.assign(points.size(), {0.0, 0.0});
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!point.found(i) || !facet.found(i)) continue;
    const Vec3 raw = point.value(i, state.displacement), levelled = facet.value(i, state.displacement);
    cloud.levelling[i] = {levelled[0] - raw[0], levelled[1] - raw[1]};
  }
}

}  // namespace

double robust_deviation(std::vector<double> length) {
  if (length.empty()) return 0.0;
  const auto middle = length.begin() + static_cast<std::ptrdiff_t>(length.size() / 2);
  std::nth_element(length.begin(), middle, length.end());
  return *middle / std::sqrt(2.0 * std::log(2.0));
}

Placement match_field(const MeasuredStage& stage, const Simulation& simulation, const SimulatedState& state,
                      const RegistrationSpec& spec, double facet_size) {
  if (!stage.gradient.empty())
    throw InputError(
        fmt::format("{}: holds no displacements, so they cannot place it; give marks or axes in "
                    "[registration]",
                    stage.label));
  const FlatMesh& flat = simulation.flat();
  const Matcher matcher(flat, state, spec.motion == SpecimenMotion::free, spec.reject);
  const Match start = best_trial(matcher, cloud_of(stage, trial_points), flat, stage, spec);
  Cloud cloud = cloud_of(stage, final_points);
  Match match = matcher.run(cloud, start, final_steps);
  for (int again = 0; again < 2 && facet_size > 0.0; ++again) {
    set_levelling(flat, state, match.reference, facet_size, cloud);
    match = matcher.run(cloud, match, final_steps);
  }

  Placement placement;
  placement.reference = match.reference;
  placement.current = match.current;
  placement.reference.angle = std::remainder(match.reference.angle, 2.0 * std::numbers::pi);
  placement.current.angle = std::remainder(match.current.angle, 2.0 * std::numbers::pi);
  placement.method = fmt::format("least squares of the displacement field of {}", stage.label);
  placement.used = match.used;
  placement.rejected = match.rejected;
  placement.off_fabric = match.off_fabric;
  placement.residual = std::sqrt(match.sum_of_squares / std::max(1, match.used));
  const double variance =
      match.sum_of_squares / std::max(1.0, 2.0 * match.used - static_cast<double>(match.normal.rows()));
  const auto factors = match.normal.ldlt();
  const auto unknowns = match.normal.rows();
  const Normal covariance = variance * factors.solve(Normal::Identity(unknowns, unknowns));
  placement.angle_error = std::sqrt(covariance(0, 0));
  placement.shift_error = std::sqrt(0.5 * (covariance(1, 1) + covariance(2, 2)));
  const double conditioned = factors.rcond();
  // The normal matrix mixes radians and mm: a scale of the specimen's size makes it comparable.
  if (!(conditioned > 1e-14) || !(placement.shift_error < 0.05 * (flat.extent()[3] - flat.extent()[1])))
    throw InputError(
        fmt::format("{}: the displacement field does not tell where on the blank it was measured (too "
                    "uniform); give marks or axes in [registration]",
                    stage.label));
  return placement;
}

}  // namespace weaveform::dic
