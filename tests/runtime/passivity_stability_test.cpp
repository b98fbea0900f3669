// Bodies in still fluid without gravity never gain energy, whatever the step; hard starts give no NaN.

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "samara/dynamics/loads.hpp"
#include "samara/dynamics/step.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

TEST(Passivity, RandomStatesNeverGainEnergyAtAnyStep) {
    std::mt19937 generator(11);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const Body shape = test::rubber_ellipsoid();
    Body baked = shape;
    baked.tables = test::blunt_tables(shape, 3);
    for (int i = 0; i < 3000; ++i) {
        SceneBody given = test::scene_body(0.0);
        const double density = 998.2 * std::pow(10.0, 6.0 * uniform(generator) - 3.0);
        const Vector3d offset = 0.004 * Vector3d(uniform(generator), uniform(generator), uniform(generator));
        given.mass = {
            .density = {}, .mass = density * shape.moments.volume, .center_of_mass = offset, .inertia = {}};
        const ImmersedBody body = make_immersed_body(baked, given, Fluid{});
        BodyState state = test::tumbling_state(std::pow(10.0, 6.0 * uniform(generator) - 4.0),
                                               std::pow(10.0, 6.0 * uniform(generator) - 3.0));
        const double h = std::pow(10.0, 7.0 * uniform(generator) - 6.0);
        double energy = kinetic_energy(body, state);
        for (int step = 0; step < 5; ++step) {
            state = implicit_step(body, Vector3d::Zero(), h, state);
            const double next = kinetic_energy(body, state);
            ASSERT_TRUE(std::isfinite(next)) << "body " << i << ", step of " << h << " s";
            ASSERT_LE(next, energy * (1.0 + 1e-10)) << "body " << i << ", step of " << h << " s";
            energy = next;
        }
    }
}

TEST(HardCases, ABubbleAtAFilmFramesStepReachesItsTerminalSpeed) {
    Body bubble = test::exact_sphere(0.0005);
    bubble.tables = test::blunt_tables(bubble, 2);
    for (LoadEntry& entry : bubble.tables->entries) entry.moment.setZero();
    const ImmersedBody body = make_immersed_body(bubble, test::scene_body(1.2), Fluid{});
    BodyState coarse;
    for (int i = 0; i < 240; ++i) coarse = implicit_step(body, Vector3d(0, 0, -9.81), 1.0 / 24.0, coarse);
    BodyState fine;
    for (int i = 0; i < 20'000; ++i) fine = implicit_step(body, Vector3d(0, 0, -9.81), 1e-4, fine);
    EXPECT_GT(fine.velocity[5], 0.0);
    EXPECT_NEAR(coarse.velocity[5] / fine.velocity[5], 1.0, 1e-6);
}

TEST(HardCases, ASpinOfAThousandAtAFilmFramesStepDies) {
    const ImmersedBody body = test::blunt_ellipsoid(Vector3d(0.001, 0.0, 0.002));
    BodyState state = test::tumbling_state(0.1, 1000.0);
    const Noise noise(1, "body", 0, 0);
    const double start = state.velocity.head<3>().norm();
    for (std::uint64_t i = 0; i < 240; ++i) {
        state = advance(body, Surroundings{}, 0.0, 1.0 / 24.0, state, noise, i).state;
        ASSERT_TRUE(state.velocity.allFinite());
    }
    EXPECT_LT(state.velocity.head<3>().norm(), 0.05 * start);
}

TEST(HardCases, AStartAtAHundredTimesTheTerminalSpeedSlowsDown) {
    const ImmersedBody body = test::blunt_ellipsoid();
    BodyState state = test::tumbling_state(20.0, 0.0);
    const Noise noise(1, "body", 0, 0);
    for (std::uint64_t i = 0; i < 240; ++i) {
        state = advance(body, Surroundings{}, 0.0, 1.0 / 24.0, state, noise, i).state;
        ASSERT_TRUE(state.velocity.allFinite());
    }
    EXPECT_LT(state.velocity.tail<3>().norm(), 1.0);
}

}  // namespace
}  // namespace samara
