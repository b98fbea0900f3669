#include "converter/tables/least_squares.hpp"

#include <algorithm>
#include <vector>

#include <Eigen/Cholesky>

#include "samara/core/base/parallel_for.hpp"

namespace samara {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The damping starts like Marquardt's (SIAM J. Appl. Math. 11, 1963): at a hundredth of the diagonal. The
// other numbers are chosen.
constexpr double difference = 1e-3;  // of a parameter, relative to its deviation
constexpr double least_gain = 1e-5;  // relative, of the cost: below it the iterations end
constexpr double first_damping = 1e-2;
constexpr double least_damping = 1e-6;
constexpr double largest_damping = 1e8;  // beyond it no step lowers the cost

struct Iterate {
    VectorXd x;
    VectorXd residuals;
    double cost = 0.0;
};

Iterate point_at(const LeastSquaresProblem& problem, const VectorXd& x) {
    Iterate point{x, problem.residuals(x)};
    const double square = problem.scale * problem.scale;
    const VectorXd costs = square * (point.residuals.array().square() / square).log1p();
    point.cost += problem.counts.size() == 0 ? costs.sum() : problem.counts.dot(costs);
    point.cost +=
        problem.prior_weight * ((x - problem.expected).cwiseQuotient(problem.deviation)).squaredNorm();
    return point;
}

// Returns half the second derivatives of the prior, a diagonal matrix.
VectorXd prior_of(const LeastSquaresProblem& problem) {
    return problem.prior_weight * problem.deviation.cwiseAbs2().cwiseInverse();
}

// Returns the weights of the residuals by Cauchy's loss and their counts.
VectorXd weights_of(const LeastSquaresProblem& problem, const VectorXd& residuals) {
    const VectorXd weights = (1.0 + residuals.array().square() / (problem.scale * problem.scale)).inverse();
    return problem.counts.size() == 0 ? weights : VectorXd(weights.cwiseProduct(problem.counts));
}

MatrixXd jacobian(const LeastSquaresProblem& problem, const Iterate& point) {
    MatrixXd columns(point.residuals.size(), point.x.size());
    parallel_for(
        static_cast<std::size_t>(point.x.size()), 1, problem.threads, [&](std::size_t index, std::size_t) {
            const auto k = static_cast<Eigen::Index>(index);
            VectorXd x = point.x;
            const double step = difference * problem.deviation[k];
            x[k] += x[k] + step > problem.upper[k] ? -step : step;
            columns.col(k) = problem.upper[k] > problem.lower[k]
                                 ? VectorXd((problem.residuals(x) - point.residuals) / (x[k] - point.x[k]))
                                 : VectorXd(VectorXd::Zero(point.residuals.size()));
        });
    return columns;
}

// Returns the parameters that the descent direction does not push beyond a bound.
std::vector<Eigen::Index> free_parameters(const LeastSquaresProblem& problem, const VectorXd& x,
                                          const VectorXd& gradient) {
    std::vector<Eigen::Index> free;
    for (Eigen::Index k = 0; k < x.size(); ++k) {
        const bool at_lower = x[k] <= problem.lower[k] && gradient[k] >= 0.0;
        const bool at_upper = x[k] >= problem.upper[k] && gradient[k] <= 0.0;
        if (!at_lower && !at_upper) free.push_back(k);
    }
    return free;
}

VectorXd damped_step(const MatrixXd& normal, const VectorXd& gradient, double damping,
                     const std::vector<Eigen::Index>& free) {
    VectorXd step = VectorXd::Zero(gradient.size());
    if (free.empty()) return step;
    MatrixXd matrix = normal(free, free);
    matrix.diagonal() *= 1.0 + damping;
    step(free) = -matrix.ldlt().solve(VectorXd(gradient(free)));
    return step;
}

}  // namespace

LeastSquaresSolution solve_least_squares(const LeastSquaresProblem& problem) {
    const auto within = [&](const VectorXd& x) {
        return VectorXd(x.cwiseMax(problem.lower).cwiseMin(problem.upper));
    };
    Iterate point = point_at(problem, within(problem.start));
    const VectorXd prior = prior_of(problem);
    LeastSquaresSolution solution;
    double damping = first_damping;
    while (solution.iterations < problem.most_iterations && !solution.converged) {
        ++solution.iterations;
        const MatrixXd columns = jacobian(problem, point);
        const VectorXd weights = weights_of(problem, point.residuals);
        MatrixXd normal = columns.transpose() * weights.asDiagonal() * columns;
        normal.diagonal() += prior;
        const VectorXd gradient = columns.transpose() * weights.cwiseProduct(point.residuals) +
                                  prior.cwiseProduct(point.x - problem.expected);
        const auto free = free_parameters(problem, point.x, gradient);
        const double before = point.cost;
        while (damping < largest_damping) {
            Iterate next = point_at(problem, within(point.x + damped_step(normal, gradient, damping, free)));
            if (next.cost < point.cost) {
                point = std::move(next);
                damping = std::max(least_damping, 0.25 * damping);
                break;
            }
            damping *= 4.0;
        }
        solution.converged = before - point.cost <= least_gain * before;
    }
    solution.x = point.x;
    solution.residuals = point.residuals;
    solution.cost = point.cost;
    return solution;
}

LeastSquaresSolution lowest_solution(LeastSquaresProblem problem, const std::vector<VectorXd>& starts,
                                     const std::function<void(double)>& solved) {
    LeastSquaresSolution lowest;
    for (std::size_t i = 0; i < starts.size(); ++i) {
        problem.start = starts[i];
        LeastSquaresSolution found = solve_least_squares(problem);
        if (i == 0 || found.cost < lowest.cost) lowest = std::move(found);
        if (solved) solved(static_cast<double>(i + 1) / static_cast<double>(starts.size()));
    }
    return lowest;
}

VectorXd errors_by_expectation(const LeastSquaresProblem& problem, const VectorXd& x) {
    const Iterate point = point_at(problem, x);
    const MatrixXd columns = jacobian(problem, point);
    MatrixXd normal = columns.transpose() * weights_of(problem, point.residuals).asDiagonal() * columns;
    normal.diagonal() += prior_of(problem);
    VectorXd errors = VectorXd::Zero(x.size());
    std::vector<Eigen::Index> open;
    for (Eigen::Index k = 0; k < x.size(); ++k) {
        if (problem.lower[k] < problem.upper[k]) open.push_back(k);
    }
    if (open.empty() || problem.prior_weight == 0.0) return errors;
    // An expectation that is off by e moves the solution by N^-1 P e; e is independent for each parameter.
    const MatrixXd shifts =
        MatrixXd(normal(open, open))
            .ldlt()
            .solve(MatrixXd(
                VectorXd(problem.prior_weight * problem.deviation(open).cwiseInverse()).asDiagonal()));
    errors(open) = shifts.rowwise().norm();
    return errors;
}

}  // namespace samara
