#include "samara/scene/motion_search.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "samara/core/base/error.hpp"
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

SearchTry best_of(const Scene& scene, const SearchGoals& goals, int tries = 1,
                  const LaunchRanges& launch = {}) {
    return search_motion(scene, ball(), {.goals = goals, .launch = launch, .tries = tries, .threads = 2})
        .front();
}

TEST(MotionSearch, ASphereThatFallsStraightEndsInTheBallBelowIt) {
    const TargetGoal below{{0.0, 0.0, -depth()}, 1e-6};
    const GoalMiss hit = best_of(falling_sphere(1), {.target = below}).miss;
    EXPECT_TRUE(hit.reached());
    EXPECT_LT(*hit.target, 1e-9);
    const TargetGoal beside{{0.3, 0.0, -depth() - 0.4}, 0.4};
    const GoalMiss miss = best_of(falling_sphere(1), {.target = beside}).miss;
    EXPECT_FALSE(miss.reached());
    EXPECT_NEAR(*miss.target, 0.5, 1e-9);
    EXPECT_NEAR(miss.score, 0.5 / 0.4, 1e-8);
}

TEST(MotionSearch, ARingIsPassedWhereThePathCrossesItsPlane) {
    const double quarter = 0.25 * depth();  // after half the time
    const RingGoal ring{.middle = {0.02, 0.0, -quarter}, .radius = 0.03};
    const GoalMiss hit = best_of(falling_sphere(1), {.ring = ring}).miss;
    EXPECT_TRUE(hit.reached());
    EXPECT_NEAR(*hit.ring, 0.02, 1e-9);
    EXPECT_NEAR(*hit.ring_time, 0.5, 1e-4);
    const RingGoal aside{.middle = {0.02, 0.0, -quarter}, .radius = 0.01};
    EXPECT_FALSE(best_of(falling_sphere(1), {.ring = aside}).miss.reached());
    const RingGoal upright{.middle = {0.02, 0.0, -quarter}, .normal = Vector3d::UnitX(), .radius = 0.03};
    const GoalMiss never = best_of(falling_sphere(1), {.ring = upright}).miss;
    EXPECT_FALSE(never.reached());
    EXPECT_LT(*never.ring, 0.05);
}

TEST(MotionSearch, TheAxisThatIsUpIsThatOfTheLastFrame) {
    Scene scene = falling_sphere(1);
    scene.bodies[0].angular_velocity = Vector3d(0.5 * std::numbers::pi, 0.0, 0.0);  // y to z in the second
    const auto up = [&](const Vector3d& axis) { return best_of(scene, {.up = UpGoal{axis, 0.2}}).miss; };
    EXPECT_TRUE(up(Vector3d::UnitY()).reached());
    EXPECT_NEAR(*up(Vector3d::UnitY()).up, 0.0, 1e-3);
    EXPECT_FALSE(up(Vector3d::UnitZ()).reached());
    EXPECT_NEAR(*up(Vector3d::UnitZ()).up, 0.5 * std::numbers::pi, 1e-3);
    EXPECT_NEAR(*up(-Vector3d::UnitY()).up, std::numbers::pi, 1e-3);
}

TEST(MotionSearch, TheLandingIsTheFirstContact) {
    Scene scene = falling_sphere(1);
    scene.ground = -0.25 * depth() - 0.01;  // after half the time
    const GoalMiss lands = best_of(scene, {.landing = LandingGoal{0.5, 0.05}}).miss;
    EXPECT_TRUE(lands.reached());
    EXPECT_NEAR(*lands.landing, 0.5, 0.01);
    EXPECT_FALSE(best_of(scene, {.landing = LandingGoal{0.6, 0.05}}).miss.reached());
    scene.ground = -2.0 * depth();
    const GoalMiss never = best_of(scene, {.landing = LandingGoal{1.0, 0.05}}).miss;
    EXPECT_FALSE(never.reached());
    EXPECT_FALSE(never.landing.has_value());
}

TEST(MotionSearch, AllGoalsHoldOrTheWorstIsTheScore) {
    const TargetGoal below{{0.0, 0.0, -depth()}, 0.1};
    const RingGoal ring{.middle = {0.04, 0.0, -0.5 * depth()}, .radius = 0.05};
    const GoalMiss both = best_of(falling_sphere(1), {.target = below, .ring = ring}).miss;
    EXPECT_TRUE(both.reached());
    EXPECT_NEAR(both.score, 0.8, 1e-8);
    const GoalMiss one =
        best_of(falling_sphere(1), {.target = below, .up = UpGoal{Vector3d::UnitX(), 1.0}}).miss;
    EXPECT_NEAR(one.score, 0.5 * std::numbers::pi, 1e-8) << "it does not turn";
}

TEST(MotionSearch, TheOrderIsThatOfTheScoresForAnyNumberOfThreads) {
    Scene scene = falling_sphere(3);
    scene.bodies[0].spread_position = Vector3d(0.2, 0.2, 0.0);
    MotionSearch search{.goals = {.target = TargetGoal{{0.1, 0.0, -depth()}, 0.03}},
                        .launch = {.position_within = Vector3d(0.1, 0.0, 0.0)},
                        .tries = 40,
                        .threads = 1};
    const std::vector<SearchTry> one = search_motion(scene, ball(), search);
    search.threads = 3;
    const std::vector<SearchTry> three = search_motion(scene, ball(), search);
    ASSERT_EQ(one.size(), 40U);
    EXPECT_TRUE(one.front().miss.reached());
    EXPECT_FALSE(one.back().miss.reached());
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one[i].seed, three[i].seed);
        EXPECT_EQ(one[i].miss.score, three[i].miss.score);
        EXPECT_EQ(one[i].launch.position, three[i].launch.position);
    }
    for (std::size_t i = 1; i < one.size(); ++i) EXPECT_LE(one[i - 1].miss.score, one[i].miss.score);
}

TEST(MotionSearch, ABallIsThrownThroughARingByItsSpeedAndDirection) {
    Scene scene = falling_sphere(1);
    scene.bodies[0].velocity = Vector3d(0.5, 0.0, 0.0);
    const RingGoal ring{.middle = {0.4, 0.1, -0.1 * depth()}, .normal = Vector3d::UnitX(), .radius = 0.08};
    EXPECT_FALSE(best_of(scene, {.ring = ring}).miss.reached());
    const SearchTry found =
        best_of(scene, {.ring = ring}, 200, {.speed = {{0.5, 3.0}}, .direction_within = 0.5});
    EXPECT_TRUE(found.miss.reached());
    const SearchTry again = [&] {
        Scene one = scene_of_try(scene, 0, found);
        return best_of(one, {.ring = ring});
    }();
    EXPECT_EQ(*again.miss.ring, *found.miss.ring);
}

TEST(MotionSearch, LaunchesLieInTheirRangesAndHaveSixDigits) {
    Scene scene = falling_sphere(1);
    SceneBody& body = scene.bodies[0];
    body.velocity = Vector3d(0.0, 2.0, 0.0);
    body.position = Vector3d(1.0, 2.0, 3.0);
    const LaunchRanges ranges{.speed = {{0.5, 4.0}},
                              .direction_within = 0.3,
                              .orientation_within = 0.7,
                              .position_within = Vector3d(0.1, 0.2, 0.0)};
    double fastest = 0.0, widest = 0.0, most_turned = 0.0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const Launch launch = drawn_launch(ranges, body, seed);
        SceneBody drawn = body;
        launch.apply(drawn);
        const double speed = drawn.velocity.norm();
        EXPECT_GE(speed, 0.4999);
        EXPECT_LE(speed, 4.0001);
        fastest = std::max(fastest, speed);
        widest = std::max(widest, std::acos(drawn.velocity.y() / speed));
        most_turned = std::max(most_turned, drawn.orientation.angularDistance(body.orientation));
        EXPECT_TRUE(((drawn.position - body.position).cwiseAbs() - ranges.position_within).maxCoeff() < 1e-5);
        EXPECT_EQ(drawn.position.z(), 3.0);
        EXPECT_EQ(drawn.velocity.x(), std::stod(fmt::format("{:.6g}", drawn.velocity.x())));
        EXPECT_EQ((*launch.orientation)[2], std::stod(fmt::format("{:.6g}", (*launch.orientation)[2])));
    }
    EXPECT_GT(fastest, 3.8);
    EXPECT_GT(widest, 0.28);
    EXPECT_LT(widest, 0.3001);
    EXPECT_GT(most_turned, 0.65);
    EXPECT_LT(most_turned, 0.7001);
    EXPECT_FALSE(drawn_launch({}, body, 1).velocity.has_value());
}

TEST(MotionSearch, ARangeNeedsAVelocityWhoseDirectionItVaries) {
    SceneBody body = falling_sphere(1).bodies[0];
    EXPECT_THROW(require_launch({.direction_within = 0.2}, body), Error);
    EXPECT_THROW(require_launch({.speed = {{1.0, 2.0}}, .direction_within = 0.2}, body), Error);
    EXPECT_NO_THROW(require_launch({.speed = {{1.0, 2.0}}, .direction_within = std::numbers::pi}, body));
    body.emitter = std::make_shared<const Emitter>();
    EXPECT_THROW(require_launch({.position_within = Vector3d::Ones()}, body), Error);
    body.velocity = Vector3d::UnitX();
    EXPECT_NO_THROW(require_launch({.direction_within = 0.2}, body));
}

TEST(MotionSearch, TriesThatStartBelowTheGroundAreLeftOutUnlessAllDo) {
    Scene scene = falling_sphere(1);
    scene.ground = -0.05;
    const SearchGoals goals{.target = TargetGoal{{0.0, 0.0, -0.04}, 0.05}};
    const MotionSearch search{
        .goals = goals, .launch = {.position_within = Vector3d(0.0, 0.0, 0.2)}, .tries = 20};
    const std::vector<SearchTry> tries = search_motion(scene, ball(), search);
    EXPECT_TRUE(tries.front().error.empty());
    EXPECT_NE(tries.back().error.find("below the ground"), std::string::npos) << tries.back().error;
    scene.ground = 1.0;
    EXPECT_THROW(search_motion(scene, ball(), search), Error);
}

TEST(MotionSearch, TheSeedCountsWhereStartsNoiseGustsOrOthersAreDrawnFromIt) {
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

TEST(MotionSearch, TheSeedFliesAgainToTheSamePlace) {
    Scene scene = falling_sphere(3);
    scene.bodies[0].spread_position = Vector3d(0.2, 0.2, 0.0);
    const TargetGoal below{{0.1, 0.0, -depth()}, 0.03};
    const SearchTry best = best_of(scene, {.target = below}, 40);
    scene.seed = best.seed;
    const Motion again = simulate(scene, ball(), 1, [](double, double) { return true; }).motion;
    const Pose& end = again.pose(again.bodies[0], 0, again.frames() - 1, best.miss.copy);
    EXPECT_EQ((end.position - below.middle).norm(), *best.miss.target);
}

}  // namespace
}  // namespace samara
