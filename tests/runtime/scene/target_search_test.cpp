#include "samara/scene/target_search.hpp"

#include <gtest/gtest.h>

#include "samara/scene/scene_simulation.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

/// A sphere that falls straight: without loads by g (m - rho V) / (m + rho V / 2).
Scene falling_sphere(int count) {
    Scene scene;
    scene.duration = 1.0;
    SceneBody body = test::scene_body(2000.0);
    body.name = "ball";
    body.loads = Loads::none;
    body.turbulence = Turbulence::none;
    body.count = count;
    scene.bodies.push_back(body);
    return scene;
}

double depth() {
    const double rho = Fluid().density;
    return 0.5 * 9.81 * (2000.0 - rho) / (2000.0 + 0.5 * rho);
}

std::vector<LoadedBody> ball() {
    return {LoadedBody(test::exact_sphere(0.01), "hash")};
}

TEST(TargetSearch, ASphereThatFallsStraightEndsInTheBallBelowIt) {
    const Target below{.middle = {0.0, 0.0, -depth()}, .radius = 1e-6};
    const TargetMiss hit = search_target(falling_sphere(1), ball(), 0, below, 1, 1).front();
    EXPECT_TRUE(hit.reached);
    EXPECT_LT(hit.distance, 1e-9);
    EXPECT_NEAR(hit.time, 1.0, 1e-12);
    const Target beside{.middle = {0.3, 0.0, -depth() - 0.4}, .radius = 0.4};
    const TargetMiss miss = search_target(falling_sphere(1), ball(), 0, beside, 1, 1).front();
    EXPECT_FALSE(miss.reached);
    EXPECT_NEAR(miss.distance, 0.5, 1e-9);
}

TEST(TargetSearch, ARingIsPassedWhereThePathCrossesItsPlane) {
    const double quarter = 0.25 * depth();  // after half the time
    const Target ring{.middle = {0.02, 0.0, -quarter}, .radius = 0.03, .normal = Vector3d::UnitZ()};
    const TargetMiss hit = search_target(falling_sphere(1), ball(), 0, ring, 1, 1).front();
    EXPECT_TRUE(hit.reached);
    EXPECT_NEAR(hit.distance, 0.02, 1e-9);
    EXPECT_NEAR(hit.time, 0.5, 1e-4);
    const Target aside{.middle = {0.02, 0.0, -quarter}, .radius = 0.01, .normal = Vector3d::UnitZ()};
    EXPECT_FALSE(search_target(falling_sphere(1), ball(), 0, aside, 1, 1).front().reached);
    const Target upright{.middle = {0.02, 0.0, -quarter}, .radius = 0.03, .normal = Vector3d::UnitX()};
    const TargetMiss never = search_target(falling_sphere(1), ball(), 0, upright, 1, 1).front();
    EXPECT_FALSE(never.reached);
    EXPECT_LT(never.distance, 0.05);
}

TEST(TargetSearch, TheOrderIsThatOfTheDistancesForAnyNumberOfThreads) {
    Scene scene = falling_sphere(3);
    scene.bodies[0].spread_position = Vector3d(0.2, 0.2, 0.0);
    const Target below{.middle = {0.1, 0.0, -depth()}, .radius = 0.03};
    const std::vector<TargetMiss> one = search_target(scene, ball(), 0, below, 40, 1);
    const std::vector<TargetMiss> three = search_target(scene, ball(), 0, below, 40, 3);
    ASSERT_EQ(one.size(), 40U);
    EXPECT_TRUE(one.front().reached);
    EXPECT_FALSE(one.back().reached);
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one[i].seed, three[i].seed);
        EXPECT_EQ(one[i].distance, three[i].distance);
    }
    for (std::size_t i = 1; i < one.size(); ++i) EXPECT_LE(one[i - 1].distance, one[i].distance);
}

TEST(TargetSearch, TheSeedCountsWhereStartsNoiseGustsOrOthersAreDrawnFromIt) {
    const auto depends = [](const auto& change) {
        Scene scene = falling_sphere(1);
        scene.bodies.push_back(scene.bodies[0]);
        change(scene);
        return depends_on_seed(scene, 0);
    };
    EXPECT_FALSE(depends([](Scene&) {}));
    EXPECT_FALSE(depends([](Scene& s) { s.bodies[0].count = 3; }));
    EXPECT_TRUE(depends([](Scene& s) { s.bodies[0].count = 3, s.bodies[0].spread_start = 1.0; }));
    EXPECT_TRUE(depends([](Scene& s) { s.bodies[0].turbulence = Turbulence::table; }));
    EXPECT_FALSE(depends([](Scene& s) { s.bodies[0].turbulence = Turbulence::constant; })) << "of no energy";
    EXPECT_TRUE(depends([](Scene& s) { s.wind.gusts = WindGusts{.rms = 1.0}; }));
    EXPECT_FALSE(depends([](Scene& s) { s.wind.gusts = WindGusts{.rms = 1.0, .seed = 3}; }));
    EXPECT_FALSE(depends([](Scene& s) { s.bodies[1].turbulence = Turbulence::table; }));
    EXPECT_TRUE(
        depends([](Scene& s) { s.bodies[1].turbulence = Turbulence::table, s.bodies_collide = true; }));
    EXPECT_TRUE(depends([](Scene& s) { s.bodies[0].emitter = std::make_shared<const Emitter>(); }));
}

TEST(TargetSearch, TheSeedFliesAgainToTheSamePlace) {
    Scene scene = falling_sphere(3);
    scene.bodies[0].spread_position = Vector3d(0.2, 0.2, 0.0);
    const Target below{.middle = {0.1, 0.0, -depth()}, .radius = 0.03};
    const TargetMiss best = search_target(scene, ball(), 0, below, 40, 2).front();
    scene.seed = best.seed;
    const Motion again = simulate(scene, ball(), 1, [](double, double) { return true; }).motion;
    const Pose& end = again.pose(again.bodies[0], 0, again.frames() - 1, best.copy);
    EXPECT_EQ((end.position - below.middle).norm(), best.distance);
}

}  // namespace
}  // namespace samara
