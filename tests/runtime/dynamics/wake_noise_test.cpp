// The slip by which a body's own wake makes its loads fluctuate.
#include "internal/kernel/wake_noise.hpp"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "internal/dynamics/langevin.hpp"
#include "internal/dynamics/step.hpp"
#include "support/hard_bodies.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

const Surroundings weightless{.gravity = Vector3d::Zero()};

ImmersedBody ellipsoid_with_a_wake(double density) {
    ImmersedBody body =
        test::immersed(test::baked_ellipsoid({0.01, 0.02, 0.04}), density, test::water(), Loads::table);
    body.turbulence = Turbulence::table;
    body.langevin = Langevin::wake;
    prepare(body);
    return body;
}

BodyState moving_at(const Vector3d& velocity) {
    BodyState state;
    state.velocity.tail<3>() = velocity;
    return state;
}

/// What the wake of a body too heavy to be moved does at its velocity, over many steps.
struct WakeStatistics {
    Matrix3d slip = Matrix3d::Zero();  // mean of its square
    double kept = 0.0;                 // correlation from step to step
};
WakeStatistics statistics_of(const ImmersedBody& body, const Vector3d& velocity, double h) {
    constexpr std::uint64_t settling = 200;
    constexpr std::uint64_t steps = 400'000;
    const Noise noise(11, "wake", 0, 0);
    BodyState state = moving_at(velocity);
    WakeStatistics found;
    double product = 0.0;
    for (std::uint64_t step = 0; step < settling + steps; ++step) {
        const Vector3d before = state.seen_fluid.velocity;
        state = advance(body, weightless, 0.0, h, state, noise, step).state;
        state.velocity = moving_at(velocity).velocity;
        state.orientation = Quaterniond::Identity();
        EXPECT_EQ(state.seen_fluid.angular_velocity, Vector3d::Zero());
        if (step < settling) continue;
        const Vector3d& slip = state.seen_fluid.velocity;
        product += slip.dot(before);
        found.slip += slip * slip.transpose() / double{steps};
    }
    found.kept = product / double{steps} / found.slip.trace();
    return found;
}

TEST(WakeNoise, HasItsVariancesAcrossAndAlongThePathAndItsTimeWhateverTheStep) {
    const ImmersedBody body = ellipsoid_with_a_wake(1e9);
    for (const double speed : {0.22, 0.44}) {
        const Vector3d velocity = speed * Vector3d(2.0, 0.0, 1.0).normalized();
        const double energy = turbulence_level(body, velocity).turbulent_kinetic_energy;
        const double time = wake_persistence * body.length / speed;
        const Vector3d path = velocity.normalized();
        const Matrix3d along = path * path.transpose();
        const Matrix3d expected = wake_along * wake_along * 2.0 / 3.0 * energy * along +
                                  std::pow(wake_across * speed, 2) * (Matrix3d::Identity() - along);
        for (const double step_by_time : {0.2, 2.0}) {
            const WakeStatistics found = statistics_of(body, velocity, step_by_time * time);
            EXPECT_LT((found.slip - expected).cwiseAbs().maxCoeff(), 0.02 * expected.trace());
            EXPECT_NEAR(found.kept, std::exp(-step_by_time), 0.01);
        }
    }
}

TEST(WakeNoise, PushesByTheLoadsAtTheSlipAndNotByItsChange) {
    const ImmersedBody body = ellipsoid_with_a_wake(1200.0);
    const Noise noise(12, "wake", 0, 0);
    const double h = 0.01;
    BodyState state = moving_at({0.2, 0.0, 0.1});
    for (std::uint64_t step = 0; step < 20; ++step) {
        const BodyState after = advance(body, weightless, 0.0, h, state, noise, step).state;
        // The same step in the stream that stands between the two slips.
        BodyState frozen = state;
        frozen.seen_fluid = after.seen_fluid;
        frozen.seen_fluid.velocity = 0.5 * (state.seen_fluid.velocity + after.seen_fluid.velocity);
        EXPECT_EQ(implicit_step(body, Vector3d::Zero(), h, frozen).velocity, after.velocity);
        EXPECT_GT(
            (implicit_step(body, Vector3d::Zero(), h, state, after.seen_fluid).velocity - after.velocity)
                .norm(),
            1e-4);
        state = after;
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
    EXPECT_GT((flown(Langevin::seen_fluid) - velocity).norm(), 1e-3);
}

TEST(WakeNoise, IsNoneAroundABodyAtRest) {
    const ImmersedBody body = ellipsoid_with_a_wake(1200.0);
    BodyState state;
    state.seen_fluid.velocity = Vector3d(0.1, 0.0, 0.0);
    state = advance(body, weightless, 0.0, 0.01, state, Noise(14, "wake", 0, 0), 0).state;
    EXPECT_EQ(state.seen_fluid.velocity, Vector3d::Zero());
    EXPECT_EQ(state.seen_fluid.angular_velocity, Vector3d::Zero());
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
        EXPECT_EQ(state.seen_fluid.velocity, Vector3d::Zero());
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
    EXPECT_EQ(flown(Langevin::wake), flown(Langevin::seen_fluid));
}

}  // namespace
}  // namespace samara
