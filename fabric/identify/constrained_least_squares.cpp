#include "fabric/identify/constrained_least_squares.hpp"

#include <Eigen/QR>
#include <limits>
#include <vector>

#include "core/error.hpp"

namespace weaveform::identify {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Least squares over the passive columns alone; the other unknowns are zero.
VectorXd passive_solution(const MatrixXd& E, const VectorXd& f, const std::vector<bool>& passive) {
  std::vector<Index> columns;
  for (Index j = 0; j < E.cols(); ++j) {
    if (passive[j]) columns.push_back(j);
  }
  MatrixXd part(E.rows(), static_cast<Index>(columns.size()));
  for (Index k = 0; k < part.cols(); ++k) part.col(k) = E.col(columns[k]);
  const VectorXd solution = part.colPivHouseholderQr().solve(f);
  VectorXd x = VectorXd::Zero(E.cols());
  for (Index k = 0; k < part.cols(); ++k) x[columns[k]] = solution[k];
  return x;
}

// The column outside the passive set along which |E x - f| falls fastest; -1 when there is none.
Index steepest(const VectorXd& descent, const std::vector<bool>& passive, double tolerance) {
  Index best = -1;
  for (Index j = 0; j < descent.size(); ++j) {
    if (!passive[j] && descent[j] > tolerance && (best < 0 || descent[j] > descent[best])) best = j;
  }
  return best;
}

}  // namespace

VectorXd nonnegative_least_squares(const MatrixXd& E, const VectorXd& f) {
  const double tolerance = 1e-12 * E.norm() * f.norm();
  std::vector<bool> passive(E.cols(), false);
  VectorXd x = VectorXd::Zero(E.cols());
  // Lawson & Hanson find 3 n rounds ample; here n columns are many and few become passive.
  for (Index round = 0; round < 3 * E.cols(); ++round) {
    const VectorXd descent = E.transpose() * (f - E * x);
    const Index entering = steepest(descent, passive, tolerance);
    if (entering < 0) break;
    passive[entering] = true;
    VectorXd trial = passive_solution(E, f, passive);
    // Rounding: a column that does not rise from zero would be thrown out again, for ever.
    if (!(trial[entering] > 0.0)) break;
    while (true) {
      // As far towards the trial as no passive unknown turns negative.
      double way = 1.0;
      for (Index j = 0; j < x.size(); ++j) {
        if (passive[j] && trial[j] <= 0.0) way = std::min(way, x[j] / (x[j] - trial[j]));
      }
      if (way >= 1.0) break;
      x += way * (trial - x);
      for (Index j = 0; j < x.size(); ++j) {
        if (passive[j] && x[j] <= std::numeric_limits<double>::epsilon()) {
          passive[j] = false;
          x[j] = 0.0;
        }
      }
      trial = passive_solution(E, f, passive);
    }
    x = trial;
  }
  return x;
}

VectorXd least_squares_above(const MatrixXd& A, const VectorXd& b, const MatrixXd& G, const VectorXd& h) {
  const Index n = A.cols();
  // A = Q R, z = R x - Q^T b turns |A x - b| into |z|: the least distance problem (LDP) with G R^-1 z >= h - G x0.
  const Eigen::HouseholderQR<MatrixXd> qr(A);
  const MatrixXd R = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
  const auto upper = R.triangularView<Eigen::Upper>();
  const VectorXd free = upper.solve((qr.householderQ().transpose() * b).head(n));  // without constraints
  MatrixXd E(n + 1, G.rows());
  E.topRows(n) = upper.transpose().solve(MatrixXd(G.transpose()));  // (G R^-1)^T
  E.row(n) = (h - G * free).transpose();
  // Each constraint may be scaled by itself; equal norms keep the tolerance of NNLS meaningful.
  for (Index j = 0; j < E.cols(); ++j) E.col(j) /= std::max(E.col(j).head(n).norm(), 1e-300);
  const VectorXd f = VectorXd::Unit(n + 1, n);
  const VectorXd residual = E * nonnegative_least_squares(E, f) - f;
  if (!(-residual[n] > 1e-14))
    throw InputError(
        "no law of this form has a positive tangent over the whole range; choose another 'form' or 'degree'");
  const VectorXd z = -residual.head(n) / residual[n];
  return free + upper.solve(z);
}

VectorXd least_squares(const MatrixXd& A, const VectorXd& b) {
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(A);
  if (qr.rank() < A.cols())
    throw InputError(
        "the measured points cannot tell the coefficients of the law apart; give more points over a wider "
        "range, or lower 'degree'");
  return qr.solve(b);
}

}  // namespace weaveform::identify
