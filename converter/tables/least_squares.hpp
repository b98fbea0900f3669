#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

namespace samara {

/// A least-squares problem with bounds: the parameters x in [lower, upper] with the smallest
///     sum of c_i s^2 log(1 + r_i(x)^2/s^2) + p |(x - expected)/deviation|^2,
/// Cauchy's loss, for which residuals r_i beyond s count less and less, and what is known of x beforehand.
struct LeastSquaresProblem {
    /// All residuals at x; always as many. Called from several threads at once.
    std::function<Eigen::VectorXd(const Eigen::VectorXd& x)> residuals;
    Eigen::VectorXd start;  ///< taken into the bounds where it is outside
    Eigen::VectorXd lower;
    Eigen::VectorXd upper;  ///< as `lower` where a parameter is to stay as it is
    Eigen::VectorXd expected;
    Eigen::VectorXd
        deviation;  ///< of what is expected, above 0; differences for the gradient are a thousandth of it
    /// c, as many as residuals, above 0: for how many residuals each counts; one where it is empty.
    Eigen::VectorXd counts;
    double scale = 1.0;         ///< s
    double prior_weight = 0.0;  ///< p
    int most_iterations = 40;
    int threads = 0;  ///< 0: all cores
};

struct LeastSquaresSolution {
    Eigen::VectorXd x;
    Eigen::VectorXd residuals;  ///< at x
    double cost = 0.0;          ///< at x: what is the smallest
    int iterations = 0;
    bool converged = false;  ///< false: the iterations ran out
};

/// Levenberg and Marquardt's method with differences for the gradient; parameters at a bound that the
/// gradient pushes beyond it are held there (Nocedal & Wright, Numerical Optimization, 2nd ed., sections 10.3
/// and 16.7).
LeastSquaresSolution solve_least_squares(const LeastSquaresProblem& problem);

/// The lowest of the solutions that are found from these starts, at least one, in place of the problem's own:
/// of a cost with several valleys a descent finds the one it starts in. `solved` is told after each start the
/// share that is done, if it is given.
LeastSquaresSolution lowest_solution(LeastSquaresProblem problem, const std::vector<Eigen::VectorXd>& starts,
                                     const std::function<void(double)>& solved = {});

/// The standard errors that the solution x has since what is expected is itself known to its deviations
/// alone: the deviation of a parameter that the residuals say nothing of, little of one that they determine,
/// zero of one without freedom. Linearised at x, without the bounds.
Eigen::VectorXd errors_by_expectation(const LeastSquaresProblem& problem, const Eigen::VectorXd& x);

}  // namespace samara
