// The velocity fluctuation by which a body's own wake makes its loads fluctuate.
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "samara/core/dynamics/loads.hpp"
#include "samara/core/integrator/step.hpp"
#include "samara/core/kernel/kernel.hpp"
#include "samara/core/kernel/step_constants.hpp"
#include "support/hard_bodies.hpp"
#include "support/reference_step.hpp"

namespace samara {
namespace {

const Surroundings weightless{.gravity = Vector3d::Zero()};

ImmersedBody ellipsoid_with_a_wake(double density, TurbulenceMean mean = TurbulenceMean::near_wake) {
    Body ellipsoid = test::baked_ellipsoid({0.01, 0.02, 0.04});
    ellipsoid.tables->turbulence_mean = mean;
    ImmersedBody body = test::immersed(ellipsoid, density, test::water(), Loads::table);
    body.turbulence = Turbulence::table;
    body.langevin = Langevin::wake;
    prepare(body);
    return body;
}

BodyState moving_at(const Vector3d& velocity, const Vector3d& angular_velocity = Vector3d::Zero()) {
    BodyState state;
    state.velocity << angular_velocity, velocity;
    return state;
}

/// What the wake of a body too heavy to be moved does at its velocities, over many steps.
struct WakeStatistics {
    Matrix3d wake_fluctuation = Matrix3d::Zero();  // mean of its square
    double kept = 0.0;                             // correlation from step to step
};
WakeStatistics statistics_of(const ImmersedBody& body, const BodyState& moving, double h) {
    constexpr std::uint64_t settling = 200;
    constexpr std::uint64_t steps = 400'000;
    const Noise noise(11, "wake", 0, 0);
    BodyState state = moving;
    WakeStatistics found;
    double product = 0.0;
    for (std::uint64_t step = 0; step < settling + steps; ++step) {
        const Vector3d before = state.sampled_turbulence.velocity;
        state = advance(body, weightless, 0.0, h, state, noise, step).state;
        state.velocity = moving.velocity;
        state.orientation = Quaterniond::Identity();
        EXPECT_EQ(state.sampled_turbulence.angular_velocity, Vector3d::Zero());
        if (step < settling) continue;
        const Vector3d& wake_fluctuation = state.sampled_turbulence.velocity;
        product += wake_fluctuation.dot(before);
        found.wake_fluctuation += wake_fluctuation * wake_fluctuation.transpose() / double{steps};
    }
    found.kept = product / double{steps} / found.wake_fluctuation.trace();
    return found;
}

TEST(WakeNoise, HasItsVarianceAndItsTimeWhateverTheStepAndTheMeanOfK) {
    for (const auto& [mean, speed] : {std::pair{TurbulenceMean::near_wake, 0.22},
                                      {TurbulenceMean::near_wake, 0.44},
                                      {TurbulenceMean::shell, 0.22}}) {
        const ImmersedBody body = ellipsoid_with_a_wake(1e9, mean);
        const Vector3d velocity = speed * Vector3d(2.0, 0.0, 1.0).normalized();
        const double energy = turbulence_level(body, velocity).turbulent_kinetic_energy;
        const double time = 1.0 / wake_renewal_rate(body, velocity);
        const double share = body.constants.wake_noise.share;
        const Matrix3d expected = share * share * 2.0 / 3.0 * energy * Matrix3d::Identity();
        for (const double step_by_time : {0.2, 2.0}) {
            const WakeStatistics found = statistics_of(body, moving_at(velocity), step_by_time * time);
            EXPECT_LT((found.wake_fluctuation - expected).cwiseAbs().maxCoeff(), 0.02 * expected.trace());
            EXPECT_NEAR(found.kept, std::exp(-step_by_time), 0.01);
        }
    }
}

TEST(WakeNoise, IsTheWeakerTheMoreTheBodyTurnsOnItsWay) {
    const ImmersedBody body = ellipsoid_with_a_wake(1e9);
    const Vector3d velocity(0.4, 0.0, 0.2);
    const double time = 1.0 / wake_renewal_rate(body, velocity);
    const double straight = statistics_of(body, moving_at(velocity), time).wake_fluctuation.trace();
    const double rate = velocity.norm() / body.length;  // lengths gone in a second
    for (const double turns : {0.1, 0.25, 1.0}) {
        const Vector3d turning = turns * rate * Vector3d(1.0, 2.0, -2.0) / 3.0;
        const WakeStatistics found = statistics_of(body, moving_at(velocity, turning), time);
        const double share = 1.0 / (1.0 + wake_order * wake_order * turns * turns);
        EXPECT_NEAR(std::sqrt(found.wake_fluctuation.trace() / straight), share, 0.02 * share);
        EXPECT_NEAR(found.kept, std::exp(-1.0), 0.01);
    }
}

TEST(WakeNoise, PushesByTheLoadsAtTheSlipAndNotByItsChange) {
    ImmersedBody body = ellipsoid_with_a_wake(1200.0);
    body.projected_area_tensor.setZero();
    prepare(body);
    const Noise noise(12, "wake", 0, 0);
    const double h = 0.01;
    BodyState state = moving_at({0.2, 0.0, 0.1});
    state.wake = {1.0, Vector3d(0.2, 0.0, 0.1).normalized()};
    for (std::uint64_t step = 0; step < 20; ++step) {
        const BodyState after = advance(body, weightless, 0.0, h, state, noise, step).state;
        // The same step in the stream of the mean of the two fluctuations.
        BodyState frozen = state;
        frozen.sampled_turbulence = after.sampled_turbulence;
        frozen.sampled_turbulence.velocity =
            0.5 * (state.sampled_turbulence.velocity + after.sampled_turbulence.velocity);
        EXPECT_EQ(implicit_step(body, Vector3d::Zero(), h, frozen).velocity, after.velocity);
        EXPECT_GT((implicit_step(body, Vector3d::Zero(), h, state, after.sampled_turbulence).velocity -
                   after.velocity)
                      .norm(),
                  1e-5);
        state = after;
    }
}

/// One step in the frozen fluctuation of a wake (m/s, world axes).
BodyState stepped(const ImmersedBody& body, const Vector3d& wake_fluctuation, double h,
                  const BodyState& state) {
    BodyState after = state;
    const kernel::SampledStream stream{wake_fluctuation, wake_fluctuation, Vector3d::Zero(), true, true,
                                       wake_fluctuation};
    kernel::implicit_step(body.constants, Vector3d::Zero(), h, stream, 0, 1, nullptr, after);
    return after;
}

TEST(WakeNoise, PressesOnTheSidesAcrossThePath) {
    ImmersedBody body = ellipsoid_with_a_wake(1e6);
    const Vector3d path = Vector3d(2.0, 1.0, 1.0).normalized();
    const Vector3d wake_fluctuation(0.004, -0.003, 0.005);
    BodyState state = moving_at(0.22 * path);
    state.orientation = Quaterniond(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));
    const double h = 1e-3;
    const Vector3d with = stepped(body, wake_fluctuation, h, state).velocity.tail<3>();
    const Vector3d seen = state.orientation.conjugate() * wake_fluctuation;
    const Vector3d relative = 0.22 * path - seen;
    const Vector3d pressed = body.constants.wake_noise.side_pressure * 0.5 * body.fluid_density *
                             relative.norm() * (body.projected_area_tensor * seen);
    const Vector3d across = pressed - pressed.dot(relative) / relative.squaredNorm() * relative;
    body.projected_area_tensor.setZero();
    prepare(body);
    const Vector3d without = stepped(body, wake_fluctuation, h, state).velocity.tail<3>();
    EXPECT_LT(((with - without) * body.mass / h - across).norm(), 1e-3 * across.norm());
}

TEST(WakeNoise, HasTheShadowsAlongThePrincipalAxes) {
    const ImmersedBody body = ellipsoid_with_a_wake(1200.0);
    const Vector3d exact = std::numbers::pi * Vector3d(8e-4, 4e-4, 2e-4);
    EXPECT_LT((body.projected_area_tensor.diagonal() - exact).cwiseAbs().maxCoeff(),
              0.03 * exact.x());  // flat triangles
    EXPECT_LT(
        (body.projected_area_tensor - Matrix3d(body.projected_area_tensor.diagonal().asDiagonal())).norm(),
        1e-6 * exact.x());
}

// In the frame of the fluctuation no load but drag changes the energy of body and fluid.
TEST(WakeNoise, MakesNoEnergyInTheFrameOfItsSlip) {
    for (const double h : {0.002, 0.05}) {
        const ImmersedBody body = ellipsoid_with_a_wake(1200.0);
        const Vector3d wake_fluctuation(0.1, -0.2, 0.15);  // far beyond what k makes
        BodyState state = moving_at({0.2, 0.1, -0.1});
        state.velocity.head<3>() = Vector3d(1.0, -2.0, 0.5);
        const auto energy = [&](BodyState of) {
            of.velocity.tail<3>() -= of.orientation.conjugate() * wake_fluctuation;
            return kinetic_energy(body, of);
        };
        double before = energy(state);
        for (int step = 0; step < 200; ++step) {
            state = stepped(body, wake_fluctuation, h, state);
            EXPECT_LE(energy(state), before * (1.0 + 1e-12));
            before = energy(state);
        }
    }
}

TEST(WakeNoise, DoesNothingToABodyWithoutLoads) {
    // A stream that accelerates pushes by the displaced and the added mass; a wake pushes through loads
    // alone.
    ImmersedBody ball = test::immersed(test::baked_sphere(0.02), 1300.0, test::water(), Loads::none);
    ball.tables = *test::baked_sphere(0.02).tables;
    ball.turbulence = Turbulence::table;
    prepare(ball);
    const Vector3d velocity(0.3, 0.1, 0.0);
    const auto flown = [&](Langevin langevin) {
        ball.langevin = langevin;
        prepare(ball);
        BodyState state = moving_at(velocity);
        for (std::uint64_t step = 0; step < 100; ++step) {
            state = advance(ball, weightless, 0.0, 0.01, state, Noise(13, "wake", 0, 0), step).state;
        }
        return Vector3d(state.orientation * state.velocity.tail<3>());
    };
    EXPECT_LT((flown(Langevin::wake) - velocity).norm(), 1e-13);
    EXPECT_GT((flown(Langevin::sampled_turbulence) - velocity).norm(), 1e-3);
}

TEST(WakeNoise, IsNoneAroundABodyAtRest) {
    const ImmersedBody body = ellipsoid_with_a_wake(1200.0);
    BodyState state;
    state.sampled_turbulence.velocity = Vector3d(0.1, 0.0, 0.0);
    state = advance(body, weightless, 0.0, 0.01, state, Noise(14, "wake", 0, 0), 0).state;
    EXPECT_EQ(state.sampled_turbulence.velocity, Vector3d::Zero());
    EXPECT_EQ(state.sampled_turbulence.angular_velocity, Vector3d::Zero());
}

TEST(WakeNoise, IsNoneInLaminarFlow) {
    ImmersedBody body = ellipsoid_with_a_wake(1200.0);
    for (LoadEntry& entry : body.tables->entries) {
        entry.turbulent_kinetic_energy = 0.0;
        entry.dissipation_rate = 0.0;
    }
    prepare(body);
    BodyState state = moving_at({0.2, 0.0, 0.1});
    for (std::uint64_t step = 0; step < 20; ++step) {
        state = advance(body, weightless, 0.0, 0.01, state, Noise(16, "wake", 0, 0), step).state;
        EXPECT_EQ(state.sampled_turbulence.velocity, Vector3d::Zero());
    }
}

TEST(WakeNoise, OfTheFluidAroundIsItsStream) {
    // Constant turbulence is no wake's.
    ImmersedBody body = ellipsoid_with_a_wake(1200.0);
    body.turbulence = Turbulence::constant;
    body.turbulent_kinetic_energy = 0.01;
    body.dissipation_rate = 0.02;
    const auto flown = [&](Langevin langevin) {
        body.langevin = langevin;
        prepare(body);
        BodyState state = moving_at({0.2, 0.0, 0.1});
        for (std::uint64_t step = 0; step < 20; ++step) {
            state = advance(body, weightless, 0.0, 0.01, state, Noise(15, "wake", 0, 0), step).state;
        }
        return state.velocity;
    };
    EXPECT_EQ(flown(Langevin::wake), flown(Langevin::sampled_turbulence));
}

}  // namespace
}  // namespace samara
