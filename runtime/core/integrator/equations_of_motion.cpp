#include "samara/core/integrator/equations_of_motion.hpp"

#include <limits>

#include <Eigen/Cholesky>

#include "samara/core/dynamics/loads.hpp"

namespace samara {
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

BodyState body_state(const MotionVector& motion, const SeenFluid& seen_fluid) noexcept {
    BodyState state;
    state.velocity = motion.head<6>();
    state.orientation = Quaterniond(motion[6], motion[7], motion[8], motion[9]).normalized();
    state.position = motion.segment<3>(10);
    state.wake = wake_of(motion);
    state.seen_fluid = seen_fluid;
    return state;
}

EquationsOfMotion::EquationsOfMotion(const ImmersedBody& body, const Vector3d& gravity,
                                     const SeenFluid& seen_fluid) noexcept
    : body_(&body),
      mobility_(body.inertia.llt().solve(Matrix6d::Identity())),
      gravity_(gravity),
      seen_fluid_(seen_fluid) {}

Vector6d EquationsOfMotion::load(const Vector6d& velocity, const Matrix3d& to_world,
                                 const WakeShares& shares) const noexcept {
    const Vector6d of_centroid = body_->to_centroid * velocity;
    const Vector3d seen_rotation = to_world.transpose() * seen_fluid_.angular_velocity;
    const LoadMatrices loads = load_matrices(*body_, of_centroid, seen_rotation, Vector3d::Zero(), shares);
    return loads.relative.leftCols<3>() * seen_rotation - loads.whole * of_centroid;
}

MotionVector EquationsOfMotion::rate(const MotionVector& motion) const noexcept {
    const Vector3d omega = motion.head<3>();
    const Matrix3d to_world = homogeneous_rotation(motion.segment<4>(6));
    const Vector3d seen_velocity = to_world.transpose() * seen_fluid_.velocity;
    Vector6d relative = motion.head<6>();
    relative.tail<3>() -= seen_velocity;
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
    acceleration.tail<3>() -= omega.cross(seen_velocity);  // the seen fluid turns past the body's axes
    MotionVector result;
    const Vector6d of_centroid = body_->to_centroid * relative;
    const auto [formed, heading] = wake_of(motion);
    const WakeRates rates = wake_rates(*body_, of_centroid);
    result << acceleration, quaternion_rate(motion.segment<4>(6), omega), to_world * motion.segment<3>(3),
        rates.formation * (1.0 - formed),
        rates.settling * (of_centroid.tail<3>().stableNormalized() - heading) +
            heading.cross(rates.unseen_turning);
    return result;
}

Matrix6d EquationsOfMotion::acceleration_gradient(const MotionVector& motion) const noexcept {
    const Matrix3d to_world = homogeneous_rotation(motion.segment<4>(6));
    const Vector3d seen_velocity = to_world.transpose() * seen_fluid_.velocity;
    Vector6d relative = motion.head<6>();
    relative.tail<3>() -= seen_velocity;
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
        const double turning = relative.head<3>().norm() + seen_fluid_.angular_velocity.norm();
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
    gradient.bottomLeftCorner<3, 3>() += skew(seen_velocity);
    return gradient;
}

}  // namespace samara
