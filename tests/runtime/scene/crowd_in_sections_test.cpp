#include <gtest/gtest.h>

#include "samara/core/files/content_hash.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/motion/motion_writer.hpp"
#include "samara/scene/scene_simulation.hpp"
#include "support/known_bodies.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

constexpr int many = 70'000;

bool go_on(double /*done*/, double /*total*/) {
    return true;
}

/// A crowd that is simulated in two sections, and a few bodies of another group.
Scene crowd() {
    Scene scene;
    scene.duration = 0.02;
    scene.step = 0.005;
    scene.frame_rate = 100.0;
    SceneBody body = test::scene_body(1200.0);
    body.name = "rubber";
    body.loads = Loads::none;
    body.count = many;
    body.spread_angle = 1.0;
    body.spread_start = 0.01;
    body.smallest_size = 0.5;
    body.largest_size = 2.0;
    scene.bodies.push_back(body);
    body.name = "few";
    body.count = 3;
    scene.bodies.push_back(body);
    return scene;
}

std::vector<LoadedBody> loaded() {
    const LoadedBody rubber(test::rubber_ellipsoid(), "hash");
    return {rubber, rubber};
}

SimulationReport fly_into(const std::filesystem::path& file, const SceneSimulation::Progress& progress,
                          int threads) {
    SceneSimulation simulation(crowd(), loaded(), 1, threads);
    SimulationReport report;
    write_motion_file(file, simulation.motion(), [&](MotionWriter& writer) {
        report = simulation.fly([&](const MotionBlock& block) { writer.write(block); }, progress);
        writer.finish(report.frames, report.copies);
    });
    return report;
}

TEST(CrowdInSections, HasThePosesAndSizesOfOneThatIsSimulatedAtOnce) {
    const SimulationResult sections = simulate(crowd(), loaded(), 1, go_on);
    const Motion& motion = sections.motion;
    EXPECT_EQ(section_count(motion), 2U);
    Simulation at_once = simulation_of(crowd(), loaded(), 1, 1);
    for (int frame = 0; frame < motion.frames(); ++frame) {
        at_once.advance_to(motion.times[static_cast<std::size_t>(frame)]);
        std::size_t number = 0;
        for (const BodyMotion& body : motion.bodies) {
            for (int copy = 0; copy < body.copies; ++copy, ++number) {
                const Pose pose = at_once.pose(number);
                ASSERT_EQ(motion.pose(body, 0, frame, copy).position, pose.position) << copy;
                ASSERT_EQ(motion.pose(body, 0, frame, copy).velocity, pose.velocity) << copy;
                ASSERT_EQ(body.size(0, copy), at_once.size_of(number)) << copy;
            }
        }
    }
    EXPECT_EQ(sections.report.steps, at_once.steps());
    EXPECT_EQ(sections.report.highest_reynolds_number, at_once.report().highest_reynolds_number);
}

TEST(CrowdInSections, WrittenAsItFliesHasTheBytesOfOneWrittenWhole) {
    const test::TemporaryFolder folder;
    fly_into(folder / "sections.h5", go_on, 3);
    write_motion_file(folder / "whole.h5", simulate(crowd(), loaded(), 1, go_on).motion);
    EXPECT_EQ(read_bytes(folder / "sections.h5"), read_bytes(folder / "whole.h5"));
}

TEST(CrowdInSections, AnInterruptAfterTheFirstSectionLeavesItsCopies) {
    const test::TemporaryFolder folder;
    const SimulationReport report = fly_into(
        folder / "cut.h5", [](double done, double total) { return done < 0.96 * total; }, 1);
    EXPECT_TRUE(report.interrupted);
    EXPECT_EQ(report.frames, 3U);
    const Motion whole = simulate(crowd(), loaded(), 1, go_on).motion;
    const Motion cut = read_motion_file(folder / "cut.h5");
    const CopySpan first = copies_in_section(whole, whole.bodies[0], 0);
    ASSERT_EQ(static_cast<std::size_t>(cut.bodies[0].copies), first.count);
    EXPECT_LT(cut.bodies[0].copies, many);
    EXPECT_EQ(cut.bodies[1].copies, static_cast<int>(copies_in_section(whole, whole.bodies[1], 0).count));
    for (const int copy : {0, cut.bodies[0].copies - 1}) {
        EXPECT_EQ(cut.pose(cut.bodies[0], 0, 2, copy).position,
                  whole.pose(whole.bodies[0], 0, 2, copy).position);
        EXPECT_EQ(cut.bodies[0].size(0, copy), whole.bodies[0].size(0, copy));
    }
}

TEST(CrowdInSections, OfBodiesThatCollideIsSimulatedTogether) {
    Scene scene = crowd();
    scene.bodies_collide = true;
    scene.duration = 0.0;
    for (SceneBody& body : scene.bodies) body.smallest_size = body.largest_size = 1.0;
    SceneSimulation simulation(scene, loaded(), 1);
    std::size_t blocks = 0;
    simulation.fly(
        [&](const MotionBlock& block) {
            ++blocks;
            EXPECT_EQ(block.copies.count, static_cast<std::size_t>(scene.bodies[block.body].count));
        },
        go_on);
    EXPECT_EQ(blocks, 2U);
}

}  // namespace
}  // namespace samara
