#pragma once

#include <functional>

#include <Eigen/Core>

namespace samara {

/// A least-squares problem with bounds: the parameters x in [lower, upper] with the smallest
///     sum of s^2 log(1 + r_i(x)^2/s^2) + p |(x - expected)/deviation|^2,
/// Cauchy's loss, for which residuals r_i beyond s count less and less, and what is known of x beforehand.
struct LeastSquaresProblem {
    /// All residuals at x; always as many. Called from several threads at once.
    std::function<Eigen::VectorXd(const Eigen::VectorXd& x)> residuals;
    Eigen::VectorXd start;
    Eigen::VectorXd lower;
    Eigen::VectorXd upper;
    Eigen::VectorXd expected;
    Eigen::VectorXd deviation;
    double scale = 1.0;         ///< s
    double prior_weight = 0.0;  ///< p
    int most_iterations = 40;
    int threads = 0;  ///< 0: all cores
};

struct LeastSquaresSolution {
    Eigen::VectorXd x;
    double rms = 0.0;  ///< of the residuals
    int iterations = 0;
    bool converged = false;  ///< false: the iterations ran out
};

/// Levenberg and Marquardt's method with differences for the gradient; parameters at a bound that the gradient pushes
/// beyond it are held there (Nocedal & Wright, Numerical Optimization, 2nd ed., sections 10.3 and 16.7).
LeastSquaresSolution solve_least_squares(const LeastSquaresProblem& problem);

}  // namespace samara
