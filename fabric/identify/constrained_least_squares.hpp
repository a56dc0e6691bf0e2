// Least squares under linear inequalities, for a handful of unknowns: the convex quadratic programme behind a fit whose
// tangent must stay positive. Algorithms NNLS, LDP and LSI of Lawson & Hanson, Solving Least Squares Problems (1974),
// chapter 23.
#pragma once

#include <Eigen/Core>

namespace weaveform::identify {

// x >= 0 that makes |E x - f| least. An active-set method: ends after finitely many changes of the set.
[[nodiscard]] Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& E, const Eigen::VectorXd& f);

// x that makes |A x - b| least under G x >= h. A has full column rank. Throws InputError when no x satisfies G x >= h.
[[nodiscard]] Eigen::VectorXd least_squares_above(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                                  const Eigen::MatrixXd& G, const Eigen::VectorXd& h);

// x that makes |A x - b| least. Throws InputError when the columns of A are not independent, in words about the data.
[[nodiscard]] Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace weaveform::identify
