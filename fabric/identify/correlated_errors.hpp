// Errors of a least-squares fit whose residuals are alike from one point to the next, as those of one specimen are.
#pragma once

#include <Eigen/Core>

namespace weaveform::identify {

struct CorrelatedErrors {
  Eigen::MatrixXd covariance;  // of the parameters
  double correlation = 0.0;    // of neighbouring errors
  double freedom = 0.0;        // degrees of freedom of the variance (Satterthwaite 1946)
};

// `J` holds the derivatives of each fitted value, on evenly spaced points, by each parameter; the errors e are taken to
// be first-order autoregressive, E[e_i e_j] = s^2 rho^|i-j|. A fit takes part of the errors away, r = M e with M = 1 -
// J J^+, so neighbouring residuals are less alike than the errors were: rho is the one for which the expected ratio
//   tr(S M R M) / tr(M R M) ,  R_ij = rho^|i-j| , S the shift by one point,
// is the observed sum r_i r_(i+1) / sum r_i^2, taken one of its standard deviations too high to be safe; then s^2 =
// |r|^2 / tr(M R M), and the covariance is J^+ s^2 R J^+^T.
[[nodiscard]] CorrelatedErrors correlated_errors(const Eigen::MatrixXd& J, const Eigen::VectorXd& residual);

}  // namespace weaveform::identify
