#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

namespace samara {

/// A least-squares problem with bounds: the parameters x in [lower, upper] with the smallest
///     sum of c_i s^2 log(1 + r_i(x)^2/s^2) + p |(x - expected)/deviation|^2,
/// with Cauchy's loss, by which residuals r_i beyond s count less and less, and a prior on x.
struct LeastSquaresProblem {
    /// Returns all residuals at x, always equally many. Called from several threads at once.
    std::function<Eigen::VectorXd(const Eigen::VectorXd& x)> residuals;
    Eigen::VectorXd start;  ///< clamped to the bounds
    Eigen::VectorXd lower;
    Eigen::VectorXd upper;  ///< equal to `lower` where a parameter is fixed
    Eigen::VectorXd expected;
    Eigen::VectorXd
        deviation;  ///< of the prior, above 0; differences for the gradient are a thousandth of it
    /// c, one for each residual, above 0: for how many residuals it counts; empty: one each.
    Eigen::VectorXd counts;
    double scale = 1.0;         ///< s
    double prior_weight = 0.0;  ///< p
    int most_iterations = 40;
    int threads = 0;  ///< 0: all cores
};

struct LeastSquaresSolution {
    Eigen::VectorXd x;
    Eigen::VectorXd residuals;  ///< at x
    double cost = 0.0;          ///< the minimised sum at x
    int iterations = 0;
    bool converged = false;  ///< false: the iterations ran out
};

/// Solves the problem by the Levenberg-Marquardt method with differences for the gradient; parameters at a
/// bound that the gradient pushes beyond it are held there (Nocedal & Wright, Numerical Optimization, 2nd
/// ed., sections 10.3 and 16.7).
LeastSquaresSolution solve_least_squares(const LeastSquaresProblem& problem);

/// Returns the solution of lowest cost from several starts (at least one) in place of the problem's own, for
/// costs with several local minima. `solved`: called after each start with the share done.
LeastSquaresSolution lowest_solution(LeastSquaresProblem problem, const std::vector<Eigen::VectorXd>& starts,
                                     const std::function<void(double)>& solved = {});

/// Returns the standard errors of the solution x by the uncertainty of the prior: the prior's deviation for a
/// parameter that the residuals do not determine, little for one that they do, zero for a fixed one.
/// Linearised at x, without the bounds.
Eigen::VectorXd errors_by_expectation(const LeastSquaresProblem& problem, const Eigen::VectorXd& x);

}  // namespace samara
