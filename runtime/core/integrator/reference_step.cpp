#include "samara/core/integrator/reference_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <Eigen/LU>

#include "samara/core/integrator/equations_of_motion.hpp"
#include "samara/core/integrator/step.hpp"

namespace samara {
namespace {

using Matrix12d = Eigen::Matrix<double, 12, 12>;
using Vector12d = Eigen::Matrix<double, 12, 1>;
using Stages = std::array<MotionVector, 2>;

constexpr int most_iterations = 60;
constexpr int most_slow_iterations = 3;  // that shrink the change by less than half; shorter parts cost less
constexpr double rounding = std::numeric_limits<double>::epsilon();
constexpr double nearly_rounding = 1e3 * rounding;

// The two-stage Gauss method's coefficients a_ij; its weights are 1/2.
constexpr double root = std::numbers::sqrt3 / 6.0;
constexpr double gauss[2][2] = {{0.25, 0.25 - root}, {0.25 + root, 0.25}};

/// sqrt(2 E) of velocities: one measure for rotation and translation.
double energy_norm(const Matrix6d& inertia, const Vector6d& velocity) {
    return std::sqrt(velocity.dot(inertia * velocity));
}

/// The matrix of the simplified Newton method for the stages' velocities.
Matrix12d newton_matrix(const Matrix6d& gradient, double h) {
    Matrix12d matrix = Matrix12d::Identity();
    for (Eigen::Index i = 0; i < 2; ++i) {
        for (Eigen::Index j = 0; j < 2; ++j) matrix.block<6, 6>(6 * i, 6 * j) -= h * gauss[i][j] * gradient;
    }
    return matrix;
}

/// Iterates the stages until nothing but rounding changes them, and gives the rates there; nothing where that
/// is not reached. Newton in the velocities, where drag is stiff; the quaternions and the wake, on which less
/// depends, and the positions, on which nothing does, by substitution.
std::optional<Stages> solved_rates(const ImmersedBody& body, const EquationsOfMotion& equations,
                                   const MotionVector& start, double h, Stages stages) noexcept {
    const Matrix6d gradient = equations.acceleration_gradient(0.5 * (stages[0] + stages[1]));
    const Eigen::PartialPivLU<Matrix12d> newton(newton_matrix(gradient, h));
    double least_change = std::numeric_limits<double>::infinity();
    int slow = 0;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        const Stages rates = {equations.rate(stages[0]), equations.rate(stages[1])};
        Stages next;
        Vector12d missing;
        for (std::size_t i = 0; i < 2; ++i) {
            next[i] = start + h * (gauss[i][0] * rates[0] + gauss[i][1] * rates[1]);
            missing.segment<6>(6 * static_cast<Eigen::Index>(i)) = (next[i] - stages[i]).head<6>();
        }
        const Vector12d step = newton.solve(missing);
        double change = 0.0;
        double turned = 0.0;
        double scale = energy_norm(body.inertia, start.head<6>());
        for (std::size_t i = 0; i < 2; ++i) {
            const Vector6d moved = step.segment<6>(6 * static_cast<Eigen::Index>(i));
            next[i].head<6>() = stages[i].head<6>() + moved;
            change = std::max(change, energy_norm(body.inertia, moved));
            const MotionVector difference = next[i] - stages[i];
            turned = std::max({turned, difference.segment<4>(6).norm(), difference.tail<4>().norm()});
            scale = std::max(scale, energy_norm(body.inertia, next[i].head<6>()));
        }
        change = std::max(scale > 0.0 ? change / scale : 0.0, turned);
        if (!std::isfinite(change)) return {};
        // Not the first change below a tolerance ends it, which would let energy drift one way, but the last
        // that shrinks: Hairer, McLachlan, Razakarivony, Achieving Brouwer's law with implicit Runge-Kutta
        // methods, BIT 48 (2008).
        const bool still_shrinks = change < least_change;
        if (change <= 0.5 * rounding || (!still_shrinks && change <= nearly_rounding)) return rates;
        if (change > nearly_rounding && change > 0.5 * least_change && ++slow > most_slow_iterations)
            return {};
        least_change = std::min(least_change, change);
        stages = next;
    }
    return {};
}

/// The Gauss step, where its equations could be solved.
std::optional<BodyState> gauss_step(const ImmersedBody& body, const EquationsOfMotion& equations,
                                    const Vector3d& gravity, double h, const BodyState& state) noexcept {
    const Stages predicted = {motion_vector(implicit_step(body, gravity, (0.5 - root) * h, state)),
                              motion_vector(implicit_step(body, gravity, (0.5 + root) * h, state))};
    const MotionVector start = motion_vector(state);
    const std::optional<Stages> rates = solved_rates(body, equations, start, h, predicted);
    if (!rates) return {};
    return body_state(start + 0.5 * h * ((*rates)[0] + (*rates)[1]), state.seen_fluid);
}

void advance_part(const ImmersedBody& body, const EquationsOfMotion& equations, const Vector3d& gravity,
                  double h, int halvings_left, ReferenceResult& result) noexcept {
    if (const auto next = gauss_step(body, equations, gravity, h, result.state)) {
        result.state = *next;
    } else if (halvings_left > 0) {
        ++result.parts;
        for (int half = 0; half < 2; ++half) {
            advance_part(body, equations, gravity, 0.5 * h, halvings_left - 1, result);
        }
    } else {
        result.converged = false;
        result.state = implicit_step(body, gravity, h, result.state);
    }
}

}  // namespace

ReferenceResult reference_step(const ImmersedBody& body, const Vector3d& gravity, double time_step,
                               const BodyState& state) noexcept {
    ReferenceResult result{state, 1, true};
    const EquationsOfMotion equations(body, gravity, state.seen_fluid);
    advance_part(body, equations, gravity, time_step, reference_halvings, result);
    return result;
}

}  // namespace samara
