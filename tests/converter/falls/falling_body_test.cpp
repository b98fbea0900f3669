#include "converter/falls/falling_body.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/expect_error.hpp"
#include "support/known_bodies.hpp"
#include "synthetic_fall.hpp"

namespace samara {
namespace {

TEST(FallingBody, HasTheMassTheInertiaAndTheFluidOfTheFall) {
    const Body body = test::ellipsoid_with_tables();
    const FreeFall fall = test::oblique_fall(test::ellipsoid_with_tables(), 1.0);
    const ImmersedBody flying = falling_body(body, fall);
    EXPECT_NEAR(flying.mass, 1200.0 * body.moments.volume, 1e-12);
    EXPECT_LT((flying.own_inertia - uniform_inertia(body.moments, 1200.0)).norm(),
              1e-9 * flying.own_inertia.norm());
    EXPECT_EQ(flying.fluid_density, 1000.0);
    EXPECT_NEAR(flying.viscosity, 1e-3, 1e-15);
    // The centre of mass is at (0.01, -0.005, 0.008) L from the centroid in case axes, which are the body's
    // y, z, x.
    const Vector3d offset = fall.length * Vector3d(0.008, 0.01, -0.005);
    EXPECT_LT((flying.center_of_buoyancy + offset).norm(), 1e-12);
    EXPECT_EQ(flying.loads, Loads::table);
    EXPECT_EQ(flying.turbulence, Turbulence::none);
}

TEST(FallingBody, RefusesAFallOfABodyOfAnotherSize) {
    FreeFall fall = test::oblique_fall(test::ellipsoid_with_tables(), 1.0);
    fall.length *= 1.0 + 1e-5;
    EXPECT_THAT(test::error_of([&] { static_cast<void>(falling_body(test::ellipsoid_with_tables(), fall)); }),
                testing::StartsWith("fall_00: the fall is of another body than exact: its length L is "));
}

TEST(FallingBody, FallsInSIUnitsAndTheBodysAxesAtTheStart) {
    const FreeFall fall = test::oblique_fall(test::ellipsoid_with_tables(), 1.0);
    const Vector3d gravity = gravity_of(fall);
    EXPECT_NEAR(gravity.norm(), 9.81, 1e-9);
    EXPECT_LT((gravity.normalized() - Vector3d(-0.64, 0.5, 0.58).normalized()).norm(), 1e-12);
}

TEST(FallingBody, HasTheStatesOfItsRecordAfterThatOfTheStart) {
    FallRecord record;
    record.fall = test::oblique_fall(test::ellipsoid_with_tables(), 1.0);
    record.fall.velocity = {0.1, -0.2, 0.3};
    record.fall.angular_velocity = {0.5, 0.7, -0.2};
    std::vector<BodyState> expected;
    for (int i = 1; i <= 5; ++i) {
        BodyState state = test::tumbling_state(0.1 * i, 2.0 - i);
        state.position = Vector3d(0.01 * i, 0.3, -0.02 * i * i);
        state.orientation = Quaterniond(1.0, 0.3 * i, -0.1, 0.2).normalized();
        expected.push_back(state);
        record.samples.push_back(test::sample_of(record.fall, 0.1 * i, state));
    }
    const std::vector<BodyState> states = states_of(record);
    ASSERT_EQ(states.size(), 6u);
    EXPECT_LT(states[0].position.norm(), 1e-15);
    EXPECT_NEAR(states[0].orientation.angularDistance(Quaterniond::Identity()), 0.0, 1e-7);
    // The case's axes are the body's y, z and x.
    EXPECT_LT((states[0].velocity.tail<3>() / record.fall.speed - Vector3d(0.3, 0.1, -0.2)).norm(), 1e-12);
    EXPECT_LT((states[0].velocity.head<3>() * record.fall.time_unit() - Vector3d(-0.2, 0.5, 0.7)).norm(),
              1e-12);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_LT((states[i + 1].position - expected[i].position).norm(), 1e-14);
        EXPECT_LT(states[i + 1].orientation.angularDistance(expected[i].orientation), 1e-7);
        EXPECT_LT((states[i + 1].velocity - expected[i].velocity).norm(), 1e-12);
    }
}

TEST(FallingBody, MakesAMotionOfItsStatesAtEvenTimes) {
    const Body body = test::ellipsoid_with_tables();
    std::vector<BodyState> states(3);
    states[2].position = Vector3d(1, 2, 3);
    const Motion motion = motion_of(body, Vector3d(0, 0, -9.81), 0.25, states);
    EXPECT_EQ(motion.frame_rate, 4.0);
    EXPECT_EQ(motion.times, (std::vector<double>{0.0, 0.25, 0.5}));
    ASSERT_EQ(motion.bodies.size(), 1u);
    ASSERT_EQ(motion.bodies[0].poses.size(), 3u);
    EXPECT_NEAR(std::abs(motion.bodies[0].shortest_axis.x()), 1.0, 1e-12);
}

}  // namespace
}  // namespace samara
