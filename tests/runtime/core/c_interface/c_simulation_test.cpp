#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "c_interface_calls.hpp"
#include "samara.h"
#include "samara/scene/scene_simulation.hpp"

namespace samara {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

double distance(const double (&a)[3], const Vector3d& b) {
    return (Vector3d(a) - b).norm();
}

TEST(CSimulation, KindsHaveNamesOfTheirOwn) {
    const BodyOnDisk body;
    const SimulationPointer simulation = simulation_of(body, rubber_group(3));
    samara_body_group group = rubber_group(2);
    std::size_t first = 99;
    Text error;
    EXPECT_EQ(CALL(samara_simulation_add, simulation.get(), body.get(), &group, &first),
              SAMARA_INVALID_ARGUMENT);
    EXPECT_THAT(error.text(), HasSubstr("already has the name 'rubber'"));
    EXPECT_EQ(first, 99U);
    group.name = "other";
    EXPECT_EQ(CALL(samara_simulation_add, simulation.get(), body.get(), &group, &first), SAMARA_OK);
    EXPECT_EQ(first, 3U);
    EXPECT_EQ(samara_simulation_count(simulation.get()), 5U);
}

TEST(CSimulation, AnEmptyOneAdvances) {
    const SimulationPointer simulation = empty_simulation();
    EXPECT_TRUE(poses_at(simulation, 1.0).empty());
    EXPECT_EQ(samara_simulation_time(simulation.get()), 1.0);
}

TEST(CSimulation, BodiesAndStridesOutOfRangeAreRefused) {
    const BodyOnDisk body;
    const SimulationPointer simulation = simulation_of(body, rubber_group(3));
    std::vector<samara_pose> poses(3);
    Text error;
    const auto get = [&](std::size_t first, std::size_t count, std::size_t stride) {
        return CALL(samara_get_poses, simulation.get(), first, count, poses.data(), stride);
    };
    EXPECT_EQ(get(0, 3, 0), SAMARA_OK);
    EXPECT_EQ(get(3, 0, 0), SAMARA_OK);
    EXPECT_EQ(get(0, 4, 0), SAMARA_INVALID_ARGUMENT);
    EXPECT_EQ(get(4, 0, 0), SAMARA_INVALID_ARGUMENT);
    EXPECT_EQ(get(2, std::numeric_limits<std::size_t>::max(), 0), SAMARA_INVALID_ARGUMENT);
    EXPECT_THAT(error.text(), HasSubstr("there are 3"));
    EXPECT_EQ(get(0, 1, sizeof(samara_pose) - 8), SAMARA_INVALID_ARGUMENT);
    EXPECT_EQ(get(0, 1, sizeof(samara_pose) + 1), SAMARA_INVALID_ARGUMENT);
    EXPECT_THAT(error.text(), HasSubstr("stride"));
}

TEST(CSimulation, PosesMayLieApart) {
    const BodyOnDisk body;
    const SimulationPointer simulation = simulation_of(body, rubber_group(3));
    const std::vector<samara_pose> packed = poses_at(simulation, 0.1);
    struct Object {
        double other[3];
        samara_pose pose;
    };
    std::vector<Object> objects(2);
    Text error;
    ASSERT_EQ(CALL(samara_get_poses, simulation.get(), 1, 2, &objects[0].pose, sizeof(Object)), SAMARA_OK);
    EXPECT_TRUE(same_bytes({objects[0].pose, objects[1].pose}, {packed[1], packed[2]}));
    EXPECT_EQ(objects[1].other[0], 0.0);
}

TEST(CSimulation, TimesThatAreNoneAreRefused) {
    const BodyOnDisk body;
    const SimulationPointer simulation = simulation_of(body, rubber_group());
    const std::vector<samara_pose> before = poses_at(simulation, 0.5);
    Text error;
    EXPECT_EQ(CALL(samara_advance_to, simulation.get(), 0.4999), SAMARA_TIME_PASSED);
    EXPECT_THAT(error.text(), HasSubstr("0.4999"));
    EXPECT_EQ(CALL(samara_advance_to, simulation.get(), not_a_number), SAMARA_INVALID_ARGUMENT);
    EXPECT_EQ(CALL(samara_advance_to, simulation.get(), INFINITY), SAMARA_INVALID_ARGUMENT);
    EXPECT_EQ(CALL(samara_advance_to, simulation.get(), 1e9), SAMARA_INVALID_ARGUMENT);
    EXPECT_EQ(samara_simulation_time(simulation.get()), 0.5);
    EXPECT_TRUE(same_bytes(poses_at(simulation, 0.5), before));
}

TEST(CSimulation, ABudgetOfTimeEndsACallAfterAStepAndTheNextTakesUpTheRest) {
    const BodyOnDisk body;
    const SimulationPointer whole = simulation_of(body, rubber_group());
    const SimulationPointer parts = simulation_of(body, rubber_group());
    Text error;
    EXPECT_EQ(CALL(samara_advance_within, parts.get(), 0.5, 0.0), SAMARA_OK);
    EXPECT_GT(samara_simulation_time(parts.get()), 0.0);
    EXPECT_LT(samara_simulation_time(parts.get()), 0.5);
    EXPECT_EQ(CALL(samara_advance_within, parts.get(), 0.5, 1e3), SAMARA_OK);
    EXPECT_EQ(samara_simulation_time(parts.get()), 0.5);
    EXPECT_TRUE(same_bytes(poses_at(parts, 0.5), poses_at(whole, 0.5)));
    EXPECT_EQ(CALL(samara_advance_within, parts.get(), 0.6, -1.0), SAMARA_INVALID_ARGUMENT);
    EXPECT_THAT(error.text(), HasSubstr("seconds: -1"));
    EXPECT_EQ(CALL(samara_advance_within, parts.get(), 0.4, 1.0), SAMARA_TIME_PASSED);
}

TEST(CSimulation, TheTimesAskedForDoNotChangeTheMotion) {
    const BodyOnDisk body;
    const SimulationPointer once = simulation_of(body, rubber_group(3));
    const SimulationPointer film = simulation_of(body, rubber_group(3));
    const SimulationPointer display = simulation_of(body, rubber_group(3));
    const SimulationPointer irregular = simulation_of(body, rubber_group(3));
    const SimulationPointer steps = simulation_of(body, rubber_group(3));
    for (int i = 1; i <= 24; ++i) poses_at(film, i / 24.0);
    for (int i = 1; i <= 60; ++i) poses_at(display, i / 60.0);
    for (int i = 1; i <= 500; ++i) poses_at(steps, i * 0.002);
    for (const double time : {1e-9, 0.0013, 0.0013, 0.002, 0.1234567, 0.9, 0.99999})
        poses_at(irregular, time);
    // Between two steps, and after one.
    for (const double time : {1.0, 1.0007}) {
        const std::vector<samara_pose> poses = poses_at(once, time);
        for (const SimulationPointer* other : {&film, &display, &irregular, &steps}) {
            EXPECT_TRUE(same_bytes(poses, poses_at(*other, time)));
        }
    }
    EXPECT_EQ(state_of(once), state_of(film));
    EXPECT_EQ(state_of(once), state_of(display));
    EXPECT_EQ(state_of(once), state_of(irregular));
}

TEST(CSimulation, MovesAsTheSimulateCommandDoesToTheLastBit) {
    const BodyOnDisk on_disk;
    Scene scene;
    scene.duration = 1.0;
    scene.frame_rate = 24.0;
    scene.seed = 5;
    scene.fluid.current = Vector3d(0.1, 0.0, 0.02);
    SceneBody given = test::scene_body(1200.0);
    given.name = "rubber";
    given.turbulence = Turbulence::table;
    given.orientation = Quaterniond(0.8, 0.0, -0.6, 0.0);
    given.velocity = Vector3d(0.05, 0.0, 0.0);
    given.angular_velocity = Vector3d(1.0, 2.0, 3.0);
    given.start = 0.3;
    given.count = 2;
    given.spread_position = Vector3d(0.1, 0.0, 0.0);
    given.spread_angle = 1.0;
    scene.bodies.push_back(given);
    const Motion motion =
        simulate(scene, {{rubber(), "hash"}}, 2, [](double, double) { return true; }).motion;

    samara_settings settings = default_settings();
    settings.seed = 5;
    settings.run = 1;
    settings.current[0] = 0.1;
    settings.current[2] = 0.02;
    samara_body_group group = rubber_group(2);
    group.velocity[0] = 0.05;
    for (int i = 0; i < 3; ++i) group.angular_velocity[i] = i + 1;
    group.start = 0.3;
    const SimulationPointer simulation = simulation_of(on_disk, group, settings);
    for (int frame = 0; frame < motion.frames(); ++frame) {
        const std::vector<samara_pose> poses =
            poses_at(simulation, motion.times[static_cast<std::size_t>(frame)]);
        for (int copy = 0; copy < 2; ++copy) {
            const Pose& expected = motion.pose(motion.bodies[0], 1, frame, copy);
            const samara_pose& pose = poses[static_cast<std::size_t>(copy)];
            const auto& q = pose.orientation;
            const Quaterniond orientation(q[0], q[1], q[2], q[3]);
            EXPECT_EQ(Vector3d(pose.position), shape_origin(expected, motion.bodies[0].center_of_mass));
            EXPECT_EQ(orientation.coeffs(), expected.orientation.coeffs());
            EXPECT_EQ(Vector3d(pose.velocity), expected.velocity);
            EXPECT_EQ(Vector3d(pose.angular_velocity), expected.angular_velocity);
        }
    }
}

TEST(CSimulation, AStateSavedInTheMiddleGoesOnToTheSameBytes) {
    const BodyOnDisk body;
    const SimulationPointer whole = simulation_of(body, rubber_group(70));
    poses_at(whole, 0.3333);
    const std::string middle = state_of(whole);
    const std::vector<samara_pose> at_the_middle = poses_of(whole);
    const std::vector<samara_pose> end = poses_at(whole, 0.8);
    const std::string state_at_end = state_of(whole);

    // In the same simulation, back in time; and in another with other threads, seed and start.
    Text error;
    ASSERT_EQ(set_state(whole, middle, error), SAMARA_OK) << error.text();
    EXPECT_EQ(samara_simulation_time(whole.get()), 0.3333);
    EXPECT_TRUE(same_bytes(poses_of(whole), at_the_middle));
    EXPECT_TRUE(same_bytes(poses_at(whole, 0.8), end));
    samara_settings settings = default_settings();
    settings.seed = 77;
    settings.threads = 2;
    samara_body_group group = rubber_group(70);
    group.position[2] = 5.0;
    const SimulationPointer other = simulation_of(body, group, settings);
    ASSERT_EQ(set_state(other, middle, error), SAMARA_OK) << error.text();
    EXPECT_TRUE(same_bytes(poses_at(other, 0.8), end));
    EXPECT_EQ(state_of(other), state_at_end);
}

TEST(CSimulation, ForeignAndDamagedStatesAreRefusedAndChangeNothing) {
    const BodyOnDisk body;
    const SimulationPointer simulation = simulation_of(body, rubber_group(2));
    poses_at(simulation, 0.1);
    const std::string state = state_of(simulation);
    Text error;
    const auto rejected = [&](const std::string& bytes) {
        const bool is_rejected = set_state(simulation, bytes, error) == SAMARA_FOREIGN_STATE;
        return is_rejected && !error.text().empty() && state_of(simulation) == state;
    };
    for (std::size_t size = 0; size < state.size(); ++size)
        ASSERT_TRUE(rejected(state.substr(0, size))) << size;
    EXPECT_TRUE(rejected(state + "x"));
    for (std::size_t i = 0; i < state.size(); ++i) {
        std::string damaged = state;
        damaged[i] = static_cast<char>(damaged[i] ^ 4);
        ASSERT_TRUE(rejected(damaged)) << i;
    }
    const auto from_other = [&](const samara_body_group& group, const samara_settings& settings) {
        return state_of(simulation_of(body, group, settings));
    };
    samara_settings settings = default_settings();
    settings.step = 0.001;
    EXPECT_TRUE(rejected(from_other(rubber_group(2), settings)));
    EXPECT_THAT(error.text(), HasSubstr("other settings"));
    EXPECT_TRUE(rejected(from_other(rubber_group(3), default_settings())));
    samara_body_group group = rubber_group(2);
    group.density = 1300.0;
    EXPECT_TRUE(rejected(from_other(group, default_settings())));
    std::vector<char> small(state.size() - 1);
    EXPECT_EQ(CALL(samara_get_state, simulation.get(), small.data(), small.size()), SAMARA_INVALID_ARGUMENT);
    EXPECT_TRUE(set_state(simulation, state, error) == SAMARA_OK);
}

TEST(CSimulation, APoseThatIsSetIsThereAndTheFlightGoesOnFromIt) {
    const BodyOnDisk body;
    const SimulationPointer simulation = simulation_of(body, rubber_group(3));
    const SimulationPointer untouched = simulation_of(body, rubber_group(3));
    for (const double time : {0.0, 0.1, 0.2007}) {  // at the start, between two steps of the grid and at one
        poses_at(simulation, time);
        samara_pose pose{};
        pose.position[2] = 7.0;
        pose.orientation[0] = 1.6;
        pose.orientation[3] = -1.2;
        pose.velocity[0] = 0.3;
        pose.angular_velocity[1] = 2.0;
        Text error;
        ASSERT_EQ(CALL(samara_set_poses, simulation.get(), 1, 1, &pose, 0), SAMARA_OK) << error.text();
        const std::vector<samara_pose> poses = poses_of(simulation);
        EXPECT_LT(distance(poses[1].position, Vector3d(0.0, 0.0, 7.0)), 1e-14);
        EXPECT_NEAR(poses[1].orientation[0], 0.8, 1e-15);
        EXPECT_NEAR(poses[1].orientation[3], -0.6, 1e-15);
        EXPECT_LT(distance(poses[1].velocity, Vector3d(0.3, 0.0, 0.0)), 1e-14);
        EXPECT_LT(distance(poses[1].angular_velocity, Vector3d(0.0, 2.0, 0.0)), 1e-14);
        EXPECT_TRUE(same_bytes({poses[0], poses[2]}, {poses_at(untouched, time)[0], poses_of(untouched)[2]}));
        // A hundredth of a second on, it has moved by about its velocity.
        const std::vector<samara_pose> later = poses_at(simulation, time + 0.01);
        EXPECT_NEAR(later[1].position[0], 0.003, 5e-4);
        EXPECT_NEAR(later[1].position[2], 7.0, 5e-4);
    }
}

TEST(CSimulation, PosesThatAreNoneAreRefusedTogether) {
    const BodyOnDisk body;
    const SimulationPointer simulation = simulation_of(body, rubber_group(2));
    const std::vector<samara_pose> before = poses_at(simulation, 0.1);
    Text error;
    for (int member = 0; member < 13; ++member) {
        std::vector<samara_pose> poses = before;
        poses[0].position[2] += 1.0;
        reinterpret_cast<double*>(&poses[1])[member] = not_a_number;
        EXPECT_EQ(CALL(samara_set_poses, simulation.get(), 0, 2, poses.data(), 0), SAMARA_INVALID_ARGUMENT);
        EXPECT_THAT(error.text(), HasSubstr("body 1"));
    }
    std::vector<samara_pose> poses = before;
    for (double& number : poses[0].orientation) number = 0.0;
    EXPECT_EQ(CALL(samara_set_poses, simulation.get(), 0, 2, poses.data(), 0), SAMARA_INVALID_ARGUMENT);
    EXPECT_TRUE(same_bytes(poses_of(simulation), before));
}

TEST(CSimulation, ABodyIsHeldUntilItsStart) {
    const BodyOnDisk body;
    samara_body_group group = rubber_group();
    group.start = 0.5;
    group.velocity[0] = 1.0;
    const SimulationPointer simulation = simulation_of(body, group);
    const std::vector<samara_pose> first = poses_at(simulation, 0.0);
    EXPECT_EQ(first[0].velocity[0], 0.0);
    EXPECT_TRUE(same_bytes(poses_at(simulation, 0.4999), first));
    EXPECT_EQ(poses_at(simulation, 0.5)[0].velocity[0], 1.0);
    EXPECT_GT(poses_at(simulation, 0.51)[0].position[0], first[0].position[0] + 0.005);
}

TEST(CSimulation, AnotherSeedGivesAnotherMotionFromThenOn) {
    const BodyOnDisk body;
    const SimulationPointer a = simulation_of(body, rubber_group());
    const SimulationPointer b = simulation_of(body, rubber_group());
    EXPECT_TRUE(same_bytes(poses_at(a, 0.2), poses_at(b, 0.2)));
    Text error;
    ASSERT_EQ(CALL(samara_set_seed, b.get(), 1, 1), SAMARA_OK);
    EXPECT_TRUE(same_bytes(poses_of(a), poses_of(b)));
    EXPECT_FALSE(same_bytes(poses_at(a, 0.4), poses_at(b, 0.4)));
}

TEST(CSimulation, TwoThreadsOnTwoSimulationsGiveWhatOneGives) {
    const BodyOnDisk body;
    const auto fly = [&](double density, std::vector<samara_pose>& poses) {
        const BodyOnDisk own;
        samara_body_group group = rubber_group(4);
        group.density = density;
        const SimulationPointer simulation = simulation_of(own, group);
        for (int i = 1; i <= 50; ++i) poses = poses_at(simulation, i * 0.013);
    };
    std::array<std::vector<samara_pose>, 2> serial;
    std::array<std::vector<samara_pose>, 2> parallel;
    for (int round = 0; round < 3; ++round) {
        fly(1100.0, serial[0]);
        fly(1300.0, serial[1]);
        {
            const std::jthread first(fly, 1100.0, std::ref(parallel[0]));
            const std::jthread second(fly, 1300.0, std::ref(parallel[1]));
        }
        EXPECT_TRUE(same_bytes(serial[0], parallel[0]));
        EXPECT_TRUE(same_bytes(serial[1], parallel[1]));
    }
}

TEST(CSimulation, ReportsStepsAndReynoldsNumber) {
    const BodyOnDisk body;
    const SimulationPointer simulation = simulation_of(body, rubber_group(2));
    poses_at(simulation, 0.5);
    samara_report report;
    report.size = sizeof report;
    Text error;
    ASSERT_EQ(CALL(samara_get_report, simulation.get(), &report), SAMARA_OK) << error.text();
    EXPECT_EQ(report.steps, 500U);
    EXPECT_GE(report.substeps, report.steps);
    EXPECT_GE(report.most_substeps, 1);
    EXPECT_LE(report.most_substeps, 64);
    EXPECT_GT(report.highest_reynolds_number, 1e3);
    EXPECT_LT(report.highest_reynolds_number, 1e5);
    report.size = 0;
    EXPECT_EQ(CALL(samara_get_report, simulation.get(), &report), SAMARA_INVALID_ARGUMENT);
}

TEST(CSimulation, AMotionThatLeavesTheRangeOfNumbersStopsAndAStateBringsItBack) {
    const BodyOnDisk body;
    samara_settings settings = default_settings();
    settings.gravity[2] = -1e30;
    samara_body_group group = rubber_group();
    group.loads = SAMARA_LOADS_NONE;
    const SimulationPointer simulation = simulation_of(body, group, settings);
    const std::string start = state_of(simulation);
    Text error;
    EXPECT_EQ(CALL(samara_advance_to, simulation.get(), 10.0), SAMARA_OUT_OF_RANGE);
    EXPECT_THAT(error.text(), AllOf(HasSubstr("body 0"), HasSubstr("'rubber'")));
    EXPECT_EQ(CALL(samara_advance_to, simulation.get(), 20.0), SAMARA_OUT_OF_RANGE);
    samara_pose pose{};
    pose.orientation[0] = 1.0;
    EXPECT_EQ(CALL(samara_get_poses, simulation.get(), 0, 1, &pose, 0), SAMARA_OUT_OF_RANGE);
    EXPECT_EQ(CALL(samara_set_poses, simulation.get(), 0, 1, &pose, 0), SAMARA_OUT_OF_RANGE);
    std::string bytes(start.size(), '\0');
    EXPECT_EQ(CALL(samara_get_state, simulation.get(), bytes.data(), bytes.size()), SAMARA_OUT_OF_RANGE);
    EXPECT_EQ(set_state(simulation, start, error), SAMARA_OK);
    EXPECT_EQ(state_of(simulation), start);
    EXPECT_EQ(CALL(samara_advance_to, simulation.get(), 0.0), SAMARA_OK);
}

}  // namespace
}  // namespace samara
