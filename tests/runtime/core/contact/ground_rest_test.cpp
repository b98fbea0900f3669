// Bodies that come to rest on the ground, stay there, and wake.

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "paths.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/integrator/batch.hpp"
#include "samara/scene/scene_file.hpp"
#include "samara/scene/scene_simulation.hpp"
#include "support/compared_states.hpp"
#include "support/ground_bodies.hpp"
#include "support/reference_step.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

const Fluid water = *fluid_preset("water");
const Fluid air = *fluid_preset("air");

Surroundings ground_at_zero() {
    Surroundings surroundings;
    surroundings.ground = 0.0;
    return surroundings;
}

Quaterniond turned(double angle, const Vector3d& axis) {
    return Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
}

const ImmersedBody& block() {
    static const ImmersedBody body = test::uniform_body(test::box({0.03, 0.02, 0.01}, 2), 1500.0, water);
    return body;
}

Body ready_body(const std::string& name) {
    return read_body_file(SAMARA_SOURCE_DIRECTORY "/runtime/bodies/" + name + ".body.h5");
}

/// A curled leaf, 6 cm long, in air.
const ImmersedBody& leaf() {
    static const ImmersedBody body = [] {
        SceneBody given;
        given.name = "leaf";
        given.mass.density = 600.0;
        given.loads = Loads::coefficients;
        given.coefficients.drag_coefficient = 1.2;
        given.turbulence = Turbulence::none;
        return make_immersed_body(ready_body("leaf"), given, air);
    }();
    return body;
}

/// The energy of body and fluid over the ground (J).
double energy(const ImmersedBody& body, const BodyState& state) {
    const double weight = 9.81 * (body.mass - body.fluid_density * body.volume);
    return kinetic_energy(body, state) + weight * state.position.z();
}

struct Settled {
    BodyState state;
    double time = 0.0;  ///< s: when it came to rest; negative: it did not
    double gain = 0.0;  ///< J: the highest rise of the energy over what it was before
};

Settled settled(const ImmersedBody& body, const BodyState& start, double duration, double step,
                const Surroundings& surroundings = ground_at_zero()) {
    Settled result{.state = start, .time = -1.0};
    const Noise noise(1, "body", 0, 0);
    double lowest = energy(body, start);
    const auto steps = static_cast<std::uint64_t>(std::lround(duration / step));
    for (std::uint64_t i = 0; i < steps; ++i) {
        result.state = advance(body, surroundings, 0.0, step, result.state, noise, i).state;
        result.gain = std::max(result.gain, energy(body, result.state) - lowest);
        lowest = std::min(lowest, energy(body, result.state));
        if (!result.state.at_rest) result.time = -1.0;
        if (result.state.at_rest && result.time < 0.0) result.time = static_cast<double>(i + 1) * step;
    }
    return result;
}

void expect_same_bits(const BodyState& a, const BodyState& b) {
    EXPECT_EQ(test::numbers_of(a), test::numbers_of(b));
    EXPECT_EQ(a.at_rest, b.at_rest);
}

TEST(GroundRest, ABlockSetDownFlatRestsAtOnceAndStaysForAThousandSecondsToTheLastBit) {
    const BodyState start = test::above_ground(block(), turned(0.4, {0, 0, 1}), 0.0);
    const Noise noise(1, "body", 0, 0);
    const BodyState first = advance(block(), ground_at_zero(), 0.0, 0.002, start, noise, 0).state;
    EXPECT_TRUE(first.at_rest);
    EXPECT_EQ(first.velocity.norm(), 0.0);
    EXPECT_EQ(first.position, start.position);
    const BodyState end = test::flown(block(), ground_at_zero(), first, 1000.0, 0.002);
    expect_same_bits(end, first);
}

TEST(GroundRest, ABodyAtRestTakesNoImplicitSteps) {
    const BodyState start = test::above_ground(block(), Quaterniond::Identity(), 0.0);
    const Noise noise(1, "body", 0, 0);
    const BodyState first = advance(block(), ground_at_zero(), 0.0, 0.002, start, noise, 0).state;
    EXPECT_EQ(advance(block(), ground_at_zero(), 0.0, 0.002, first, noise, 1).substeps, 0);
    Batch batch(block(), 21);
    for (std::size_t i = 0; i < batch.size(); ++i) batch.set_state(i, start);
    EXPECT_EQ(batch.advance(ground_at_zero(), 0.0, 0.002, 0, 1).implicit_steps, batch.size());
    EXPECT_EQ(batch.advance(ground_at_zero(), 0.0, 0.002, 1, 1000).implicit_steps, 0U);
    // A body that floats over the others is stepped, and they are not.
    batch.set_state(3, test::above_ground(block(), Quaterniond::Identity(), 1.0));
    EXPECT_EQ(batch.advance(ground_at_zero(), 0.0, 0.002, 1001, 10).implicit_steps, 10U);
}

TEST(GroundRest, WhatAStepSkipsIsWhatItWouldFind) {
    // The mark of rest taken away before each step: all is judged anew, and comes out the same.
    for (const ImmersedBody* body : {&block(), &leaf()}) {
        BodyState state = test::above_ground(*body, Quaterniond::Identity(), 0.001);
        state = test::flown(*body, ground_at_zero(), state, 4.0, 0.002);
        ASSERT_TRUE(state.at_rest);
        BodyState judged = state;
        const Noise noise(1, "body", 0, 0);
        for (std::uint64_t i = 0; i < 100; ++i) {
            judged.at_rest = false;
            judged = advance(*body, ground_at_zero(), 0.0, 0.002, judged, noise, i).state;
        }
        expect_same_bits(judged, state);
    }
}

TEST(GroundRest, ALeafRockedByAThirdOfARadianRestsWithinTwoSeconds) {
    for (const double angle : {0.3, -0.3, std::numbers::pi - 0.3, std::numbers::pi + 0.3}) {
        for (const Vector3d& axis : {Vector3d(0, 1, 0), Vector3d(1, 0.3, 0)}) {
            const BodyState start = test::above_ground(leaf(), turned(angle, axis), 0.0);
            const Settled end = settled(leaf(), start, 3.0, 0.001);
            EXPECT_TRUE(end.state.at_rest);
            EXPECT_GT(end.time, 0.0);
            EXPECT_LT(end.time, 2.0) << angle << " about " << axis.transpose();
        }
    }
}

TEST(GroundRest, TheEnergyOverTheGroundDoesNotRise) {
    // Let go on the ground, so that no fall's energy hides what contact might add.
    const double weight = 9.81 * (leaf().mass - leaf().fluid_density * leaf().volume);
    const double scale = weight * leaf().contact_points.bounding_radius;
    for (const double step : {1e-3, 2.5e-4}) {
        const BodyState start = test::above_ground(leaf(), turned(0.3, {1, 2, 0}), 0.0);
        const Settled end = settled(leaf(), start, 2.0, step);
        EXPECT_LT(end.gain, 2.0 * step * scale) << step;
    }
}

TEST(GroundRest, AllLeavesOfTheSceneLieStillAtItsEnd) {
    const Scene scene = read_scene_file(SAMARA_SOURCE_DIRECTORY "/docs/scenes/leaves.toml");
    const SimulationResult result =
        simulate(scene, {{ready_body("leaf"), "leaf"}, {ready_body("samara"), "samara"}}, 1,
                 [](double, double) { return true; });
    const Motion& motion = result.motion;
    for (const BodyMotion& body : motion.bodies) {
        for (int copy = 0; copy < body.copies; ++copy) {
            const Pose& pose = motion.pose(body, 0, motion.frames() - 1, copy);
            EXPECT_EQ(pose.velocity.norm(), 0.0) << body.name << copy;
            EXPECT_EQ(pose.angular_velocity.norm(), 0.0) << body.name << copy;
        }
    }
}

TEST(GroundRest, ACoinThatRollsOrSpinsOnItsRimComesToLieFlat) {
    const ImmersedBody coin = test::uniform_body(test::disc(0.012, 0.002), 7000.0, air);
    for (const Vector3d& spin : {Vector3d(0, 0, 25), Vector3d(0, 8, 0), Vector3d(1, 5, 12)}) {
        BodyState state = test::above_ground(coin, turned(1.35, {1, 0, 0}), 0.0);
        const Quaterniond to_body = state.orientation.conjugate();
        state.velocity << to_body * spin, to_body * (0.012 * spin.cross(Vector3d::UnitZ()));
        const Settled end = settled(coin, state, 8.0, 0.001);
        EXPECT_TRUE(end.state.at_rest) << spin.transpose();
        EXPECT_NEAR(std::abs((end.state.orientation * Vector3d::UnitZ()).z()), 1.0, 1e-3);
    }
}

TEST(GroundRest, AStrongGustMovesABodyAndAWeakOneDoesNot) {
    for (const double amplitude : {0.05, 0.8}) {
        Surroundings surroundings = ground_at_zero();
        surroundings.gust = {.amplitude = Vector3d(amplitude, 0.0, 0.0), .period = 2.0};
        const BodyState start = test::above_ground(block(), Quaterniond::Identity(), 0.0);
        BodyState state = start;
        double farthest = 0.0;
        const Noise noise(1, "body", 0, 0);
        for (std::uint64_t i = 0; i < 1000; ++i) {
            state = advance(block(), surroundings, 0.0, 0.002, state, noise, i).state;
            const Vector3d place =
                state.position + flow_displacement(surroundings, 0.002 * static_cast<double>(i + 1));
            farthest = std::max(farthest, (place - start.position).norm());
        }
        if (amplitude < 0.1) {
            EXPECT_LT(farthest, 1e-12);
            EXPECT_TRUE(state.at_rest);
        } else {
            EXPECT_GT(farthest, 0.01);
        }
    }
}

TEST(GroundRest, InAWindABodyAtRestIsJudgedEveryTwentyMillisecondsAloneAndInABatch) {
    Surroundings surroundings = ground_at_zero();
    Wind wind;
    wind.gusts = WindGusts{.rms = 0.01, .length = 1.0};
    surroundings.wind = std::make_shared<const WindField>(wind, Vector3d::Zero());
    const BodyState start = test::above_ground(block(), Quaterniond::Identity(), 0.0);
    const Noise noise(1, "body", 0, 0);
    BodyState state = start;
    int steps_taken = 0;
    for (std::uint64_t i = 0; i < 101; ++i) {
        const StepResult result = advance(block(), surroundings, 0.0, 0.002, state, noise, i);
        steps_taken += result.substeps;
        state = result.state;
    }
    EXPECT_TRUE(state.at_rest);
    EXPECT_EQ(state.position, start.position);
    EXPECT_EQ(steps_taken, 11);
    Batch batch(block(), 3);
    for (std::size_t i = 0; i < batch.size(); ++i) batch.set_state(i, start);
    EXPECT_EQ(batch.advance(surroundings, 0.0, 0.002, 0, 101).implicit_steps, 33U);
    expect_same_bits(batch.state(2), state);
}

TEST(GroundRest, AGustLiftsWhatTheAirBesideTheGroundCannotMove) {
    // A wind that begins after a second: in the layer beside the ground the leaf lies still, without one it
    // goes.
    for (const bool layered : {true, false}) {
        Surroundings surroundings = ground_at_zero();
        BodyState state = test::above_ground(leaf(), Quaterniond::Identity(), 0.0005);
        state = test::flown(leaf(), surroundings, state, 4.0, 0.002);
        ASSERT_TRUE(state.at_rest);
        Wind wind;
        wind.velocity = Vector3d(2.0, 0.0, 0.0);
        wind.surface_layer = WindSurfaceLayer{.height = layered ? 0.1 : 0.0};
        surroundings.wind = std::make_shared<const WindField>(wind, Vector3d::Zero());
        const BodyState end = test::flown(leaf(), surroundings, state, 2.0, 0.002);
        if (layered) {
            EXPECT_EQ(end.position, state.position);
        } else {
            EXPECT_GT((end.position - state.position).norm(), 0.01);
        }
    }
}

TEST(GroundRest, TurbulenceMovesABodyThatItCanLiftAndNoOther) {
    for (const double energy : {1e-6, 0.5}) {
        ImmersedBody body = block();
        body.turbulence = Turbulence::constant;
        body.turbulent_kinetic_energy = energy;
        body.dissipation_rate = energy;
        prepare(body);
        const BodyState start = test::above_ground(body, Quaterniond::Identity(), 0.0);
        const BodyState end = test::flown(body, ground_at_zero(), start, 4.0, 0.002);
        if (energy < 0.1) {
            EXPECT_EQ(end.position, start.position);
            EXPECT_TRUE(end.at_rest);
        } else {
            EXPECT_GT((end.position - start.position).norm(), 1e-3);
        }
    }
}

TEST(GroundRest, ALighterBodyThanTheFluidLeavesTheGroundAndDoesNotRestThere) {
    const ImmersedBody cork = test::uniform_body(test::box({0.02, 0.02, 0.02}, 2), 990.0, water);
    const BodyState start = test::above_ground(cork, Quaterniond::Identity(), 0.0);
    const Settled end = settled(cork, start, 2.0, 0.002);
    EXPECT_FALSE(end.state.at_rest);
    EXPECT_GT(end.state.position.z() - start.position.z(), 0.02);
}

TEST(GroundRest, DoesNotHoldABodyInTheAirNorOneOnItsEdge) {
    // Let go at rest, which is no rest.
    const BodyState high = test::above_ground(block(), Quaterniond::Identity(), 0.001);
    EXPECT_LT(test::flown(block(), ground_at_zero(), high, 0.01, 0.002).position.z(), high.position.z());
    const BodyState edge = test::above_ground(block(), turned(0.25 * std::numbers::pi, {0, 1, 0}), 0.0);
    const Settled end = settled(block(), edge, 3.0, 0.002);
    EXPECT_TRUE(end.state.at_rest);
    EXPECT_NEAR((end.state.orientation.toRotationMatrix().row(2).cwiseAbs().maxCoeff()), 1.0, 1e-6);
}

TEST(GroundRest, IsTheSameAtShortAndLongSteps) {
    // A block that topples off its edge, and a leaf that rocks: the pose they rest in.
    const auto tilt = [](const BodyState& state) {
        return Vector3d(state.orientation.conjugate() * Vector3d::UnitZ());
    };
    for (const ImmersedBody* body : {&block(), &leaf()}) {
        const BodyState start = test::above_ground(*body, turned(0.3, {0, 1, 0}), 0.0);
        const Settled coarse = settled(*body, start, 6.0, 1.0 / 60.0);
        const Settled fine = settled(*body, start, 6.0, 1.0 / 240.0);
        EXPECT_TRUE(coarse.state.at_rest);
        EXPECT_TRUE(fine.state.at_rest);
        EXPECT_LT((tilt(coarse.state) - tilt(fine.state)).norm(), 0.02);
        const double radius = body->contact_points.bounding_radius;
        EXPECT_LT((coarse.state.position - fine.state.position).norm(), 0.1 * radius);
    }
}

TEST(GroundRest, InACurrentABodyAtRestKeepsItsPlaceInTheWorld) {
    Surroundings surroundings = ground_at_zero();
    surroundings.current = Vector3d(0.05, -0.02, 0.0);
    BodyState state = test::above_ground(block(), Quaterniond::Identity(), 0.0);
    state.velocity.tail<3>() = -surroundings.current;
    const BodyState end = test::flown(block(), surroundings, state, 100.0, 0.002);
    EXPECT_TRUE(end.at_rest);
    EXPECT_LT((end.position + flow_displacement(surroundings, 100.0) - state.position).norm(), 1e-11);
    EXPECT_EQ(end.orientation.coeffs(), state.orientation.coeffs());
}

TEST(GroundRest, InABatchIsThatOfABodyAloneWhateverTheThreadsAndCalls) {
    Surroundings drifting = ground_at_zero();
    drifting.current = Vector3d(0.05, 0.02, 0.0);
    Surroundings gusty = ground_at_zero();
    gusty.gust = {.amplitude = Vector3d(0.02, 0.0, 0.0), .period = 0.3};
    constexpr std::size_t count = 37;
    constexpr double step = 0.01;
    constexpr std::uint64_t steps = 400;
    for (const Surroundings& surroundings : {ground_at_zero(), drifting, gusty}) {
        std::vector<BodyState> alone(count);
        Batch whole(block(), count);
        Batch pieces(block(), count);
        for (std::size_t i = 0; i < count; ++i) {
            const auto number = static_cast<double>(i);
            alone[i] = test::above_ground(block(), turned(0.17 * number, {1, 2, 3}), 0.004 * number);
            whole.set_state(i, alone[i]);
            pieces.set_state(i, alone[i]);
        }
        whole.advance(surroundings, 0.0, step, 0, steps, 2);
        for (std::uint64_t first = 0; first < steps; first += 40) {
            pieces.advance(surroundings, 0.0, step, first, 40, 1);
        }
        const Noise noise(0, "", 0, 0);
        std::size_t resting = 0;
        for (std::size_t i = 0; i < count; ++i) {
            for (std::uint64_t k = 0; k < steps; ++k) {
                alone[i] = advance(block(), surroundings, 0.0, step, alone[i], noise, k).state;
            }
            expect_same_bits(whole.state(i), alone[i]);
            expect_same_bits(pieces.state(i), alone[i]);
            resting += alone[i].at_rest ? 1 : 0;
        }
        EXPECT_GT(resting, count / 2);
    }
}

}  // namespace
}  // namespace samara
