#include "samara/simulation/simulation.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "samara/base/error.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

bool go_on(double /*done*/, double /*total*/) {
    return true;
}

Scene noisy_scene() {
    Scene scene;
    scene.duration = 1.0;
    SceneBody body = test::scene_body(1200.0);
    body.name = "rubber";
    body.turbulence = Turbulence::table;
    body.orientation = Quaterniond(Eigen::AngleAxisd(-1.2, Vector3d::UnitY()));
    scene.bodies.push_back(body);
    return scene;
}

std::vector<CastBody> cast() {
    CastBody rubber{test::rubber_ellipsoid(), "hash"};
    rubber.body.tables = test::blunt_tables(rubber.body, 4);
    return {rubber};
}

Motion flown(const Scene& scene, int runs = 1) {
    return simulate(scene, cast(), runs, go_on).motion;
}

void expect_same(const Pose& a, const Pose& b) {
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.orientation.coeffs(), b.orientation.coeffs());
    EXPECT_EQ(a.velocity, b.velocity);
    EXPECT_EQ(a.angular_velocity, b.angular_velocity);
}

TEST(Simulation, FramesLieAtTheFrameRateFromZeroToTheDuration) {
    Scene scene = noisy_scene();
    scene.duration = 4.0;
    scene.frame_rate = 60.0;
    const Motion motion = flown(scene);
    ASSERT_EQ(motion.frames(), 241);
    EXPECT_EQ(motion.times.front(), 0.0);
    EXPECT_NEAR(motion.times.back(), 4.0, 1e-12);
}

TEST(Simulation, TheSameSeedGivesTheSameMotionAndAnotherSeedAnother) {
    Scene scene = noisy_scene();
    const Motion first = flown(scene);
    const Motion again = flown(scene);
    scene.seed = 2;
    const Motion other = flown(scene);
    for (int frame = 0; frame < first.frames(); ++frame) {
        expect_same(first.pose(first.bodies[0], 0, frame, 0), again.pose(again.bodies[0], 0, frame, 0));
    }
    EXPECT_NE(first.bodies[0].poses.back().position, other.bodies[0].poses.back().position);
}

TEST(Simulation, TheFrameRateDoesNotChangeTheMotion) {
    Scene scene = noisy_scene();
    scene.frame_rate = 25.0;
    const Motion slow = flown(scene);
    scene.frame_rate = 100.0;
    const Motion fast = flown(scene);
    for (int frame = 0; frame < slow.frames(); ++frame) {
        const Pose& a = slow.pose(slow.bodies[0], 0, frame, 0);
        const Pose& b = fast.pose(fast.bodies[0], 0, 4 * frame, 0);
        EXPECT_LT((a.position - b.position).norm(), 1e-12);
        EXPECT_LT(a.orientation.angularDistance(b.orientation), 1e-7);
    }
}

TEST(Simulation, RunsAndCopiesDifferAndDoNotDependOnHowManyThereAre) {
    Scene scene = noisy_scene();
    const Motion alone = flown(scene);
    scene.bodies[0].count = 3;
    const Motion many = flown(scene, 2);
    const BodyMotion& body = many.bodies[0];
    ASSERT_EQ(body.poses.size(), 2U * 3U * many.times.size());
    const int last = many.frames() - 1;
    expect_same(alone.pose(alone.bodies[0], 0, last, 0), many.pose(body, 0, last, 0));
    EXPECT_NE(many.pose(body, 0, last, 0).position, many.pose(body, 1, last, 0).position);
    EXPECT_NE(many.pose(body, 0, last, 0).position, many.pose(body, 0, last, 1).position);
}

TEST(Simulation, ASpreadStaysWithinItsBounds) {
    Scene scene = noisy_scene();
    scene.bodies[0].count = 200;
    scene.bodies[0].spread_position = Vector3d(0.1, 0.0, 0.2);
    scene.bodies[0].spread_angle = 0.3;
    scene.duration = 0.02;
    const Motion motion = flown(scene);
    double widest = 0.0;
    for (int copy = 0; copy < 200; ++copy) {
        const Pose& pose = motion.pose(motion.bodies[0], 0, 0, copy);
        EXPECT_LE(std::abs(pose.position.x()), 0.1);
        EXPECT_NEAR(pose.position.y(), 0.0, 1e-15);
        EXPECT_LE(pose.orientation.angularDistance(scene.bodies[0].orientation), 0.3 + 1e-7);
        widest = std::max(widest, std::abs(pose.position.x()));
    }
    EXPECT_GT(widest, 0.09);
}

TEST(Simulation, AUniformCurrentCarriesTheSameMotionAlong) {
    Scene scene = noisy_scene();
    const Motion still = flown(scene);
    scene.fluid.current = Vector3d(0.3, -0.2, 0.1);
    scene.bodies[0].velocity = scene.fluid.current;
    const Motion carried = flown(scene);
    for (int frame = 0; frame < still.frames(); ++frame) {
        const Pose& a = still.pose(still.bodies[0], 0, frame, 0);
        const Pose& b = carried.pose(carried.bodies[0], 0, frame, 0);
        const auto time = still.times[static_cast<std::size_t>(frame)];
        EXPECT_LT((b.position - a.position - time * scene.fluid.current).norm(), 1e-13);
        EXPECT_EQ(a.orientation.coeffs(), b.orientation.coeffs());
    }
}

TEST(Simulation, ABodyWaitsForItsStartAndThenMovesAsIfItHadNot) {
    Scene scene = noisy_scene();
    const Motion now = flown(scene);
    scene.bodies[0].start = 0.5;
    scene.duration = 1.5;
    const Motion later = flown(scene);
    EXPECT_EQ(later.pose(later.bodies[0], 0, 29, 0).position, now.pose(now.bodies[0], 0, 0, 0).position);
    for (int frame = 0; frame < now.frames(); ++frame) {
        EXPECT_LT((later.pose(later.bodies[0], 0, frame + 30, 0).position -
                   now.pose(now.bodies[0], 0, frame, 0).position)
                      .norm(),
                  1e-12);
    }
}

TEST(Simulation, QuaternionSignsAreContinuous) {
    Scene scene = noisy_scene();
    scene.duration = 4.0;
    scene.bodies[0].angular_velocity = Vector3d(0, 20, 3);
    const Motion motion = flown(scene);
    for (int frame = 1; frame < motion.frames(); ++frame) {
        EXPECT_GT(motion.pose(motion.bodies[0], 0, frame, 0)
                      .orientation.dot(motion.pose(motion.bodies[0], 0, frame - 1, 0).orientation),
                  0.0);
    }
}

TEST(Simulation, ABodyWithoutTablesIsRefusedWithTheCommandThatMakesThem) {
    std::vector<CastBody> bare = cast();
    bare[0].body.tables.reset();
    try {
        simulate(noisy_scene(), bare, 1, go_on);
        FAIL() << "accepted";
    } catch (const Error& fault) {
        EXPECT_NE(std::string(fault.what()).find("samara bake"), std::string::npos) << fault.what();
    }
}

TEST(Simulation, AnInertiaOfNoBodyIsRefused) {
    Scene scene = noisy_scene();
    scene.bodies[0].mass = {.density = {},
                            .mass = 1.0,
                            .center_of_mass = {},
                            .inertia = Matrix3d(Vector3d(1, 1, 3).asDiagonal())};
    EXPECT_THROW(simulate(scene, cast(), 1, go_on), Error);
}

TEST(Simulation, StopsWhenAskedTo) {
    Scene scene = noisy_scene();
    scene.duration = 100.0;
    EXPECT_THROW(simulate(scene, cast(), 1, [](double, double) { return false; }), Error);
}

}  // namespace
}  // namespace samara
