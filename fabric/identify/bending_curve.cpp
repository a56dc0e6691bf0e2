#include "fabric/identify/bending_curve.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "fabric/identify/constrained_least_squares.hpp"

namespace weaveform::identify {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int fine_intervals = 64;     // between places where a knot may be
constexpr double least_share = 1e-4;   // of the mean stiffness
constexpr Index most_residuals = 120;  // that a curve's error is estimated from, each side
constexpr int relocations = 2;         // rounds in which every knot may move

// The integral from 0 to x of the hat function with its top at `top`, zero at `low` and `high`. The first hat has no
// left side (low = top), the last none on the right: it stays 1 (high = infinity).
double hat_integral(double x, double low, double top, double high) {
  double sum = 0.0;
  if (top > low && x > low) {
    const double t = std::min(x, top) - low;
    sum += 0.5 * t * t / (top - low);
  }
  if (x > top) {
    if (std::isinf(high)) return sum + x - top;
    const double width = high - top, left = high - std::min(x, high);
    sum += 0.5 * width - 0.5 * left * left / width;
  }
  return sum;
}

double hat_integral_at(const std::vector<double>& knot, std::size_t k, double x) {
  const double low = k == 0 ? knot[0] : knot[k - 1];
  const double high = k + 1 < knot.size() ? knot[k + 1] : std::numeric_limits<double>::infinity();
  return hat_integral(x, low, knot[k], high);
}

// Places for knots at equal distances along the curve of the readings, both axes scaled by their ranges.
std::vector<double> fine_knots(const std::vector<BendingReading>& readings) {
  std::vector<std::array<double, 2>> sorted;
  double reach = 0.0, greatest = 0.0;
  for (const auto& reading : readings) {
    sorted.push_back({std::abs(reading.curvature), std::abs(reading.moment)});
    reach = std::max(reach, sorted.back()[0]);
    greatest = std::max(greatest, sorted.back()[1]);
  }
  std::sort(sorted.begin(), sorted.end());
  // means over groups: neighbouring readings of noise would make the curve long
  const std::size_t group = std::max<std::size_t>(1, sorted.size() / 60);
  std::vector<double> place = {0.0}, along = {0.0};
  double last_moment = 0.0;
  for (std::size_t i = 0; i + group <= sorted.size(); i += group) {
    double x = 0.0, y = 0.0;
    for (std::size_t k = i; k < i + group; ++k) {
      x += sorted[k][0] / static_cast<double>(group);
      y += sorted[k][1] / static_cast<double>(group);
    }
    y = std::max(y, last_moment);
    if (!(x > place.back())) continue;
    along.push_back(along.back() + (x - place.back()) / reach + (y - last_moment) / greatest);
    place.push_back(x);
    last_moment = y;
  }
  along.push_back(along.back() + std::max(1e-9, (reach - place.back()) / reach));
  place.push_back(std::max(reach, std::nextafter(place.back(), 2.0 * reach)));
  std::vector<double> knots;
  for (int k = 0; k <= fine_intervals; ++k) {
    const double at = along.back() * k / fine_intervals;
    const auto above = std::clamp<std::ptrdiff_t>(std::lower_bound(along.begin(), along.end(), at) - along.begin(), 1,
                                                  std::ssize(along) - 1);
    const double share = (at - along[above - 1]) / (along[above] - along[above - 1]);
    const double x = place[above - 1] + share * (place[above] - place[above - 1]);
    if (knots.empty() || x > knots.back() + 1e-4 * reach) knots.push_back(x);
  }
  knots.back() = reach;
  return knots;
}

// The least-squares problem on the fine knots, reduced once to a triangle, so that a choice of knots among them is a
// small problem: |A P t - y|^2 = |R P t - f|^2 + rest. With two sides the tangents of negative curvatures follow those of
// positive ones, at the same knots.
class KnotProblem {
public:
  KnotProblem(const std::vector<BendingReading>& readings, const BendingFitChoices& choices)
      : fine_(fine_knots(readings)), count_(static_cast<Index>(readings.size())) {
    stiff_start_ = choices.stiff_start;
    sides_ = choices.two_sided ? 2 : 1;
    extras_ = (choices.friction ? 1 : 0) + (choices.offset ? 2 : 0);
    double greatest = 0.0;
    for (const auto& reading : readings) greatest = std::max(greatest, std::abs(reading.moment));
    greatest_ = greatest;
    least_ = least_share * greatest / fine_.back();
    const auto fine = static_cast<Index>(fine_.size());
    A_ = MatrixXd::Zero(count_, sides_ * fine + extras_);
    y_.resize(count_);
    for (Index i = 0; i < count_; ++i) {
      const BendingReading& reading = readings[i];
      const double x = std::abs(reading.curvature), sign = std::copysign(1.0, reading.curvature);
      const Index first = sides_ == 2 && sign < 0.0 ? fine : 0;
      for (Index k = 0; k < fine; ++k) A_(i, first + k) = sign * hat_integral_at(fine_, k, x);
      Index column = sides_ * fine;
      if (choices.friction) A_(i, column++) = reading.friction;
      if (choices.offset) {
        A_(i, column++) = 1.0;
        A_(i, column++) = -1.0;
      }
      y_[i] = reading.moment - least_ * reading.curvature;
    }
    if (count_ <= A_.cols()) {
      R_ = A_;
      f_ = y_;
      return;
    }
    const Eigen::HouseholderQR<MatrixXd> qr(A_);
    R_ = qr.matrixQR().topRows(A_.cols()).triangularView<Eigen::Upper>();
    const VectorXd rotated = qr.householderQ().transpose() * y_;
    f_ = rotated.head(A_.cols());
    rest_ = rotated.tail(count_ - A_.cols()).squaredNorm();
  }

  [[nodiscard]] Index fine_count() const { return static_cast<Index>(fine_.size()); }
  [[nodiscard]] Index count() const { return count_; }
  [[nodiscard]] double greatest() const { return greatest_; }

  // `chosen`: rising indices of fine knots, the first and the last among them.
  [[nodiscard]] double squares(const std::vector<Index>& chosen) const {
    const MatrixXd part = R_ * spread(chosen);
    const VectorXd x = nonnegative_least_squares(part, f_);
    return (part * x - f_).squaredNorm() + rest_;
  }

  [[nodiscard]] BendingCurveFit solve(const std::vector<Index>& chosen, const BendingFitChoices& choices) const {
    const MatrixXd P = spread(chosen);
    const VectorXd x = nonnegative_least_squares(R_ * P, f_);
    BendingCurveFit fit;
    fit.curve = curve_of(chosen, x, 0);
    if (sides_ == 2) fit.back = curve_of(chosen, x, std::ssize(chosen));
    auto next = static_cast<Index>(sides_ * std::ssize(chosen));
    if (choices.friction) fit.friction = x[next++];
    if (choices.offset) fit.offset = x[next] - x[next + 1];
    const VectorXd residual = y_ - A_ * (P * x);
    fit.misfit = std::sqrt(residual.squaredNorm() / static_cast<double>(count_));
    const std::vector<Index> between = with_middles(chosen);
    for (const Index k : between) fit.error_knot.push_back(fine_[k]);
    average(A_ * spread(between, false), residual, choices, fit);
    return fit;
  }

private:
  // Of the unknowns from `first` on.
  [[nodiscard]] BendingCurve curve_of(const std::vector<Index>& chosen, const VectorXd& x, Index first) const {
    BendingCurve curve;
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      curve.knot.push_back(fine_[chosen[k]]);
      const double excess = k == 0 && stiff_start_ ? x[first + 1] : 0.0;
      curve.tangent.push_back(least_ + excess + x[first + static_cast<Index>(k)]);
    }
    return curve;
  }

  // Values of the chosen knots' hats at the fine knots; extras are themselves.
  [[nodiscard]] MatrixXd spread(const std::vector<Index>& chosen) const { return spread(chosen, stiff_start_); }
  [[nodiscard]] MatrixXd spread(const std::vector<Index>& chosen, bool stiff_start) const {
    const Index fine = fine_count(), coarse = static_cast<Index>(chosen.size());
    MatrixXd P = MatrixXd::Zero(sides_ * fine + extras_, sides_ * coarse + extras_);
    for (Index s = 0; s < sides_; ++s) {
      for (Index c = 0; c + 1 < coarse; ++c)
        for (Index k = chosen[c]; k <= chosen[c + 1]; ++k) {
          const double share = (fine_[k] - fine_[chosen[c]]) / (fine_[chosen[c + 1]] - fine_[chosen[c]]);
          P(s * fine + k, s * coarse + c) = 1.0 - share;
          P(s * fine + k, s * coarse + c + 1) = share;
        }
      if (stiff_start) P.col(s * coarse + 1) += P.col(s * coarse);
    }
    for (Index e = 0; e < extras_; ++e) P(sides_ * fine + e, sides_ * coarse + e) = 1.0;
    return P;
  }

  [[nodiscard]] static std::vector<Index> with_middles(const std::vector<Index>& chosen) {
    std::vector<Index> more = {chosen.front()};
    for (std::size_t c = 1; c < chosen.size(); ++c) {
      const Index middle = (chosen[c - 1] + chosen[c]) / 2;
      if (middle > chosen[c - 1]) more.push_back(middle);
      more.push_back(chosen[c]);
    }
    return more;
  }

  // Groups of neighbouring readings as one: what is left of the noise of a group is that of its mean.
  void average(const MatrixXd& J, const VectorXd& residual, const BendingFitChoices& choices,
               BendingCurveFit& fit) const {
    const Index most = sides_ * most_residuals;
    const Index group = (count_ + most - 1) / most, groups = count_ / group;
    const Index columns = J.cols() - (choices.offset ? 1 : 0);  // the offset's two columns are one unknown
    fit.sensitivity = MatrixXd::Zero(groups, columns);
    fit.residual = VectorXd::Zero(groups);
    for (Index g = 0; g < groups; ++g) {
      fit.sensitivity.row(g) = J.middleRows(g * group, group).leftCols(columns).colwise().mean();
      fit.residual[g] = residual.segment(g * group, group).mean();
    }
  }

  std::vector<double> fine_;
  Index count_, extras_ = 0, sides_ = 1;
  bool stiff_start_ = true;
  double greatest_ = 0.0, least_ = 0.0, rest_ = 0.0;
  MatrixXd A_, R_;
  VectorXd y_, f_;
};

// The chosen knots with one more where it helps most; `squares` becomes the sum then.
std::vector<Index> with_best_knot(const KnotProblem& problem, const std::vector<Index>& chosen, double& squares) {
  std::vector<Index> best = chosen;
  squares = std::numeric_limits<double>::infinity();
  for (Index k = 1; k + 1 < problem.fine_count(); ++k) {
    if (std::binary_search(chosen.begin(), chosen.end(), k)) continue;
    std::vector<Index> trial = chosen;
    trial.insert(std::upper_bound(trial.begin(), trial.end(), k), k);
    const double found = problem.squares(trial);
    if (!(found < squares)) continue;
    squares = found;
    best = std::move(trial);
  }
  return best;
}

// Every inner knot to the best place between its neighbours.
void relocate(const KnotProblem& problem, std::vector<Index>& chosen, double& squares) {
  for (std::size_t c = 1; c + 1 < chosen.size(); ++c) {
    const Index low = chosen[c - 1], high = chosen[c + 1];
    Index place = chosen[c];
    for (Index k = low + 1; k < high; ++k) {
      chosen[c] = k;
      const double found = problem.squares(chosen);
      if (!(found < squares)) continue;
      squares = found;
      place = k;
    }
    chosen[c] = place;
  }
}

double ten_digits(double value) {
  return std::stod(fmt::format("{:.10g}", value));
}

}  // namespace

double BendingCurve::moment(double curvature) const {
  const double x = std::abs(curvature);
  double sum = 0.0;
  for (std::size_t k = 0; k < knot.size(); ++k) sum += tangent[k] * hat_integral_at(knot, k, x);
  return std::copysign(sum, curvature);
}

double BendingCurve::tangent_at(double curvature) const {
  const double x = std::abs(curvature);
  if (x >= knot.back()) return tangent.back();
  const auto above = std::max<std::ptrdiff_t>(1, std::upper_bound(knot.begin(), knot.end(), x) - knot.begin());
  const double share = (x - knot[above - 1]) / (knot[above] - knot[above - 1]);
  return tangent[above - 1] + share * (tangent[above] - tangent[above - 1]);
}

double BendingCurve::curvature(double moment) const {
  double left = std::abs(moment);
  for (std::size_t k = 0; k + 1 < knot.size(); ++k) {
    const double width = knot[k + 1] - knot[k], bears = 0.5 * (tangent[k] + tangent[k + 1]) * width;
    if (left > bears) {
      left -= bears;
      continue;
    }
    // left = t d + (t' - t)/(2 width) d^2 , the root that also holds for equal tangents
    const double bow = 2.0 * (tangent[k + 1] - tangent[k]) / width;
    const double way = 2.0 * left / (tangent[k] + std::sqrt(std::max(0.0, tangent[k] * tangent[k] + bow * left)));
    return std::copysign(knot[k] + way, moment);
  }
  return std::copysign(knot.back() + left / tangent.back(), moment);
}

std::vector<TangentPiece> pieces_of(const BendingCurve& curve, double interval) {
  std::vector<TangentPiece> pieces;
  for (std::size_t k = 0; k + 1 < curve.knot.size(); ++k) {
    const double from = ten_digits(curve.knot[k]), to = ten_digits(curve.knot[k + 1]);
    const double slope = (curve.tangent[k + 1] - curve.tangent[k]) / (to - from);
    pieces.push_back(
        {from, to, {ten_digits(interval * (curve.tangent[k] - slope * from)), ten_digits(interval * slope)}});
  }
  pieces.push_back(
      {pieces.back().to, std::numeric_limits<double>::infinity(), {ten_digits(interval * curve.tangent.back())}});
  return pieces;
}

BendingCurveFit fit_bending_curve(const std::vector<BendingReading>& readings, const BendingFitChoices& choices) {
  const KnotProblem problem(readings, choices);
  std::vector<Index> chosen = {0, problem.fine_count() - 1};
  const auto n = static_cast<double>(problem.count());
  const double enough = n * std::pow(choices.enough * problem.greatest(), 2);
  double squares = problem.squares(chosen);
  while (static_cast<int>(chosen.size()) < choices.pieces && squares > enough) {
    double fewer = 0.0;
    std::vector<Index> more = with_best_knot(problem, chosen, fewer);
    if (more.size() == chosen.size()) break;
    relocate(problem, more, fewer);
    // a knot is two unknowns, its place and its tangent (one a side): n ln(squares) + 2 ln(n) must fall
    const double unknowns = choices.two_sided ? 3.0 : 2.0;
    if (!(n * std::log(fewer / squares) + unknowns * std::log(n) < 0.0)) break;
    chosen = std::move(more);
    squares = fewer;
  }
  for (int round = 0; round < relocations; ++round) relocate(problem, chosen, squares);
  return problem.solve(chosen, choices);
}

VectorXd curve_sensitivity(const std::vector<double>& knot, double curvature) {
  VectorXd row(static_cast<Index>(knot.size()));
  for (std::size_t k = 0; k < knot.size(); ++k)
    row[static_cast<Index>(k)] = std::copysign(hat_integral_at(knot, k, std::abs(curvature)), curvature);
  return row;
}

std::vector<double> friction_share(const std::vector<double>& curvature, double rise, double start) {
  std::vector<double> share;
  double phi = start;
  for (std::size_t i = 0; i < curvature.size(); ++i) {
    const double way = i == 0 ? 0.0 : curvature[i] - curvature[i - 1];
    const double limit = std::copysign(1.0, way);
    if (way != 0.0) phi = limit + (phi - limit) * std::exp(-std::abs(way) / rise);
    share.push_back(phi);
  }
  return share;
}

}  // namespace weaveform::identify
