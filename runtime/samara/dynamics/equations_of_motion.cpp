#include "samara/dynamics/equations_of_motion.hpp"

#include <limits>

#include <Eigen/Cholesky>

#include "samara/dynamics/loads.hpp"

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

}  // namespace

MotionVector motion_vector(const BodyState& state) noexcept {
    MotionVector motion;
    motion << state.velocity, state.orientation.w(), state.orientation.vec(), state.position;
    return motion;
}

BodyState body_state(const MotionVector& motion, const SeenFluid& seen_fluid) noexcept {
    BodyState state;
    state.velocity = motion.head<6>();
    state.orientation = Quaterniond(motion[6], motion[7], motion[8], motion[9]).normalized();
    state.position = motion.tail<3>();
    state.seen_fluid = seen_fluid;
    return state;
}

EquationsOfMotion::EquationsOfMotion(const ImmersedBody& body, const Vector3d& gravity,
                                     const SeenFluid& seen_fluid) noexcept
    : body_(&body),
      mobility_(body.inertia.llt().solve(Matrix6d::Identity())),
      gravity_(gravity),
      seen_fluid_(seen_fluid) {}

Vector6d EquationsOfMotion::load(const Vector6d& relative_velocity,
                                 const Vector3d& angular_velocity) const noexcept {
    return -(load_matrix(*body_, relative_velocity, angular_velocity) * relative_velocity);
}

Vector6d EquationsOfMotion::relative_velocity(const MotionVector& motion,
                                              const Matrix3d& to_world) const noexcept {
    Vector6d fluid;
    fluid << to_world.transpose() * seen_fluid_.angular_velocity, to_world.transpose() * seen_fluid_.velocity;
    return body_->to_centroid * motion.head<6>() - fluid;
}

MotionVector EquationsOfMotion::rate(const MotionVector& motion) const noexcept {
    const Vector3d omega = motion.head<3>();
    const Vector3d velocity = motion.segment<3>(3);
    const Matrix3d to_world = homogeneous_rotation(motion.segment<4>(6));
    const Vector6d momentum = body_->inertia * motion.head<6>();
    const Vector3d angular = momentum.head<3>();
    const Vector3d linear = momentum.tail<3>();

    const Vector3d gravity_in_body = to_world.transpose() * gravity_;
    const double displaced = body_->fluid_density * body_->volume;
    Vector6d momentum_rate;
    momentum_rate << angular.cross(omega) + linear.cross(velocity) -
                         displaced * body_->center_of_buoyancy.cross(gravity_in_body),
        linear.cross(omega) + (body_->mass - displaced) * gravity_in_body;
    if (body_->loads != Loads::none) {
        momentum_rate += body_->to_centroid.transpose() * load(relative_velocity(motion, to_world), omega);
    }

    MotionVector result;
    result << mobility_ * momentum_rate, quaternion_rate(motion.segment<4>(6), omega), to_world * velocity;
    return result;
}

Matrix6d EquationsOfMotion::acceleration_gradient(const MotionVector& motion) const noexcept {
    const Vector6d momentum = body_->inertia * motion.head<6>();
    const Matrix3d angular = skew(momentum.head<3>());
    const Matrix3d linear = skew(momentum.tail<3>());
    const Matrix3d omega = skew(motion.head<3>());
    Matrix6d by_velocity = Matrix6d::Zero();
    by_velocity << angular, linear, linear, Matrix3d::Zero();
    Matrix6d by_momentum = Matrix6d::Zero();
    by_momentum << -omega, -skew(motion.segment<3>(3)), Matrix3d::Zero(), -omega;
    Matrix6d gradient = by_velocity + by_momentum * body_->inertia;

    if (body_->loads != Loads::none) {
        const Vector6d relative = relative_velocity(motion, homogeneous_rotation(motion.segment<4>(6)));
        const Vector3d omega_here = motion.head<3>();
        const Vector6d load_here = load(relative, omega_here);
        // Differences of a millionth of the speeds that are there; any will do for a body at rest.
        const double speed = relative.tail<3>().norm() + body_->length * relative.head<3>().norm();
        const double difference = 1e-6 * speed + std::numeric_limits<double>::min() * 1e20;
        Matrix6d by_relative_velocity;
        for (int i = 0; i < 6; ++i) {
            Vector6d moved = relative;
            moved[i] += i < 3 ? difference / body_->length : difference;
            const Vector3d turning = omega_here + (moved - relative).head<3>();
            by_relative_velocity.col(i) = (load(moved, turning) - load_here) / (moved[i] - relative[i]);
        }
        gradient += body_->to_centroid.transpose() * by_relative_velocity * body_->to_centroid;
    }
    return mobility_ * gradient;
}

}  // namespace samara
