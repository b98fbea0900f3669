#include "support/reference_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "samara/core/integrator/step.hpp"
#include "samara/core/kernel/kernel.hpp"

namespace samara {

Matrix6d load_matrix(const ImmersedBody& body, const Vector6d& relative_velocity) noexcept {
    return load_matrices(body, relative_velocity, Vector3d::Zero()).whole;
}

namespace {

/// |q|^2 times the rotation of q, for q = (w, x, y, z) of any length.
Matrix3d homogeneous_rotation(const Eigen::Vector4d& q) {
    const double w = q[0];
    const Vector3d axis = q.tail<3>();
    return (w * w - axis.squaredNorm()) * Matrix3d::Identity() + 2.0 * axis * axis.transpose() +
           2.0 * w * skew(axis);
}

/// q' = q (0, omega) / 2.
Eigen::Vector4d quaternion_rate(const Eigen::Vector4d& q, const Vector3d& omega) {
    Eigen::Vector4d rate;
    rate[0] = -0.5 * q.tail<3>().dot(omega);
    rate.tail<3>() = 0.5 * (q[0] * omega + q.tail<3>().cross(omega));
    return rate;
}

Wake wake_of(const MotionVector& motion) {
    return {motion[13], motion.tail<3>()};
}

}  // namespace

MotionVector motion_vector(const BodyState& state) noexcept {
    MotionVector motion;
    motion << state.velocity, state.orientation.w(), state.orientation.vec(), state.position,
        state.wake.formed, state.wake.heading;
    return motion;
}

BodyState body_state(const MotionVector& motion, const SampledTurbulence& sampled_turbulence) noexcept {
    BodyState state;
    state.velocity = motion.head<6>();
    state.orientation = Quaterniond(motion[6], motion[7], motion[8], motion[9]).normalized();
    state.position = motion.segment<3>(10);
    state.wake = wake_of(motion);
    state.sampled_turbulence = sampled_turbulence;
    return state;
}

EquationsOfMotion::EquationsOfMotion(const ImmersedBody& body, const Vector3d& gravity,
                                     const SampledTurbulence& sampled_turbulence) noexcept
    : body_(&body),
      mobility_(body.inertia.llt().solve(Matrix6d::Identity())),
      gravity_(gravity),
      sampled_turbulence_(sampled_turbulence) {}

Vector6d EquationsOfMotion::load(const Vector6d& velocity, const Matrix3d& to_world,
                                 const WakeShares& shares) const noexcept {
    const Vector6d of_centroid = body_->to_centroid * velocity;
    const Vector3d sampled_rotation = to_world.transpose() * sampled_turbulence_.angular_velocity;
    const LoadMatrices loads = load_matrices(*body_, of_centroid, sampled_rotation, Vector3d::Zero(), shares);
    return loads.relative.leftCols<3>() * sampled_rotation - loads.whole * of_centroid;
}

MotionVector EquationsOfMotion::rate(const MotionVector& motion) const noexcept {
    const Vector3d omega = motion.head<3>();
    const Matrix3d to_world = homogeneous_rotation(motion.segment<4>(6));
    const Vector3d sampled_velocity = to_world.transpose() * sampled_turbulence_.velocity;
    Vector6d relative = motion.head<6>();
    relative.tail<3>() -= sampled_velocity;
    const Vector6d momentum = body_->inertia * relative;
    const Vector3d angular = momentum.head<3>();
    const Vector3d linear = momentum.tail<3>();

    const Vector3d gravity_in_body = to_world.transpose() * gravity_;
    const double displaced = body_->fluid_density * body_->volume;
    Vector6d momentum_rate;
    momentum_rate << angular.cross(omega) + linear.cross(relative.tail<3>()) -
                         displaced * body_->center_of_buoyancy.cross(gravity_in_body),
        linear.cross(omega) + (body_->mass - displaced) * gravity_in_body;
    if (body_->loads != Loads::none) {
        momentum_rate +=
            body_->to_centroid.transpose() * load(relative, to_world, shares_of(wake_of(motion)));
    }

    Vector6d acceleration = mobility_ * momentum_rate;
    acceleration.tail<3>() -=
        omega.cross(sampled_velocity);  // the sampled turbulence rotates relative to the body's axes
    MotionVector result;
    const Vector6d of_centroid = body_->to_centroid * relative;
    const auto [formed, heading] = wake_of(motion);
    const WakeRates rates = wake_rates(*body_, of_centroid);
    result << acceleration, quaternion_rate(motion.segment<4>(6), omega), to_world * motion.segment<3>(3),
        rates.formation * (1.0 - formed),
        rates.settling * (of_centroid.tail<3>().stableNormalized() - heading) +
            heading.cross(rates.spin_about_symmetry);
    return result;
}

Matrix6d EquationsOfMotion::acceleration_gradient(const MotionVector& motion) const noexcept {
    const Matrix3d to_world = homogeneous_rotation(motion.segment<4>(6));
    const Vector3d sampled_velocity = to_world.transpose() * sampled_turbulence_.velocity;
    Vector6d relative = motion.head<6>();
    relative.tail<3>() -= sampled_velocity;
    const Vector6d momentum = body_->inertia * relative;
    const Matrix3d angular = skew(momentum.head<3>());
    const Matrix3d linear = skew(momentum.tail<3>());
    const Matrix3d omega = skew(motion.head<3>());
    Matrix6d by_velocity = Matrix6d::Zero();
    by_velocity << angular, linear, linear, Matrix3d::Zero();
    Matrix6d by_momentum = Matrix6d::Zero();
    by_momentum << -omega, -skew(relative.tail<3>()), Matrix3d::Zero(), -omega;
    Matrix6d gradient = by_velocity + by_momentum * body_->inertia;

    if (body_->loads != Loads::none) {
        const WakeShares shares = shares_of(wake_of(motion));
        const Vector6d load_here = load(relative, to_world, shares);
        // Differences of a millionth of the speeds that are there; any will do for a body at rest.
        const double turning = relative.head<3>().norm() + sampled_turbulence_.angular_velocity.norm();
        const double speed = relative.tail<3>().norm() + body_->length * turning;
        const double difference = 1e-6 * speed + std::numeric_limits<double>::min() * 1e20;
        Matrix6d by_relative_velocity;
        for (int i = 0; i < 6; ++i) {
            Vector6d moved = relative;
            moved[i] += i < 3 ? difference / body_->length : difference;
            by_relative_velocity.col(i) =
                (load(moved, to_world, shares) - load_here) / (moved[i] - relative[i]);
        }
        gradient += body_->to_centroid.transpose() * by_relative_velocity;
    }
    gradient = mobility_ * gradient;
    gradient.bottomLeftCorner<3, 3>() += skew(sampled_velocity);
    return gradient;
}

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
    return body_state(start + 0.5 * h * ((*rates)[0] + (*rates)[1]), state.sampled_turbulence);
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
    const EquationsOfMotion equations(body, gravity, state.sampled_turbulence);
    advance_part(body, equations, gravity, time_step, reference_halvings, result);
    return result;
}

SampledTurbulence advance_sampled_turbulence(const ImmersedBody& body, const TurbulenceLevel& level,
                                             const SampledTurbulence& seen, double time_step,
                                             const Noise& noise, std::uint64_t step) noexcept {
    BodyState state;
    state.sampled_turbulence = seen;
    kernel::advance_sampled_turbulence(body.constants, level, time_step, noise, step, state);
    return state.sampled_turbulence;
}

Vector6d advance_body_velocity(const ImmersedBody& body, const TurbulenceLevel& level,
                               const Vector6d& velocity, double time_step, const Noise& noise,
                               std::uint64_t step) noexcept {
    BodyState state;
    state.velocity = velocity;
    kernel::advance_body_velocity(body.constants, level, time_step, noise, step, state);
    return state.velocity;
}

double kinetic_energy(const ImmersedBody& body, const BodyState& state) noexcept {
    return 0.5 * state.velocity.dot(body.inertia * state.velocity);
}

}  // namespace samara
