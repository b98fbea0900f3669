#include "samara/analysis/metrics/sampled_falls.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "samara/analysis/metrics/ensemble.hpp"
#include "samara/scene/terminal_speed.hpp"
#include "support/hard_bodies.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

constexpr double radius = 0.02;  // m
constexpr double density = 1300.0;
constexpr double drag_coefficient = 0.5;

/// A ball in water that sinks against its drag alone.
Scene ball_scene() {
    Scene scene;
    scene.duration = 8.0;
    scene.fluid = test::water();
    SceneBody body = test::scene_body(density);
    body.loads = Loads::coefficients;
    body.coefficients.drag_coefficient = drag_coefficient;
    body.coefficients.reference_area = std::numbers::pi * radius * radius;
    scene.bodies = {body};
    return scene;
}

/// Where drag and weight less buoyancy are equal.
double terminal_speed_of_the_ball() {
    const Fluid water = test::water();
    return std::sqrt(8.0 / 3.0 * (density / water.density - 1.0) * 9.81 * radius / drag_coefficient);
}

LoadedBody ball() {
    return {test::exact_sphere(radius), "hash"};
}

SampledFalls falls_of(const Scene& scene, const LoadedBody& cast, std::uint64_t batch = 0,
                      const FallSampling& sampling = {.falls = 6}) {
    return sample_falls(scene, 0, cast, sampling, batch);
}

double metric(const SampledFall& fall, Metric which) {
    return *fall.metrics[which];
}

/// An ellipsoid in its own turbulence.
Scene shaken_scene() {
    Scene scene;
    scene.duration = 2.0;
    scene.fluid = test::water();
    SceneBody body = test::scene_body(1200.0);
    body.turbulence = Turbulence::table;
    body.orientation = Quaterniond(Eigen::AngleAxisd(0.4, Vector3d(0.3, 1.0, 0.2).normalized()));
    scene.bodies = {body};
    return scene;
}

LoadedBody ellipsoid() {
    return {test::baked_ellipsoid({0.01, 0.02, 0.04}), "hash"};
}

// The falls are copies that start in one place.
TEST(SampledFalls, AreTheSameWhetherOrNotTheScenesBodiesMeet) {
    Scene scene = shaken_scene();
    scene.duration = 0.5;
    const SampledFalls apart = falls_of(scene, ellipsoid());
    scene.bodies_collide = true;
    const SampledFalls meeting = falls_of(scene, ellipsoid());
    ASSERT_EQ(meeting.visits.size(), apart.visits.size());
    for (std::size_t i = 0; i < apart.visits.size(); ++i) {
        EXPECT_EQ(meeting.visits[i].direction, apart.visits[i].direction);
    }
}

TEST(SampledFalls, OfABallSinkAtItsTerminalSpeedOneLikeTheOther) {
    const SampledFalls sampled = falls_of(ball_scene(), ball());
    ASSERT_EQ(sampled.falls.size(), 6U);
    const double speed = terminal_speed_of_the_ball();
    for (const SampledFall& fall : sampled.falls) {
        ASSERT_TRUE(fall.measured);
        EXPECT_NEAR(metric(fall, Metric::descent_speed), speed, 1e-4 * speed);
        EXPECT_NEAR(fall.speed, speed, 1e-4 * speed);
        EXPECT_NEAR(metric(fall, Metric::path_spread), 0.0, 1e-6);
        EXPECT_EQ(fall.regime, Regime::steady);
    }
    const double reynolds = speed * 2.0 * radius / test::water().kinematic_viscosity();
    EXPECT_NEAR(sampled.flow.reynolds_number, reynolds, 2e-3 * reynolds);
    EXPECT_NEAR(sampled.highest_reynolds_number, reynolds, 2e-3 * reynolds);
    EXPECT_EQ(sampled.flow.turbulent_kinetic_energy, 0.0);
    EXPECT_EQ(sampled.flow.dissipation_rate, 0.0);
}

TEST(SampledFalls, AreMeasuredLessTheCurrent) {
    Scene scene = ball_scene();
    scene.fluid.current = Vector3d(0.3, -0.2, 0.0);
    scene.bodies[0].velocity = scene.fluid.current;
    for (const SampledFall& fall : falls_of(scene, ball()).falls) {
        EXPECT_NEAR(fall.speed, terminal_speed_of_the_ball(), 1e-3 * terminal_speed_of_the_ball());
    }
}

TEST(SampledFalls, MeetTheTurbulenceOfTheirTables) {
    Scene scene = shaken_scene();
    const LoadedBody cast = ellipsoid();
    const SampledFalls sampled = falls_of(scene, cast);
    double mean_square = 0.0;
    double speed = 0.0;
    for (const SampledFall& fall : sampled.falls) {
        mean_square += fall.speed * fall.speed / 6.0;
        speed = std::max(speed, fall.speed);
    }
    // blunt_tables: k between 0.008 and 0.02 of the squared speed, epsilon up to 0.008 of its cube over L.
    EXPECT_GT(sampled.flow.turbulent_kinetic_energy, 0.008 * mean_square);
    EXPECT_LT(sampled.flow.turbulent_kinetic_energy, 0.03 * mean_square);
    EXPECT_GT(sampled.flow.dissipation_rate, 0.0);
}

TEST(SampledFalls, AreTheSameForAnyNumberOfThreadsAndOthersInAnotherBatch) {
    const Scene scene = shaken_scene();
    const LoadedBody cast = ellipsoid();
    const SampledFalls by_one = falls_of(scene, cast, 3, {.falls = 6, .threads = 1});
    const SampledFalls by_three = falls_of(scene, cast, 3, {.falls = 6, .threads = 3});
    const SampledFalls others = falls_of(scene, cast, 4, {.falls = 6, .threads = 1});
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(by_one.falls[i].metrics, by_three.falls[i].metrics);
        EXPECT_EQ(by_one.falls[i].distance, by_three.falls[i].distance);
        EXPECT_NE(by_one.falls[i].metrics, others.falls[i].metrics);
        for (std::size_t j = 0; j < i; ++j) EXPECT_NE(by_one.falls[i].metrics, by_one.falls[j].metrics);
    }
    EXPECT_EQ(by_one.flow.reynolds_number, by_three.flow.reynolds_number);
}

TEST(SampledFalls, AreTheSameDrawsWhateverTheModels) {
    // One per cent more drag: what changes from fall to fall is far less than what differs between them.
    Scene scene = shaken_scene();
    scene.duration = 1.0;
    scene.bodies[0].loads = Loads::coefficients;
    const LoadedBody cast = ellipsoid();
    const FallSampling sampling{.falls = 16};
    const SampledFalls before = sample_falls(scene, 0, cast, sampling);
    scene.bodies[0].coefficients.drag_coefficient *= 1.001;
    const SampledFalls after = sample_falls(scene, 0, cast, sampling);
    double between = 0.0;
    double changed = 0.0;
    for (std::size_t i = 0; i < 16; ++i) {
        const double here = metric(before.falls[i], Metric::descent_speed);
        between += std::pow(here - metric(before.falls[(i + 1) % 16], Metric::descent_speed), 2);
        changed += std::pow(here - metric(after.falls[i], Metric::descent_speed), 2);
    }
    EXPECT_GT(changed, 0.0);
    EXPECT_LT(changed, 0.01 * between);
}

TEST(SampledFalls, SayNothingWhereTheFallIsTooShort) {
    Scene scene = ball_scene();
    scene.ground = -radius - 0.002;
    for (const SampledFall& fall : falls_of(scene, ball()).falls) EXPECT_FALSE(fall.measured);
}

TEST(SampledFalls, LastAsLongAsTheSceneOrAsTheirSteps) {
    Scene scene = ball_scene();
    const SceneBody& body = scene.bodies[0];
    EXPECT_DOUBLE_EQ(sampled_duration(scene, body, {}), 8.0);
    EXPECT_DOUBLE_EQ(sampled_duration(scene, body, {.most_steps = 1000}), 2.0);
    SceneBody late = body;
    late.start = 7.0;
    EXPECT_DOUBLE_EQ(sampled_duration(scene, late, {}), 1.0);
    late.start = 9.0;
    EXPECT_EQ(sampled_duration(scene, late, {}), 0.0);
}

/// The ellipsoid released askew, with frames enough that its falls take the scene's own.
Scene askew_scene(double of_density, double duration) {
    Scene scene = shaken_scene();
    scene.duration = duration;
    scene.frame_rate = 1000.0;
    scene.bodies[0].mass.density = of_density;
    scene.bodies[0].orientation = Quaterniond(0.8, 0.0, -0.55, 0.1).normalized();
    return scene;
}

LoadedBody unbaked_ellipsoid() {
    Body body = *ellipsoid().body;
    body.tables.reset();
    return {body, "hash"};
}

/// The sampled falls are those of the scene simulated with as many copies and the starts of a sampling.
void expect_falls_of(Scene scene, const LoadedBody& cast, const SampledFalls& sampled) {
    scene.bodies[0].count = static_cast<int>(sampled.falls.size());
    scene.bodies[0].spread_angle = 0.05;
    const Motion motion = simulate(scene, {cast}, 1, [](double, double) { return true; }).motion;
    const BodyMeasures all = measure_all(motion, motion.bodies[0]);
    for (const CataloguedMetric& entry : metric_catalogue) {
        if (!entry.measured || entry.metric == Metric::frequency || is_of_autorotation(entry.metric))
            continue;
        EXPECT_NEAR(sampled.mean(entry.metric)->value, all.value(entry.metric), 1e-10) << entry.key;
    }
    EXPECT_EQ(sampled.regimes(), all.regimes);
}

TEST(SampledFalls, AreThoseOfASimulationOfTheSameScene) {
    const Scene scene = askew_scene(1200.0, 2.0);
    expect_falls_of(scene, ellipsoid(), falls_of(scene, ellipsoid()));
}

TEST(SampledFalls, OfABodyWithoutTablesHaveCoefficientsAndATenthOfItsSpeedAsTurbulence) {
    Scene scene = askew_scene(1200.0, 1.0);
    const LoadedBody cast = unbaked_ellipsoid();
    const SampledFalls sampled = falls_of(scene, cast);
    const Body& body = *cast.body;
    const double speed = terminal_speed(body, scene.fluid, 1200.0 * body.moments.volume, 9.81);
    SceneBody& guessed = scene.bodies[0];
    guessed.loads = Loads::coefficients;
    guessed.turbulence = Turbulence::constant;
    guessed.turbulent_kinetic_energy = 1.5 * std::pow(0.1 * speed, 2);
    guessed.dissipation_rate =
        std::pow(guessed.turbulent_kinetic_energy, 1.5) / reference_length(body.moments.surface_area);
    expect_falls_of(scene, cast, sampled);
}

TEST(SampledFalls, OfABodyWithoutTablesOrATerminalSpeedHaveNoTurbulence) {
    Scene scene = askew_scene(1200.0, 0.2);
    scene.gravity.setZero();
    const SceneBody guessed = guessed_before_bake(scene, scene.bodies[0], *unbaked_ellipsoid().body);
    EXPECT_EQ(guessed.loads, Loads::coefficients);
    EXPECT_EQ(guessed.turbulence, Turbulence::none);
}

TEST(SampledFalls, GuessNothingWhereTheTablesAreThereOrAreNotAskedFor) {
    Scene scene = askew_scene(1200.0, 1.0);
    EXPECT_EQ(guessed_before_bake(scene, scene.bodies[0], *ellipsoid().body).turbulence, Turbulence::table);
    scene.bodies[0].loads = Loads::none;
    scene.bodies[0].turbulence = Turbulence::none;
    EXPECT_EQ(guessed_before_bake(scene, scene.bodies[0], *unbaked_ellipsoid().body).loads, Loads::none);
}

TEST(SampledFalls, AreOfTheBodyAskedForAlone) {
    Scene both = askew_scene(1200.0, 1.0);
    both.bodies.push_back(both.bodies[0]);
    both.bodies[0].name = "other";
    both.bodies[0].mass.density = 2000.0;
    const FallSampling sampling{.falls = 3};
    const SampledFalls second = sample_falls(both, 1, ellipsoid(), sampling);
    const SampledFalls alone = sample_falls(askew_scene(1200.0, 1.0), 0, ellipsoid(), sampling);
    const SampledFalls first = sample_falls(both, 0, ellipsoid(), sampling);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(second.falls[i].metrics, alone.falls[i].metrics);
        EXPECT_NE(second.falls[i].metrics, first.falls[i].metrics);
    }
}

TEST(SampledFalls, VisitTheDirectionsThatTheBodyMovesIn) {
    // A heavy body that starts along its x and has no time to turn.
    Scene scene = askew_scene(8000.0, 0.2);
    scene.bodies[0].turbulence = Turbulence::none;
    scene.bodies[0].orientation = Quaterniond::FromTwoVectors(Vector3d::UnitX(), -Vector3d::UnitZ());
    const SampledFalls sampled = falls_of(scene, ellipsoid());
    ASSERT_FALSE(sampled.visits.empty());
    for (const FlowVisit& visit : sampled.visits) {
        EXPECT_NEAR(visit.direction.norm(), 1.0, 1e-9);
        EXPECT_GT(visit.direction.x(), 0.9);
    }
}

TEST(SampledFalls, HaveNoMetricThatFewOfThemHave) {
    SampledFalls sampled;
    sampled.falls.resize(5);
    for (std::size_t i = 0; i < 2; ++i) sampled.falls[i].metrics[Metric::frequency] = 1.0;
    EXPECT_FALSE(sampled.mean(Metric::frequency));
    sampled.falls[2].metrics[Metric::frequency] = 4.0;
    EXPECT_EQ(sampled.mean(Metric::frequency)->value, 2.0);
}

TEST(SampledFalls, OfASmallBodyHaveTheFramesToSeeItTurn) {
    // Two millimetres long, in air: at 60 frames each second it would have turned many times between two.
    Scene scene = askew_scene(1200.0, 0.3);
    scene.fluid = test::air();
    scene.frame_rate = 60.0;
    scene.step = 1e-3;
    const SampledFalls sampled =
        sample_falls(scene, 0, {test::baked_ellipsoid({0.00025, 0.0005, 0.001}), "hash"}, {.falls = 1});
    EXPECT_GT(sampled.visits.size(), 290U);  // at every step
}

TEST(SampledFalls, TakeTimeForAStep) {
    const Scene scene = ball_scene();
    const double time = nanoseconds_per_step(scene, 0, ball(), {.falls = 4});
    EXPECT_GT(time, 1.0);
    EXPECT_LT(time, 1e6);
}

}  // namespace
}  // namespace samara
