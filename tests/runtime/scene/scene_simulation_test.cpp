#include "samara/scene/scene_simulation.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "samara/core/base/error.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/motion/motion_writer.hpp"
#include "support/known_bodies.hpp"
#include "support/temporary_folder.hpp"

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

std::vector<LoadedBody> loaded_bodies() {
    Body rubber = test::rubber_ellipsoid();
    rubber.tables = test::blunt_tables(rubber, 4);
    return {{rubber, "hash"}};
}

Motion flown(const Scene& scene, int runs = 1) {
    return simulate(scene, loaded_bodies(), runs, go_on).motion;
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

TEST(Simulation, ForcesOfTheFramesAreThoseOfTheSimulationAtTheEndsOfTheirStepsAndChangeNoPose) {
    Scene scene = noisy_scene();
    scene.bodies[0].count = 3;
    scene.bodies[0].spread_angle = 1.0;
    const Motion with = simulate(scene, loaded_bodies(), 2, go_on, 1, true).motion;
    const Motion without = flown(scene, 2);
    EXPECT_TRUE(without.bodies[0].forces.empty());
    ASSERT_EQ(with.bodies[0].forces.size(), with.bodies[0].poses.size());
    Simulation simulation = simulation_of(scene, loaded_bodies(), 2, 1);
    for (const int frame : {1, 30, 60}) {
        simulation.advance_to(with.times[static_cast<std::size_t>(frame)]);
        for (int run = 0; run < 2; ++run) {
            for (int copy = 0; copy < 3; ++copy) {
                expect_same(with.pose(with.bodies[0], run, frame, copy),
                            without.pose(without.bodies[0], run, frame, copy));
                const FluidForces& kept = with.bodies[0].forces[with.index(with.bodies[0], run, frame, copy)];
                const FluidForces now = simulation.fluid_forces(static_cast<std::size_t>(3 * run + copy));
                EXPECT_EQ(kept.drag, now.drag);
                EXPECT_EQ(kept.noise, now.noise);
                EXPECT_FALSE(kept.drag.is_zero());
            }
        }
    }
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
    ASSERT_EQ(body.poses.size(), 6 * many.times.size());
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

/// A sphere of the fluid's own density with drag.
Scene neutral_scene() {
    Scene scene;
    scene.duration = 2.0;
    SceneBody body = test::scene_body(scene.fluid.density);
    body.name = "sphere";
    body.loads = Loads::coefficients;
    scene.bodies.push_back(body);
    return scene;
}

TEST(Simulation, ANeutralSphereMovesWithAGust) {
    Scene scene = neutral_scene();
    scene.fluid.gust = {.amplitude = Vector3d(0.3, 0.0, 0.1), .period = 0.7};
    const std::vector<LoadedBody> sphere = {{test::exact_sphere(0.01), "hash"}};
    const Motion motion = simulate(scene, sphere, 1, go_on).motion;
    for (int frame = 0; frame < motion.frames(); ++frame) {
        const Pose& pose = motion.pose(motion.bodies[0], 0, frame, 0);
        const double phase = 2.0 * std::numbers::pi * motion.times[static_cast<std::size_t>(frame)] / 0.7;
        EXPECT_LT((pose.velocity - std::sin(phase) * scene.fluid.gust.amplitude).norm(), 1e-12);
        const Vector3d displacement =
            0.7 / (2.0 * std::numbers::pi) * (1.0 - std::cos(phase)) * scene.fluid.gust.amplitude;
        EXPECT_LT((pose.position - displacement).norm(), 1e-12);
    }
}

TEST(Simulation, AGustAcceleratesABodyByTheDisplacedAndTheAddedMass) {
    // Without drag: (m + m_a) v' = (rho V + m_a) u', whatever the density.
    for (const double ratio : {0.2, 1.0, 5.0}) {
        Scene scene = neutral_scene();
        scene.gravity.setZero();
        scene.bodies[0].mass.density = ratio * scene.fluid.density;
        scene.bodies[0].loads = Loads::none;
        scene.fluid.gust = {.amplitude = Vector3d(0.3, 0.0, 0.0), .period = 0.7};
        const std::vector<LoadedBody> sphere = {{test::exact_sphere(0.01), "hash"}};
        const Motion motion = simulate(scene, sphere, 1, go_on).motion;
        for (int frame = 0; frame < motion.frames(); frame += 10) {
            const double time = motion.times[static_cast<std::size_t>(frame)];
            const double flow = 0.3 * std::sin(2.0 * std::numbers::pi * time / 0.7);
            const double expected = (1.0 + 0.5) / (ratio + 0.5) * flow;
            // Frames between two steps are linear in the velocity.
            EXPECT_NEAR(motion.pose(motion.bodies[0], 0, frame, 0).velocity.x(), expected, 3e-5);
        }
    }
}

TEST(Simulation, ACurrentAndAStartTimeLeaveTheMotionInTheFlowAsItIs) {
    Scene scene = noisy_scene();
    const Motion still = flown(scene);
    scene.fluid.current = Vector3d(0.3, -0.2, 0.1);
    scene.bodies[0].velocity = scene.fluid.current;
    scene.bodies[0].start = 0.5;
    scene.bodies[0].position = Vector3d(1.0, 2.0, 3.0);
    scene.duration = 1.5;
    const Motion carried = flown(scene);
    for (int frame = 0; frame < still.frames(); ++frame) {
        const Pose& a = still.pose(still.bodies[0], 0, frame, 0);
        const Pose& b = carried.pose(carried.bodies[0], 0, frame + 30, 0);
        const auto time = still.times[static_cast<std::size_t>(frame)];
        const Vector3d carried_by = scene.bodies[0].position + time * scene.fluid.current;
        EXPECT_LT((b.position - a.position - carried_by).norm(), 1e-12);
        EXPECT_LT(a.orientation.angularDistance(b.orientation), 1e-7);
    }
    const Pose& waiting = carried.pose(carried.bodies[0], 0, 29, 0);
    EXPECT_EQ(waiting.position, carried.pose(carried.bodies[0], 0, 0, 0).position);
    EXPECT_EQ(waiting.velocity, Vector3d::Zero());
}

TEST(Simulation, ABodySettlesOnTheGroundAndOneBelowItIsRefused) {
    Scene scene = noisy_scene();
    scene.ground = -0.2;
    scene.duration = 12.0;
    scene.step = 0.005;
    scene.fluid.current = Vector3d(0.02, 0.0, 0.0);
    scene.bodies[0].turbulence = Turbulence::none;
    const Motion motion = flown(scene);
    const Pose& end = motion.pose(motion.bodies[0], 0, motion.frames() - 1, 0);
    EXPECT_NEAR(end.position.z(), -0.19, 4e-4);  // on its broad side, to 1 % of its longest radius
    EXPECT_LT(end.velocity.norm(), 1e-15);
    EXPECT_EQ(end.angular_velocity.norm(), 0.0);

    scene.bodies[0].position.z() = -0.2;
    try {
        flown(scene);
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("below the ground at -0.2 m"), std::string::npos)
            << error.what();
    }
}

TEST(Simulation, TheNumberOfThreadsDoesNotChangeABit) {
    Scene scene = noisy_scene();
    scene.bodies[0].count = 150;
    scene.duration = 0.2;
    const Motion one = simulate(scene, loaded_bodies(), 2, go_on, 1).motion;
    const Motion three = simulate(scene, loaded_bodies(), 2, go_on, 3).motion;
    for (std::size_t i = 0; i < one.bodies[0].poses.size(); ++i) {
        expect_same(one.bodies[0].poses[i], three.bodies[0].poses[i]);
    }
}

TEST(Simulation, BlocksOfFramesMakeUpTheWholeMotion) {
    Scene scene = noisy_scene();
    scene.frame_rate = 10'000.0;
    scene.bodies[0].turbulence = Turbulence::none;
    SceneSimulation simulation(scene, loaded_bodies(), 2);
    const Motion whole = simulate(scene, loaded_bodies(), 2, go_on).motion;
    std::size_t blocks = 0;
    std::size_t expected_first = 0;
    const SimulationReport report = simulation.fly(
        [&](const MotionBlock& block) {
            ++blocks;
            EXPECT_EQ(block.body, 0U);
            EXPECT_EQ(block.first_frame, expected_first);
            const std::size_t frames = block.poses.size() / 2;
            expected_first += frames;
            const auto last = static_cast<int>(expected_first) - 1;
            expect_same(block.poses.back(), whole.pose(whole.bodies[0], 1, last, 0));
            expect_same(block.poses[frames - 1], whole.pose(whole.bodies[0], 0, last, 0));
        },
        go_on);
    EXPECT_GT(blocks, 1U);
    EXPECT_EQ(report.frames, 10'001U);
}

TEST(Simulation, AnInterruptLeavesAShorterMotionThatIsWhole) {
    const test::TemporaryFolder folder;
    Scene scene = noisy_scene();
    scene.bodies[0].count = 3;
    const Motion whole = simulate(scene, loaded_bodies(), 2, go_on).motion;
    SceneSimulation simulation(scene, loaded_bodies(), 2);
    int frames = 0;
    SimulationReport report;
    write_motion_file(folder / "motion.h5", simulation.motion(), [&](MotionWriter& writer) {
        report = simulation.fly([&](const MotionBlock& block) { writer.write(block); },
                                [&](double, double) { return ++frames < 20; });
        writer.finish(report.frames, report.copies);
    });
    EXPECT_TRUE(report.interrupted);
    const Motion cut = read_motion_file(folder / "motion.h5");
    ASSERT_EQ(cut.frames(), 20);
    for (const int run : {0, 1}) {
        for (const int copy : {0, 1, 2}) {
            expect_same(cut.pose(cut.bodies[0], run, 19, copy), whole.pose(whole.bodies[0], run, 19, copy));
        }
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
    const std::vector<LoadedBody> bare = {{test::rubber_ellipsoid(), "hash"}};
    try {
        simulate(noisy_scene(), bare, 1, go_on);
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("samara bake"), std::string::npos) << error.what();
    }
}

TEST(Simulation, SaysWhetherTheDynamicCoefficientsAreDefaultsOrOfTheBodyFile) {
    const Scene scene = noisy_scene();
    std::vector<LoadedBody> bodies = loaded_bodies();
    EXPECT_NE(SceneSimulation(scene, bodies, 1).motion().bodies[0].models.find("by default"),
              std::string::npos);
    IdentifiedCoefficients identified;
    identified.values.half_length = 0.04;
    identified.values.origin = "identified from 3 falls";
    Body with_own = *bodies[0].body;
    with_own.dynamic = identified;
    bodies = {{with_own, "hash"}};
    const std::string models = SceneSimulation(scene, bodies, 1).motion().bodies[0].models;
    EXPECT_NE(models.find("identified from 3 falls"), std::string::npos) << models;
    EXPECT_EQ(models.find("by default"), std::string::npos) << models;
}

TEST(Simulation, AnInertiaOfNoBodyIsRefused) {
    Scene scene = noisy_scene();
    scene.bodies[0].mass = {.density = {},
                            .mass = 1.0,
                            .center_of_mass = {},
                            .inertia = Matrix3d(Vector3d(1, 1, 3).asDiagonal())};
    EXPECT_THROW(simulate(scene, loaded_bodies(), 1, go_on), Error);
}

TEST(Simulation, StopsWhenAskedTo) {
    Scene scene = noisy_scene();
    scene.duration = 100.0;
    EXPECT_THROW(simulate(scene, loaded_bodies(), 1, [](double, double) { return false; }), Error);
}

}  // namespace
}  // namespace samara
