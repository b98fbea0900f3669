#include "converter/tables/least_squares.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace samara {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double far = 1e6;  // a bound or scale that does not matter

LeastSquaresProblem plain_problem(const VectorXd& start) {
    LeastSquaresProblem problem;
    problem.start = start;
    problem.lower = VectorXd::Constant(start.size(), -far);
    problem.upper = VectorXd::Constant(start.size(), far);
    problem.expected = VectorXd::Zero(start.size());
    problem.deviation = VectorXd::Ones(start.size());
    problem.scale = far;
    problem.most_iterations = 200;
    return problem;
}

// H. H. Rosenbrock, The Computer Journal 3, 1960: a curved valley, whose least value is at (1, 1).
LeastSquaresProblem rosenbrock() {
    LeastSquaresProblem problem = plain_problem(Vector2d(-1.2, 1.0));
    problem.deviation.setConstant(1e-3);
    problem.residuals = [](const VectorXd& x) {
        return VectorXd(Vector2d(10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]));
    };
    return problem;
}

// The distance from (3, 1), with the coordinates coupled.
LeastSquaresProblem coupled_problem() {
    LeastSquaresProblem problem = plain_problem(Vector2d::Zero());
    problem.residuals = [](const VectorXd& x) {
        return VectorXd(Vector2d(2.0 * (x[0] - 3.0) + (x[1] - 1.0), (x[0] - 3.0) + 2.0 * (x[1] - 1.0)));
    };
    return problem;
}

TEST(LeastSquares, FollowsACurvedValleyToItsEnd) {
    const LeastSquaresSolution solution = solve_least_squares(rosenbrock());
    EXPECT_TRUE(solution.converged);
    EXPECT_NEAR(solution.x[0], 1.0, 1e-4);
    EXPECT_NEAR(solution.x[1], 1.0, 1e-4);
    EXPECT_LT(solution.residuals.norm(), 1e-4);
}

TEST(LeastSquares, CountsAResidualAsOftenAsItIsTold) {
    LeastSquaresProblem problem = plain_problem(VectorXd::Zero(1));
    problem.scale = 0.5;
    problem.residuals = [](const VectorXd& x) { return VectorXd(Vector2d(x[0] - 1.0, x[0] - 2.0)); };
    problem.counts = Vector2d(3.0, 1.0);
    LeastSquaresProblem repeated = problem;
    repeated.counts.resize(0);
    repeated.residuals = [](const VectorXd& x) {
        return VectorXd(Eigen::Vector4d(x[0] - 1.0, x[0] - 1.0, x[0] - 1.0, x[0] - 2.0));
    };
    const double counted = solve_least_squares(problem).x[0];
    EXPECT_NEAR(counted, solve_least_squares(repeated).x[0], 1e-9);
    EXPECT_LT(counted, 1.5);
}

TEST(LeastSquares, SaysThatItRanOutOfIterations) {
    LeastSquaresProblem problem = rosenbrock();
    problem.most_iterations = 3;
    const LeastSquaresSolution solution = solve_least_squares(problem);
    EXPECT_FALSE(solution.converged);
    EXPECT_EQ(solution.iterations, 3);
}

TEST(LeastSquares, HoldsAParameterAtABoundAndFitsTheOthersToIt) {
    LeastSquaresProblem problem = coupled_problem();
    problem.upper[0] = 1.0;
    const LeastSquaresSolution solution = solve_least_squares(problem);
    EXPECT_EQ(solution.x[0], 1.0);
    // The sum of squares 5 a^2 + 8 a b + 5 b^2 of the distances a = -2 and b is least at b = -4/5 a.
    EXPECT_NEAR(solution.x[1], 1.0 + 1.6, 1e-3);
}

TEST(LeastSquares, LetsAParameterGoFromTheBoundItStartsAt) {
    for (const double start : {-1.0, 5.0}) {
        LeastSquaresProblem problem = coupled_problem();
        problem.lower[0] = -1.0;
        problem.upper[0] = 5.0;
        problem.start[0] = start;
        const LeastSquaresSolution solution = solve_least_squares(problem);
        EXPECT_NEAR(solution.x[0], 3.0, 1e-3) << start;
        EXPECT_NEAR(solution.x[1], 1.0, 1e-3) << start;
    }
}

TEST(LeastSquares, StartsWithinTheBounds) {
    LeastSquaresProblem problem = coupled_problem();
    problem.start << 100.0, -100.0;
    problem.lower << 0.0, 0.0;
    problem.upper << 2.0, 2.0;
    problem.most_iterations = 0;
    EXPECT_EQ(solve_least_squares(problem).x, VectorXd(Vector2d(2.0, 0.0)));
}

TEST(LeastSquares, LeavesAParameterWhoseBoundsAreOneNumber) {
    LeastSquaresProblem problem = coupled_problem();
    problem.lower[0] = problem.upper[0] = problem.start[0] = 2.0;
    const LeastSquaresSolution solution = solve_least_squares(problem);
    EXPECT_EQ(solution.x[0], 2.0);
    EXPECT_NEAR(solution.x[1], 1.0 + 0.8, 1e-3);
}

// Measurements of one number, of which the last is wrong.
LeastSquaresProblem measurements() {
    LeastSquaresProblem problem = plain_problem(VectorXd::Zero(1));
    problem.residuals = [](const VectorXd& x) {
        VectorXd values(7);
        values << 0.98, 1.02, 0.99, 1.01, 1.0, 1.0, 8.0;
        return VectorXd(values.array() - x[0]);
    };
    return problem;
}

TEST(LeastSquares, IsTheMeanWhereTheScaleIsLarge) {
    EXPECT_NEAR(solve_least_squares(measurements()).x[0], 2.0, 1e-3);
}

TEST(LeastSquares, PassesOverAnOutlierByCauchysLoss) {
    LeastSquaresProblem problem = measurements();
    problem.scale = 0.1;
    EXPECT_NEAR(solve_least_squares(problem).x[0], 1.0, 5e-3);
}

TEST(LeastSquares, TakesWhatIsExpectedWhereTheResidualsSayNothing) {
    LeastSquaresProblem problem = plain_problem(Vector2d(0.0, 5.0));
    problem.residuals = [](const VectorXd& x) { return VectorXd(VectorXd::Constant(1, x[0] - 4.0)); };
    problem.expected << 4.0, 2.0;
    problem.prior_weight = 1e-3;
    const LeastSquaresSolution solution = solve_least_squares(problem);
    EXPECT_NEAR(solution.x[0], 4.0, 1e-3);
    EXPECT_NEAR(solution.x[1], 2.0, 1e-3);
}

TEST(LeastSquares, WeighsWhatIsExpectedAgainstTheResiduals) {
    LeastSquaresProblem problem = plain_problem(VectorXd::Zero(1));
    problem.residuals = [](const VectorXd& x) { return VectorXd(VectorXd::Constant(1, x[0] - 4.0)); };
    problem.deviation[0] = 2.0;
    problem.prior_weight = 3.0;
    // (x - 4)^2 + 3 (x/2)^2 is least at 4/(1 + 3/4).
    EXPECT_NEAR(solve_least_squares(problem).x[0], 16.0 / 7.0, 1e-3);
}

// Two valleys, one at 1 and a higher one near -1.
LeastSquaresProblem two_valleys(double start) {
    LeastSquaresProblem problem = plain_problem(VectorXd::Constant(1, start));
    problem.residuals = [](const VectorXd& x) {
        return VectorXd(Vector2d(x[0] * x[0] - 1.0, 0.3 * (x[0] - 1.0)));
    };
    return problem;
}

TEST(LeastSquares, FindsTheValleyThatItStartsIn) {
    const LeastSquaresSolution low = solve_least_squares(two_valleys(2.0));
    const LeastSquaresSolution high = solve_least_squares(two_valleys(-2.0));
    EXPECT_NEAR(low.x[0], 1.0, 1e-3);
    EXPECT_NEAR(low.cost, 0.0, 1e-6);
    EXPECT_LT(high.x[0], -0.9);
    EXPECT_NEAR(high.cost, high.residuals.squaredNorm(), 1e-6);
    EXPECT_GT(high.cost, 0.3);
}

TEST(LowestSolution, IsThatOfTheStartThatLeadsLowest) {
    const auto start = [](double x) { return VectorXd(VectorXd::Constant(1, x)); };
    std::vector<double> shares;
    const LeastSquaresSolution lowest =
        lowest_solution(two_valleys(-2.0), {start(-2.0), start(2.0), start(-3.0)},
                        [&](double share) { shares.push_back(share); });
    EXPECT_EQ(lowest.x, solve_least_squares(two_valleys(2.0)).x);
    ASSERT_EQ(shares.size(), 3u);
    EXPECT_EQ(shares[0], 1.0 / 3.0);
    EXPECT_EQ(shares[2], 1.0);
}

TEST(ErrorsByExpectation, AreTheDeviationsWhereTheResidualsSayNothing) {
    LeastSquaresProblem problem = plain_problem(Vector2d(4.0, 2.0));
    problem.residuals = [](const VectorXd& x) { return VectorXd(VectorXd::Constant(1, 1e3 * (x[0] - 4.0))); };
    problem.deviation << 0.5, 0.25;
    problem.prior_weight = 0.1;
    const VectorXd errors = errors_by_expectation(problem, problem.start);
    EXPECT_LT(errors[0], 1e-5);
    EXPECT_NEAR(errors[1], 0.25, 1e-9);
}

TEST(ErrorsByExpectation, AreHowFarTheSolutionGoesWithTheExpectation) {
    LeastSquaresProblem problem = coupled_problem();
    problem.deviation << 2.0, 0.5;
    problem.prior_weight = 3.0;
    const VectorXd solution = solve_least_squares(problem).x;
    const VectorXd errors = errors_by_expectation(problem, solution);
    VectorXd squares = VectorXd::Zero(2);
    for (Eigen::Index k = 0; k < 2; ++k) {
        problem.expected[k] = problem.deviation[k];
        squares += (solve_least_squares(problem).x - solution).cwiseAbs2();
        problem.expected[k] = 0.0;
    }
    EXPECT_LT((errors - squares.cwiseSqrt()).norm(), 1e-3);
}

TEST(ErrorsByExpectation, AreZeroWithoutFreedomOrExpectation) {
    LeastSquaresProblem problem = coupled_problem();
    EXPECT_EQ(errors_by_expectation(problem, problem.start), VectorXd(Vector2d::Zero()));
    problem.prior_weight = 1.0;
    problem.lower[0] = problem.upper[0] = problem.start[0];
    const VectorXd errors = errors_by_expectation(problem, problem.start);
    EXPECT_EQ(errors[0], 0.0);
    EXPECT_GT(errors[1], 0.0);
}

TEST(LeastSquares, HasTheSameBitsForAnyNumberOfThreads) {
    LeastSquaresProblem problem = plain_problem(VectorXd::LinSpaced(7, -1.0, 1.0));
    problem.residuals = [](const VectorXd& x) {
        VectorXd residuals(20);
        for (Eigen::Index i = 0; i < residuals.size(); ++i) {
            residuals[i] = std::sin(static_cast<double>(i));
            for (Eigen::Index k = 0; k < x.size(); ++k) {
                residuals[i] += std::cos(x[k] * static_cast<double>(i + k + 1));
            }
        }
        return residuals;
    };
    problem.scale = 0.5;
    problem.prior_weight = 0.1;
    problem.threads = 1;
    const VectorXd alone = solve_least_squares(problem).x;
    for (const int threads : {2, 3, 8}) {
        problem.threads = threads;
        EXPECT_EQ(solve_least_squares(problem).x, alone) << threads;
    }
}

}  // namespace
}  // namespace samara
