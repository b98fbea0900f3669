// How long the steps of a scene may be.
#include "samara/analysis/advice/step_advice.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/core/body/body_file.hpp"
#include "samara/core/simulation/simulation.hpp"
#include "samara/scene/ready_bodies.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

LoadedBody lopsided() {
    return {test::lopsided_shape(), "lopsided"};
}

/// The lopsided body, thrown askew.
Scene thrown(double speed = 0.3, double rate = 3.0) {
    Scene scene;
    scene.duration = 4.0;
    scene.step_auto = true;
    SceneBody body = test::scene_body(1200.0);
    body.name = "body";
    body.velocity = speed * Vector3d(0.5, -0.3, 0.4);
    body.angular_velocity = rate * Vector3d(0.5, 0.7, -0.4);
    scene.bodies = {body};
    return scene;
}

/// The poses after two seconds, at a step.
Pose pose_at(const Scene& scene, double step) {
    Simulation simulation({.step = step});
    simulation.add(lopsided(), scene.bodies[0], scene.bodies[0]);
    simulation.advance_to(0.4);
    return simulation.pose(0);
}

TEST(StepAdvice, StaysWithinTheToleranceWhereALongerStepIsFartherOff) {
    Scene scene = thrown(0.3, 12.0);
    scene.step_tolerance = 2e-5;
    const StepAdvice advice = advise_step(scene, {lopsided()}, 1);
    EXPECT_TRUE(advice.is_within);
    EXPECT_LE(advice.error, 2e-5);
    EXPECT_GT(advice.error, 1e-6);
    EXPECT_LT(advice.step, 0.02);
    EXPECT_EQ(advice.limit, "the motion of 'body'");
    const Pose truth = pose_at(scene, 1e-4);
    const double off = (pose_at(scene, advice.step).position - truth.position).norm();
    const double off_at_longer = (pose_at(scene, 4.0 * advice.step).position - truth.position).norm();
    EXPECT_LT(off, 5.0 * scene.step_tolerance * truth.position.norm()) << "beyond a window errors add up";
    EXPECT_GT(off_at_longer, off);
}

TEST(StepAdvice, GivesShorterStepsForSmallerTolerances) {
    Scene scene = thrown(0.3, 12.0);
    double before = 1.0;
    for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5}) {
        scene.step_tolerance = tolerance;
        const double step = advise_step(scene, {lopsided()}, 1).step;
        EXPECT_LE(step, before);
        before = step;
    }
    EXPECT_LT(before, 0.01);
    scene.step_tolerance = 1e-6;
    EXPECT_FALSE(advise_step(scene, {lopsided()}, 1).is_within) << "finer than it looks";
}

TEST(StepAdvice, DoesNotDependOnFramesNorOnThreads) {
    Scene scene = thrown();
    scene.step_tolerance = 1e-4;
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies[1].name = "other";
    const std::vector<LoadedBody> loaded = {lopsided(), lopsided()};
    const StepAdvice advice = advise_step(scene, loaded, 1);
    scene.frame_rate = 24.0;
    const StepAdvice others = advise_step(scene, loaded, 2);
    EXPECT_EQ(advice.step, others.step);
    EXPECT_EQ(advice.error, others.error);
}

TEST(StepAdvice, IsTheLongestWhereNothingMoves) {
    Scene scene = thrown(0.0, 0.0);
    scene.gravity.setZero();
    const StepAdvice advice = advise_step(scene, {lopsided()}, 1);
    EXPECT_EQ(advice.step, 0.04);
    EXPECT_EQ(advice.error, 0.0);
    EXPECT_EQ(advice.limit, "");
    EXPECT_EQ(as_text(advice), "40 ms, off by 0 % of the distance covered; the longest possible");
}

TEST(StepAdvice, LetsTurbulenceMakeTheDiffusionTooLargeByTheToleranceAtMost) {
    Scene scene = thrown();
    SceneBody& body = scene.bodies[0];
    body.turbulence = Turbulence::constant;
    body.turbulent_kinetic_energy = 1e-3;
    body.dissipation_rate = 0.05;
    const StepAdvice advice = advise_step(scene, {lopsided()}, 1);
    const double rate = 0.75 * 2.1 * 50.0;
    EXPECT_NEAR(advice.bodies[0].turbulence, std::sqrt(12.0 * 0.005) / rate, 1e-12);
    EXPECT_EQ(advice.step, 0.04 / 16) << "3.11 ms, and the next below";
    EXPECT_EQ(advice.limit, "the turbulence of 'body'");
}

/// The ready-baked cube swings by its noise, hardly damped: to a step of 40 ms, by which its path is right,
/// it would lose its swing twice as fast.
TEST(StepAdvice, SeesWhatNoiseTurns) {
    Scene scene;
    scene.duration = 6.0;
    scene.step_auto = true;
    SceneBody cube;
    cube.name = "cube";
    cube.orientation = Quaterniond(0.8, 0.3, 0.5, 0.1).normalized();
    cube.dynamic = Dynamic::by_default;  // with which its swings hardly decay by themselves
    scene.bodies = {cube};
    const LoadedBody loaded{read_body_file(ready_body_file("cube")), "hash"};
    const StepAdvice advice = advise_step(scene, {loaded}, 1);
    EXPECT_EQ(advice.step, 0.01);
    EXPECT_EQ(advice.limit, "the rotation of 'cube'");
    EXPECT_EQ(advice.bodies[0].motion, 0.04);
    EXPECT_EQ(advice.bodies[0].rotation, 0.01);
    scene.bodies[0].turbulence = Turbulence::none;
    EXPECT_EQ(advise_step(scene, {loaded}, 1).step, 0.04);
}

/// (a h)^2/12: the diffusion by a sampled turbulence that goes evenly between samples, over that by the
/// process.
TEST(StepAdvice, KnowsByHowMuchEvenStretchesMakeTheDiffusionTooLarge) {
    for (const double x : {0.05, 0.1, 0.245}) {
        double sum = 1.0;
        for (int k = 1; k < 1000; ++k) sum += 2.0 * std::exp(-x * k);
        const double of_samples = x * sum;  // h (1 + 2 sum of the autocorrelation), times a
        const double of_process = 2.0;
        EXPECT_NEAR(of_samples / of_process - 1.0, x * x / 12.0, 0.02 * x * x / 12.0) << x;
    }
}

TEST(StepAdvice, GivesSmallCopiesShorterStepsThanLargeOnes) {
    const auto longest = [](double size) {
        Scene scene = thrown(0.0, 0.0);
        scene.bodies[0].orientation = Quaterniond(0.9, 0.3, 0.3, 0.0).normalized();
        scene.bodies[0].smallest_size = scene.bodies[0].largest_size = size;
        scene.step_tolerance = 1e-4;
        return advise_step(scene, {lopsided()}, 1).step;
    };
    EXPECT_LT(longest(0.02), longest(1.0));
}

}  // namespace
}  // namespace samara
