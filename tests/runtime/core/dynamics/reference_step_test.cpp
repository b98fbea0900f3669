
#include "support/reference_step.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "support/compared_states.hpp"
#include "support/hard_bodies.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

/// How far (m) the motions of a body that reaches 5 cm are apart, with the difference of all velocities over
/// 0.1 s.
double distance(const BodyState& a, const BodyState& b) {
    return (a.position - b.position).norm() + 0.05 * a.orientation.angularDistance(b.orientation) +
           0.1 * (a.velocity - b.velocity).norm();
}

const Vector3d gravity(0.0, 0.0, -9.81);

BodyState flown(const ImmersedBody& body, BodyState state, double time, int steps) {
    for (int i = 0; i < steps; ++i) {
        const ReferenceResult result = reference_step(body, gravity, time / steps, state);
        EXPECT_TRUE(result.converged);
        state = result.state;
    }
    return state;
}

BodyState seeing_fluid(BodyState state) {
    state.sampled_turbulence = {Vector3d(0.05, -0.02, 0.03), Vector3d(0.5, 0.2, -0.1)};
    return state;
}

TEST(ReferenceStep, IsOfFourthOrderWithSmoothLoadsOffsetMassAndSeenFluid) {
    const ImmersedBody body = test::smooth_ellipsoid();
    const BodyState start = seeing_fluid(test::tumbling_state(0.3, 8.0));
    const double time = 0.5;
    const BodyState exact = flown(body, start, time, 2048);
    double before = distance(flown(body, start, time, 32), exact);
    for (const int steps : {64, 128}) {
        const double error = distance(flown(body, start, time, steps), exact);
        EXPECT_NEAR(std::log2(before / error), 4.0, 0.1) << steps << " steps";
        before = error;
    }
}

TEST(ReferenceStep, IsOfFourthOrderWithinOneCellOfATable) {
    const ImmersedBody body = test::lopsided_body(Vector3d(0.002, 0.001, -0.004));
    const BodyState start = seeing_fluid(test::tumbling_state(0.2, 5.0));
    const double time = 0.02;
    const BodyState exact = flown(body, start, time, 128);
    double before = distance(flown(body, start, time, 2), exact);
    for (const int steps : {4, 8, 16}) {
        const double error = distance(flown(body, start, time, steps), exact);
        EXPECT_NEAR(std::log2(before / error), 4.0, 0.1) << steps << " steps";
        before = error;
    }
}

TEST(ReferenceStep, IsOfSecondOrderAtLeastAcrossTheKinksOfATable) {
    // Half a second leads through many cells. The error of one number of steps scatters with where the kinks
    // lie in them; the mean over several, and over a range of 32, has the order of the kinks.
    const ImmersedBody body = test::blunt_ellipsoid(Vector3d(0.002, 0.001, -0.004));
    const BodyState start = seeing_fluid(test::tumbling_state(0.2, 5.0));
    const BodyState exact = flown(body, start, 0.5, 8192);
    double order = 0.0;
    const std::vector<int> numbers = {14, 15, 16, 17, 18, 19, 20};
    for (const int steps : numbers) {
        const double coarse = distance(flown(body, start, 0.5, steps), exact);
        const double fine = distance(flown(body, start, 0.5, 32 * steps), exact);
        order += std::log2(coarse / fine) / 5.0 / static_cast<double>(numbers.size());
    }
    EXPECT_GT(order, 2.0);
}

TEST(ReferenceStep, AgreesWithTheImplicitStepToItsSecondOrder) {
    const ImmersedBody body = test::smooth_ellipsoid();
    const BodyState start = seeing_fluid(test::tumbling_state(0.3, 8.0));
    const BodyState exact = flown(body, start, 0.5, 1024);
    double before = 0.0;
    for (const int steps : {200, 400, 800}) {
        BodyState state = start;
        for (int i = 0; i < steps; ++i) state = implicit_step(body, gravity, 0.5 / steps, state);
        const double error = distance(state, exact);
        if (before > 0.0) {
            EXPECT_GT(std::log2(before / error), 1.9) << steps << " steps";
        }
        before = error;
    }
    EXPECT_LT(before, 1e-4);
}

TEST(ReferenceStep, KeepsTheTotalEnergyUnderGravityToRounding) {
    const ImmersedBody body = test::immersed(test::rubber_ellipsoid(), 1200.0, test::water(), Loads::none,
                                             Vector3d(0.001, 0.002, -0.003));
    const auto energy = [&](const BodyState& state) {
        const Vector3d centroid = state.position + state.orientation * body.center_of_buoyancy;
        return kinetic_energy(body, state) - body.mass * gravity.dot(state.position) +
               body.fluid_density * body.volume * gravity.dot(centroid);
    };
    const BodyState start = test::tumbling_state(0.2, 3.0);
    BodyState state = start;
    for (int i = 0; i < 2000; ++i) {
        state = reference_step(body, gravity, 1e-3, state).state;
        ASSERT_NEAR(energy(state), energy(start), 1e-12 * kinetic_energy(body, state)) << "step " << i;
    }
    EXPECT_NEAR(state.orientation.norm(), 1.0, 1e-15);
}

TEST(ReferenceStep, KeepsTheMomentaOfFreeMotionInSpaceToFourthOrder) {
    const ImmersedBody body = test::ideal_ellipsoid();
    const BodyState start = test::tumbling_state(0.3, 6.0);
    const auto linear_momentum = [&](const BodyState& state) -> Vector3d {
        return state.orientation * (body.inertia * state.velocity).tail<3>();
    };
    double before = 0.0;
    for (const int steps : {50, 100, 200}) {
        BodyState state = start;
        for (int i = 0; i < steps; ++i) {
            state = reference_step(body, Vector3d::Zero(), 1.0 / steps, state).state;
        }
        const double error = (linear_momentum(state) - linear_momentum(start)).norm();
        if (before > 0.0) {
            EXPECT_NEAR(std::log2(before / error), 4.0, 0.2) << steps << " steps";
        }
        before = error;
    }
}

TEST(ReferenceStep, HalvesAStepThatItCannotSolveAndSaysSo) {
    const ImmersedBody body = test::ideal_ellipsoid();
    const BodyState start = test::tumbling_state(0.5, 1000.0);
    const ReferenceResult result = reference_step(body, Vector3d::Zero(), 0.1, start);
    EXPECT_TRUE(result.converged);
    EXPECT_GT(result.parts, 8);
    EXPECT_NEAR(kinetic_energy(body, result.state) / kinetic_energy(body, start), 1.0, 1e-12);
    EXPECT_EQ(reference_step(body, Vector3d::Zero(), 1e-3, test::tumbling_state(0.3, 6.0)).parts, 1);
}

TEST(ReferenceStep, SaysWhereEvenTheShortestPartWasNotSolved) {
    const ImmersedBody body = test::ideal_ellipsoid();
    const BodyState start = test::tumbling_state(1e5, 1e7);
    const ReferenceResult result = reference_step(body, Vector3d::Zero(), 1.0, start);
    EXPECT_FALSE(result.converged);
    EXPECT_EQ(result.parts, 1 << reference_halvings);
    EXPECT_LE(kinetic_energy(body, result.state), kinetic_energy(body, start) * (1.0 + 1e-9));
}

TEST(ReferenceStep, LeavesABodyAtRestWithoutWeightAtRest) {
    const ReferenceResult result =
        reference_step(test::blunt_ellipsoid(), Vector3d::Zero(), 0.1, BodyState{});
    EXPECT_TRUE(result.converged);
    EXPECT_EQ(result.state.velocity, Vector6d::Zero());
    EXPECT_EQ(result.state.position, Vector3d::Zero());
}

TEST(EquationsOfMotion, TheirGradientIsThatOfTheirAcceleration) {
    const ImmersedBody body = test::lopsided_body(Vector3d(0.002, 0.001, -0.004));
    const BodyState state = seeing_fluid(test::tumbling_state(0.2, 5.0));
    const EquationsOfMotion equations(body, gravity, state.sampled_turbulence);
    const MotionVector motion = motion_vector(state);
    const Matrix6d gradient = equations.acceleration_gradient(motion);
    for (int i = 0; i < 6; ++i) {
        const double difference = i < 3 ? 1e-4 : 1e-6;
        MotionVector above = motion;
        MotionVector below = motion;
        above[i] += difference;
        below[i] -= difference;
        const Vector6d expected =
            (equations.rate(above) - equations.rate(below)).head<6>() / (2.0 * difference);
        EXPECT_LT((gradient.col(i) - expected).norm(), 1e-4 * expected.norm()) << "column " << i;
    }
}

TEST(EquationsOfMotion, TheStateComesBackFromItsVector) {
    const BodyState state = seeing_fluid(test::tumbling_state(0.2, 5.0));
    const BodyState back = body_state(motion_vector(state), state.sampled_turbulence);
    EXPECT_EQ(back.velocity, state.velocity);
    EXPECT_EQ(back.position, state.position);
    EXPECT_LT((back.orientation.coeffs() - state.orientation.coeffs()).norm(), 1e-15);
}

}  // namespace
}  // namespace samara
