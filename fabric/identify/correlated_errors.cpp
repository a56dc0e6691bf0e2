#include "fabric/identify/correlated_errors.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace weaveform::identify {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double greatest_correlation = 0.98;  // beyond, the residuals are a misfit and no noise
constexpr double least_freedom = 3.0;          // keeps the band of such a misfit finite

MatrixXd correlation_matrix(Index n, double rho) {
  MatrixXd R(n, n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) R(i, j) = std::pow(rho, std::abs(static_cast<double>(i - j)));
  }
  return R;
}

// Ratio of neighbouring products to squares that residuals with this covariance show.
double neighbour_ratio(const MatrixXd& covariance) {
  return covariance.diagonal(1).sum() / covariance.trace();
}

}  // namespace

CorrelatedErrors correlated_errors(const MatrixXd& J, const VectorXd& residual) {
  const Index n = J.rows();
  // A parameter without effect (the rise of a start without a plateau) is passed over by the least-norm inverse.
  const MatrixXd inverse = J.completeOrthogonalDecomposition().pseudoInverse();
  const MatrixXd M = MatrixXd::Identity(n, n) - J * inverse;
  const auto expected = [&](double rho) { return MatrixXd(M * correlation_matrix(n, rho) * M); };
  const double squares = residual.squaredNorm();
  const double seen_ratio = squares > 0.0 ? residual.head(n - 1).dot(residual.tail(n - 1)) / squares : 0.0;
  // One standard deviation of that ratio (Bartlett 1946) on the safe side: too low a correlation gives too narrow a
  // band.
  const double observed = seen_ratio + std::sqrt(std::max(0.0, 1.0 - seen_ratio * seen_ratio) / static_cast<double>(n));
  double low = 0.0, high = greatest_correlation;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (low + high);
    (neighbour_ratio(expected(middle)) < observed ? low : high) = middle;
  }
  CorrelatedErrors errors;
  errors.correlation = 0.5 * (low + high);
  const MatrixXd seen = expected(errors.correlation);
  const double trace = seen.trace();
  errors.freedom = std::max(least_freedom, trace * trace / seen.squaredNorm());
  errors.covariance = squares / trace * (inverse * correlation_matrix(n, errors.correlation) * inverse.transpose());
  return errors;
}

}  // namespace weaveform::identify
