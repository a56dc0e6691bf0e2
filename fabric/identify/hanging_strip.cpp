#include "fabric/identify/hanging_strip.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/vector/angle.hpp"
#include "fabric/identify/statistics.hpp"

namespace weaveform::identify {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int strip_steps = 240;  // of the integration along the strip
constexpr int moment_steps = 16;  // pieces of K
constexpr double walk = 1.0;      // standard deviation of the logarithmic slope from one piece to the next
constexpr Index place = 3;        // unknowns before the slopes: the tip's angle, x and y
constexpr int most_rounds = 60;
constexpr int samples = 60;             // of the curve
constexpr double level = 1.0 * degree;  // rad; standard deviation of a clamp's inclination
constexpr double least_noise = 1e-5;    // of the strip's length: digitised points are never better

// K(M): slopes between equal steps of the moment up to `greatest`, the last one going on.
struct Compliance {
  double greatest = 0.0;      // N
  std::vector<double> slope;  // 1/(N mm)
  [[nodiscard]] double curvature(double moment) const {
    const double width = greatest / static_cast<double>(slope.size());
    double left = moment, sum = 0.0;
    for (std::size_t k = 0; k < slope.size(); ++k) {
      const bool last = k + 1 == slope.size();
      const double part = last ? left : std::min(left, width);
      sum += slope[k] * part;
      left -= part;
      if (!(left > 0.0)) break;
    }
    return sum;
  }
  // Derivatives of K(M) by the slopes.
  [[nodiscard]] VectorXd parts(double moment) const {
    const double width = greatest / static_cast<double>(slope.size());
    VectorXd row = VectorXd::Zero(static_cast<Index>(slope.size()));
    double left = moment;
    for (std::size_t k = 0; k < slope.size() && left > 0.0; ++k) {
      const bool last = k + 1 == slope.size();
      row[static_cast<Index>(k)] = last ? left : std::min(left, width);
      left -= width;
    }
    return row;
  }
  [[nodiscard]] double slope_at(double moment) const {
    const double width = greatest / static_cast<double>(slope.size());
    return slope[std::min(slope.size() - 1, static_cast<std::size_t>(std::max(0.0, moment / width)))];
  }
};

// The strip at equal steps from the tip on.
struct Path {
  double step = 0.0;  // mm
  std::vector<double> x, y, theta, moment;
};

// Runge and Kutta's fourth order; K has corners, whose error at 240 steps is far below any reading's.
template <class CurvatureOf>
Path integrate(const CurvatureOf& curvature, double weight, double length, double tip_angle, double tip_x,
               double tip_y) {
  using Y = std::array<double, 4>;  // x, y, theta, M
  Path path;
  path.step = length / strip_steps;
  Y now = {tip_x, tip_y, tip_angle, 0.0};
  const auto slope = [&](double sigma, const Y& at) -> Y {
    const double c = std::cos(at[2]);
    return {-c, std::sin(at[2]), -curvature(std::max(0.0, at[3])), weight * sigma * c};
  };
  const auto moved = [](const Y& at, const Y& by, double h) {
    Y to = at;
    for (std::size_t k = 0; k < 4; ++k) to[k] += h * by[k];
    return to;
  };
  const double h = path.step;
  for (int n = 0; n <= strip_steps; ++n) {
    path.x.push_back(now[0]);
    path.y.push_back(now[1]);
    path.theta.push_back(now[2]);
    path.moment.push_back(now[3]);
    const double sigma = n * h;
    const Y a = slope(sigma, now), b = slope(sigma + 0.5 * h, moved(now, a, 0.5 * h)),
            c = slope(sigma + 0.5 * h, moved(now, b, 0.5 * h)), d = slope(sigma + h, moved(now, c, h));
    for (std::size_t k = 0; k < 4; ++k) now[k] += h / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]);
  }
  return path;
}

// Signed distance of a point from the path, searched from step `from` on (points are in order along the strip, from the
// tip): perpendicular to the chord that is nearest, or to its line beyond the ends.
double distance_from(const Path& path, const std::array<double, 2>& point, int from, int& found) {
  double best = std::numeric_limits<double>::infinity(), signed_distance = 0.0;
  const int last = static_cast<int>(path.x.size()) - 2;
  // a window about the last place: the strip has no fold, and the search no need of the whole
  for (int n = std::max(0, from - 12); n <= std::min(last, from + 60); ++n) {
    const double ex = path.x[n + 1] - path.x[n], ey = path.y[n + 1] - path.y[n];
    const double px = point[0] - path.x[n], py = point[1] - path.y[n];
    const double length = std::hypot(ex, ey), along = (px * ex + py * ey) / length;
    const double part = std::clamp(along, n == 0 ? -1e9 : 0.0, n == last ? 1e9 : length);
    const double away = std::hypot(px - part * ex / length, py - part * ey / length);
    if (!(away < best)) continue;
    best = away;
    signed_distance = std::copysign(away, ex * py - ey * px);
    found = n;
  }
  return signed_distance;
}

constexpr double room = 0.01;  // of its length that the path goes on beyond the points

// Unknowns: tip angle, tip x and y, logarithms of the slopes. Points from the tip on.
class StripFit {
public:
  StripFit(std::vector<std::array<double, 2>> from_tip, double clamp, double weight)
      : points_(std::move(from_tip)), clamp_(clamp), weight_(weight) {
    length_ = std::max(clamp, (1.0 + room) * polyline_length(thinned(points_)));
    start();
  }

  void solve() {
    for (int outer = 0; outer < 4; ++outer) {
      march();
      const VectorXd r = distances(unknown_);
      const double scatter =
          std::sqrt(r.head(point_count()).squaredNorm() / std::max(1.0, static_cast<double>(points_.size()) - 6.0));
      const double before = noise_;
      noise_ = std::max(scatter, least_noise * length_);
      rescale();
      if (std::abs(noise_ / before - 1.0) < 0.02) break;
    }
    march();
  }

  [[nodiscard]] Compliance compliance(const VectorXd& unknown) const {
    Compliance law{greatest_, {}};
    for (Index k = place; k < unknown.size(); ++k) law.slope.push_back(std::exp(unknown[k]));
    return law;
  }
  [[nodiscard]] Path path(const VectorXd& unknown) const {
    const Compliance law = compliance(unknown);
    return integrate([&](double moment) { return law.curvature(moment); }, weight_, length_, unknown[0], unknown[1],
                     unknown[2]);
  }
  [[nodiscard]] const VectorXd& unknown() const { return unknown_; }
  [[nodiscard]] double noise() const { return noise_; }
  [[nodiscard]] double greatest() const { return greatest_; }
  [[nodiscard]] VectorXd residuals() const { return distances(unknown_).head(point_count()); }
  // Of the path, the step beside the last point; after residuals().
  [[nodiscard]] int last_step() const { return last_step_; }

  // Of the unknowns, with what the walk knows; widened where neighbouring residuals are alike.
  [[nodiscard]] MatrixXd covariance() const {
    const VectorXd r = distances(unknown_);
    const std::vector<double> values(r.data(), r.data() + point_count());
    const double rho = std::min(0.9, neighbour_correlation(values, 6));
    const double widen = (1.0 + rho) / (1.0 - rho);
    const MatrixXd J = jacobian(unknown_, r);
    MatrixXd H = J.transpose() * J / (noise_ * noise_ * widen);
    add_walk(H);
    return H.ldlt().solve(MatrixXd::Identity(H.rows(), H.cols()));
  }

private:
  // One rigidity for the whole strip: the best of a row of them, its tip's angle such that the clamp's side leaves as
  // the points do.
  void start() {
    const auto& tip = points_.front();
    const auto& end = points_.back();
    const std::size_t near = std::max<std::size_t>(1, points_.size() / 12);
    const auto& before = points_[points_.size() - 1 - near];
    const double clamp_angle = std::atan2(end[1] - before[1], before[0] - end[0]);
    double best = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 40; ++k) {
      const double length3 = std::pow(length_, 3);
      const double rigidity = weight_ * length3 * std::pow(10.0, -2.2 + 3.6 * k / 40.0);
      double low = clamp_angle, high = 0.5 * std::numbers::pi;
      for (int n = 0; n < 30; ++n) {
        const double middle = 0.5 * (low + high);
        const Path p = integrate([&](double m) { return m / rigidity; }, weight_, length_, middle, tip[0], tip[1]);
        (p.theta.back() < clamp_angle ? low : high) = middle;
      }
      const double angle = 0.5 * (low + high);
      const Path p = integrate([&](double m) { return m / rigidity; }, weight_, length_, angle, tip[0], tip[1]);
      const double off = std::hypot(p.x.back() - end[0], p.y.back() - end[1]);
      if (!(off < best)) continue;
      best = off;
      unknown_ = VectorXd::Constant(place + moment_steps, -std::log(rigidity));
      unknown_.head(place) << angle, tip[0], tip[1];
      greatest_ = p.moment.back();
    }
    noise_ = 0.01 * length_;
    mean_slope_ = unknown_[place];
  }

  // The pieces reach as far as the moments do.
  void rescale() {
    const Path p = path(unknown_);
    const Compliance law = compliance(unknown_);
    const double reach = p.moment[static_cast<std::size_t>(last_step_)];
    if (std::abs(reach / greatest_ - 1.0) < 0.01) return;
    for (Index k = 0; k < moment_steps; ++k)
      unknown_[place + k] = std::log(law.slope_at((static_cast<double>(k) + 0.5) / moment_steps * reach));
    greatest_ = reach;
  }

  [[nodiscard]] Index point_count() const { return static_cast<Index>(points_.size()); }

  // Distances of all points, how far the tip's point lies beyond the tip along the strip, and the clamp's inclination in
  // the points' measure.
  [[nodiscard]] VectorXd distances(const VectorXd& unknown) const {
    const Path p = path(unknown);
    VectorXd r = VectorXd::Zero(point_count() + 2);
    int at = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) r[static_cast<Index>(i)] = distance_from(p, points_[i], at, at);
    last_step_ = at + 1;
    if (clamp_ > 0.0) {
      const double step_place = std::min(clamp_ / p.step, static_cast<double>(strip_steps));
      const int below = std::min(static_cast<int>(step_place), strip_steps - 1);
      const double share = step_place - below;
      const double inclined = (1.0 - share) * p.theta[below] + share * p.theta[below + 1];
      r[point_count() + 1] = noise_ * inclined / level;
      last_step_ = below + (share > 0.5 ? 1 : 0);
    }
    const auto& tip = points_.front();
    const double c = std::cos(unknown[0]), s = std::sin(unknown[0]);
    r[point_count()] = (tip[0] - unknown[1]) * c - (tip[1] - unknown[2]) * s;
    return r;
  }

  [[nodiscard]] MatrixXd jacobian(const VectorXd& unknown, const VectorXd& r) const {
    MatrixXd J(r.size(), unknown.size());
    for (Index k = 0; k < unknown.size(); ++k) {
      const double change = k == 1 || k == 2 ? 1e-5 * length_ : 1e-5;
      VectorXd moved = unknown;
      moved[k] += change;
      J.col(k) = (distances(moved) - r) / change;
    }
    return J;
  }

  // The random walk of the logarithmic slopes, and a hold so loose on the first that it only keeps the matrix regular.
  void add_walk(MatrixXd& H) const {
    constexpr double per = 1.0 / (walk * walk);
    for (Index k = place; k + 1 < H.rows(); ++k) {
      H(k, k) += per;
      H(k + 1, k + 1) += per;
      H(k, k + 1) -= per;
      H(k + 1, k) -= per;
    }
    H(place, place) += 1e-4;
  }
  [[nodiscard]] VectorXd walk_slope(const VectorXd& unknown) const {
    VectorXd g = VectorXd::Zero(unknown.size());
    for (Index k = place; k + 1 < unknown.size(); ++k) {
      const double d = (unknown[k + 1] - unknown[k]) / (walk * walk);
      g[k] -= d;
      g[k + 1] += d;
    }
    g[place] += 1e-4 * (unknown[place] - mean_slope_);
    return g;
  }
  [[nodiscard]] double objective(const VectorXd& unknown, const VectorXd& r) const {
    double sum = r.squaredNorm() / (noise_ * noise_);
    for (Index k = place; k + 1 < unknown.size(); ++k) sum += std::pow((unknown[k + 1] - unknown[k]) / walk, 2);
    return sum + 1e-4 * std::pow(unknown[place] - mean_slope_, 2);
  }

  // Levenberg and Marquardt.
  void march() {
    VectorXd r = distances(unknown_);
    double now = objective(unknown_, r), damping = 1e-3;
    for (int round = 0; round < most_rounds; ++round) {
      const MatrixXd J = jacobian(unknown_, r);
      MatrixXd H = J.transpose() * J / (noise_ * noise_);
      add_walk(H);
      const VectorXd g = J.transpose() * r / (noise_ * noise_) + walk_slope(unknown_);
      bool better = false;
      double gained = 0.0;
      for (int trial = 0; trial < 12 && !better; ++trial) {
        MatrixXd damped = H;
        damped.diagonal() *= 1.0 + damping;
        VectorXd step = -damped.ldlt().solve(g);
        for (Index k = place; k < step.size(); ++k) step[k] = std::clamp(step[k], -1.5, 1.5);
        const VectorXd next = unknown_ + step;
        const VectorXd r_next = distances(next);
        const double then = objective(next, r_next);
        if (std::isfinite(then) && then < now) {
          gained = now - then;
          unknown_ = next;
          r = r_next;
          now = then;
          damping = std::max(1e-9, 0.3 * damping);
          better = true;
        } else {
          damping *= 5.0;
        }
      }
      if (!better || gained < 1e-6 * now) break;
    }
  }

  std::vector<std::array<double, 2>> points_;
  double clamp_ = 0.0, weight_ = 0.0, length_ = 0.0, greatest_ = 0.0, noise_ = 0.0, mean_slope_ = 0.0;
  VectorXd unknown_;
  mutable int last_step_ = strip_steps;  // where the last point lay when distances were last taken
};

}  // namespace

std::vector<std::array<double, 2>> thinned(const std::vector<std::array<double, 2>>& points) {
  constexpr std::size_t parts = 24;
  if (points.size() <= parts) return points;
  std::vector<std::array<double, 2>> few;
  for (std::size_t k = 0; k <= parts; ++k) few.push_back(points[k * (points.size() - 1) / parts]);
  return few;
}

double polyline_length(const std::vector<std::array<double, 2>>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i)
    length += std::hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]);
  return length;
}

HangingTip hanging_tip(const BendingCurve& law, double weight, double length) {
  const auto curvature = [&](double moment) { return law.curvature(moment); };
  double low = 0.0, high = 0.5 * std::numbers::pi;
  for (int n = 0; n < 40; ++n) {
    const double middle = 0.5 * (low + high);
    (integrate(curvature, weight, length, middle, 0.0, 0.0).theta.back() < 0.0 ? low : high) = middle;
  }
  const Path path = integrate(curvature, weight, length, 0.5 * (low + high), 0.0, 0.0);
  return {-path.x.back(), path.y.back(), curvature(path.moment.back())};
}

BendingSpecimen fit_hanging_strip(const StripShape& shape, double weight, const std::string& name) {
  StripFit fit({shape.point.rbegin(), shape.point.rend()}, shape.clamp, weight);
  fit.solve();
  const Compliance law = fit.compliance(fit.unknown());
  const Path path = fit.path(fit.unknown());
  BendingSpecimen specimen{.name = name};
  const VectorXd residuals = fit.residuals();
  specimen.misfit = std::sqrt(residuals.squaredNorm() / static_cast<double>(residuals.size()));
  const int end = fit.last_step();
  const double greatest = path.moment[static_cast<std::size_t>(end)];
  specimen.reach = law.curvature(greatest);
  if (!(specimen.reach > 0.0) || !std::isfinite(specimen.reach))
    throw InputError(
        fmt::format("{}: the profile is straight, no strip that hangs under its weight; choose other "
                    "columns or a longer overhang",
                    name));
  // the curve M(kappa) through the corners of K(M), and its error where K's is known: dM = -dK/K'
  const MatrixXd covariance = fit.covariance();
  specimen.freedom = std::max(3.0, static_cast<double>(shape.point.size()) - 8.0);
  specimen.first_stiffness = 1.0 / law.slope.front();
  for (int i = 0; i <= samples; ++i) {
    specimen.curve_moment.push_back(greatest * i / samples);
    specimen.curve_curvature.push_back(law.curvature(specimen.curve_moment.back()));
  }
  for (int i = 0; i <= samples; ++i) {
    const double moment = specimen.curve_moment[static_cast<std::size_t>(i)];
    VectorXd g = VectorXd::Zero(fit.unknown().size());
    const VectorXd parts = law.parts(moment);
    for (Index k = 0; k < parts.size(); ++k) g[place + k] = parts[k] * law.slope[static_cast<std::size_t>(k)];
    const double error = std::sqrt(std::max(0.0, g.dot(covariance * g)));
    specimen.error_curvature.push_back(specimen.curve_curvature[static_cast<std::size_t>(i)]);
    specimen.error.push_back(error / law.slope_at(std::max(0.0, moment - 0.5 * greatest / samples)));
  }
  const double tilt = path.theta[static_cast<std::size_t>(end)];
  specimen.notes.push_back(
      fmt::format("hangs from a place {:.4g} mm along the strip from its tip, where it is inclined "
                  "by {:.2f} deg; points lie within {:.3g} mm (root mean square) of the curve",
                  path.step * end, tilt / degree, specimen.misfit));
  return specimen;
}

}  // namespace weaveform::identify
