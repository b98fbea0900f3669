// Bodies that nothing loads.
#include "samara/core/collision/free_flight.hpp"

#include <gtest/gtest.h>

namespace samara {
namespace {

const PlacedMotion tumbling = {
    {{0.1, -0.2, 0.3}, Quaterniond(0.8, 0.1, -0.5, 0.3).normalized()},
    (Vector6d() << 3.0, -5.0, 2.0, 0.4, 1.0, -0.7).finished(),
};

Vector6d own(const PlacedMotion& motion) {
    Vector6d result;
    result << motion.place.orientation.conjugate() * motion.velocity.head<3>(),
        motion.place.orientation.conjugate() * motion.velocity.tail<3>();
    return result;
}

/// (angular momentum about the origin, momentum) in world axes.
Vector6d momentum(const Matrix6d& inertia, const PlacedMotion& motion) {
    const Vector6d of_body = inertia * own(motion);
    Vector6d result;
    result.tail<3>() = motion.place.orientation * of_body.tail<3>();
    result.head<3>() =
        motion.place.orientation * of_body.head<3>() + motion.place.position.cross(result.tail<3>());
    return result;
}

double energy(const Matrix6d& inertia, const PlacedMotion& motion) {
    return 0.5 * own(motion).dot(inertia * own(motion));
}

Matrix6d without_fluid() {
    Matrix6d inertia = Matrix6d::Zero();
    inertia.diagonal() << 2e-6, 5e-6, 6e-6, 0.01, 0.01, 0.01;
    return inertia;
}

/// A disc's: its added mass is that along its axis, and its middle lies beside its centre of mass.
Matrix6d with_fluid() {
    Matrix6d inertia = without_fluid();
    inertia(5, 5) += 0.03;
    inertia(0, 5) = inertia(5, 0) = 4e-5;
    return inertia;
}

TEST(FreeFlight, KeepsMomentumAngularMomentumAndEnergyWithoutFluid) {
    PlacedMotion motion = tumbling;
    for (int i = 0; i < 100; ++i) motion = free_flight(without_fluid(), motion, 0.05);
    const Vector6d before = momentum(without_fluid(), tumbling);
    EXPECT_LT((momentum(without_fluid(), motion) - before).norm(), 1e-12 * before.norm());
    EXPECT_NEAR(energy(without_fluid(), motion), energy(without_fluid(), tumbling), 1e-14);
    EXPECT_GT((own(motion) - own(tumbling)).norm(), 1.0);
}

TEST(FreeFlight, KeepsMomentumAndEnergyWithTheFluidThatABodyCarries) {
    PlacedMotion motion = tumbling;
    for (int i = 0; i < 100; ++i) motion = free_flight(with_fluid(), motion, 0.01);
    const Vector3d before = momentum(with_fluid(), tumbling).tail<3>();
    EXPECT_LT((momentum(with_fluid(), motion).tail<3>() - before).norm(), 1e-12 * before.norm());
    EXPECT_NEAR(energy(with_fluid(), motion), energy(with_fluid(), tumbling), 1e-13);
}

TEST(FreeFlight, IsOfSecondOrderInTheStep) {
    const auto after = [](int steps) {
        PlacedMotion motion = tumbling;
        for (int i = 0; i < steps; ++i) motion = free_flight(with_fluid(), motion, 0.02 / steps);
        return motion;
    };
    const Vector6d exact = after(4096).velocity;
    const double coarse = (after(32).velocity - exact).norm();
    const double fine = (after(64).velocity - exact).norm();
    EXPECT_GT(coarse, 1e-4);
    EXPECT_NEAR(coarse / fine, 4.0, 0.2);
}

TEST(FreeFlight, KeepsTheEnergyOfOneThatTurnsTooFarForItsStep) {
    PlacedMotion motion = tumbling;
    motion.velocity.head<3>() *= 1000.0;
    const PlacedMotion end = free_flight(with_fluid(), motion, 1.0);
    EXPECT_NEAR(energy(with_fluid(), end) / energy(with_fluid(), motion), 1.0, 1e-12);
}

}  // namespace
}  // namespace samara
