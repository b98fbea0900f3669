#include "samara/core/collision/free_flight.hpp"

#include <Eigen/LU>

namespace samara {
namespace {

constexpr int most_iterations = 12;
// the last step relative to the velocity, by energy: the next would be of its square
constexpr double solved = 1e-9;

/// Returns K u' of Kirchhoff's equations: (l x omega + p x v, p x omega).
Vector6d rate_of_momentum(const Vector6d& momentum, const Vector6d& velocity) {
    Vector6d rate;
    rate << momentum.head<3>().cross(velocity.head<3>()) + momentum.tail<3>().cross(velocity.tail<3>()),
        momentum.tail<3>().cross(velocity.head<3>());
    return rate;
}

/// Returns the derivative of rate_of_momentum() with respect to the velocity.
Matrix6d gradient_of_rate(const Matrix6d& inertia, const Vector6d& momentum, const Vector6d& velocity) {
    Matrix6d by_velocity;
    by_velocity << skew(momentum.head<3>()), skew(momentum.tail<3>()), skew(momentum.tail<3>()),
        Matrix3d::Zero();
    Matrix6d by_momentum;
    by_momentum << skew(velocity.head<3>()), skew(velocity.tail<3>()), Matrix3d::Zero(),
        skew(velocity.head<3>());
    return by_velocity - by_momentum * inertia;
}

}  // namespace

PlacedMotion free_flight(const Matrix6d& inertia, const PlacedMotion& begin, double time) noexcept {
    const Matrix3d to_world = begin.place.orientation.toRotationMatrix();
    Vector6d start;
    start << to_world.transpose() * begin.velocity.head<3>(), to_world.transpose() * begin.velocity.tail<3>();
    // Newton's method for the velocity at mid-step, by its change from the start.
    const double energy = start.dot(inertia * start);
    Vector6d change = Vector6d::Zero();
    bool is_solved = energy == 0.0;
    for (int i = 0; i < most_iterations && !is_solved; ++i) {
        const Vector6d middle = start + change;
        const Vector6d momentum = inertia * middle;
        const Vector6d missing = 0.5 * time * rate_of_momentum(momentum, middle) - inertia * change;
        const Matrix6d matrix = inertia - 0.5 * time * gradient_of_rate(inertia, momentum, middle);
        const Vector6d step = Eigen::PartialPivLU<Matrix6d>(matrix).solve(missing);
        change += step;
        is_solved = step.dot(inertia * step) <= solved * solved * energy;
    }
    if (!is_solved) change.setZero();
    // The half rotation of mid-step: the momentum, which it rotates back in body axes, is then constant in
    // the world.
    const Vector6d middle = start + change;
    const Vector3d half_rotation = 0.5 * time * middle.head<3>();
    PlacedMotion end;
    end.place.orientation =
        (begin.place.orientation * Quaterniond(1.0, half_rotation.x(), half_rotation.y(), half_rotation.z()))
            .normalized();
    const Matrix3d end_to_world = end.place.orientation.toRotationMatrix();
    const Vector6d own = start + 2.0 * change;
    end.velocity << end_to_world * own.head<3>(), end_to_world * own.tail<3>();
    end.place.position =
        begin.place.position + 0.5 * time * (begin.velocity.tail<3>() + end.velocity.tail<3>());
    return end;
}

}  // namespace samara
