#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "c_interface_calls.hpp"
#include "samara.h"
#include "samara/kirchhoff/kirchhoff_solver.hpp"
#include "samara/scene/scene_simulation.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using namespace test;
using testing::HasSubstr;

constexpr double edge = 0.02;  // m

Body cube() {
    Body body;
    body.name = "cube";
    body.source = "invented";
    body.surface = test::box({edge, edge, edge}, 2);
    body.moments = moments_of(body.surface);
    body.kirchhoff = kirchhoff_tensor(body.surface, body.moments);
    return body;
}

const BodyOnDisk& cube_on_disk() {
    static const BodyOnDisk body(cube());
    return body;
}

samara_settings settings_with_ground(double height) {
    samara_settings settings = default_settings();
    settings.has_ground = 1;
    settings.ground = height;
    return settings;
}

/// A cube that is heavier than water, tilted, its centre `height` (m) above 0.
samara_body_group cube_group(double height) {
    samara_body_group group;
    EXPECT_EQ(samara_default_body_group(&group, sizeof group, nullptr, 0), SAMARA_OK);
    group.density = 1500.0;
    group.loads = SAMARA_LOADS_COEFFICIENTS;
    const Quaterniond tilted(Eigen::AngleAxisd(0.5, Vector3d(1.0, 2.0, 0.5).normalized()));
    group.orientation[0] = tilted.w();
    std::copy_n(tilted.vec().data(), 3, &group.orientation[1]);
    group.position[2] = height;
    return group;
}

double lowest_corner(const samara_pose& pose) {
    const auto& q = pose.orientation;
    const Matrix3d to_world = Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
    return pose.position[2] - 0.5 * edge * to_world.row(2).cwiseAbs().sum();
}

TEST(CGround, ACubeSettlesOnItAndLiesStill) {
    samara_settings settings = settings_with_ground(-0.1);
    settings.current[0] = 0.02;
    const SimulationPointer simulation = simulation_of(cube_on_disk(), cube_group(0.0), settings);
    for (int frame = 1; frame <= 6 * 24; ++frame) {
        ASSERT_GT(lowest_corner(poses_at(simulation, frame / 24.0)[0]), -0.1 - 1e-4 * edge) << frame;
    }
    const samara_pose lying = poses_of(simulation)[0];
    EXPECT_NEAR(lowest_corner(lying), -0.1, 1e-4 * edge);
    EXPECT_NEAR(lying.position[2], -0.1 + 0.5 * edge, 1e-3 * edge);  // on a face
    const samara_pose later = poses_at(simulation, 20.0)[0];
    EXPECT_LT(Vector3d(later.velocity).norm(), 1e-15);
    EXPECT_EQ(Vector3d(later.angular_velocity).norm(), 0.0);
    EXPECT_LT((Vector3d(later.position) - Vector3d(lying.position)).norm(), 1e-14);
}

TEST(CGround, MovesAsTheSimulateCommandDoes) {
    Scene scene;
    scene.duration = 2.0;
    scene.frame_rate = 30.0;
    scene.ground = -0.1;
    scene.fluid.gust = {.amplitude = Vector3d(0.03, 0.0, 0.01), .period = 0.9};
    SceneBody given = test::scene_body(1500.0);
    given.name = "cube";
    given.loads = Loads::coefficients;
    given.orientation =
        Quaterniond(Eigen::AngleAxisd(0.5, Vector3d(1.0, 2.0, 0.5).normalized())).normalized();
    scene.bodies.push_back(given);
    const Motion motion = simulate(scene, {{cube(), "hash"}}, 1, [](double, double) { return true; }).motion;

    samara_settings settings = settings_with_ground(-0.1);
    settings.gust_amplitude[0] = 0.03;
    settings.gust_amplitude[2] = 0.01;
    settings.gust_period = 0.9;
    const SimulationPointer simulation = simulation_of(cube_on_disk(), cube_group(0.0), settings);
    for (int frame = 0; frame < motion.frames(); ++frame) {
        const samara_pose pose = poses_at(simulation, motion.times[static_cast<std::size_t>(frame)])[0];
        const Pose& expected = motion.pose(motion.bodies[0], 0, frame, 0);
        EXPECT_EQ(Vector3d(pose.position), shape_origin(expected, motion.bodies[0].center_of_mass));
        EXPECT_EQ(Vector3d(pose.velocity), expected.velocity);
    }
}

TEST(CGround, AKindThatStartsBelowItIsRefusedAndNothingIsAdded) {
    const SimulationPointer simulation = empty_simulation(settings_with_ground(0.0));
    samara_body_group group = cube_group(0.0);
    Text error;
    EXPECT_EQ(CALL(samara_simulation_add, simulation.get(), cube_on_disk().get(), &group, nullptr),
              SAMARA_INVALID_ARGUMENT);
    EXPECT_THAT(error.text(), HasSubstr("'cube' starts 0.01"));
    EXPECT_THAT(error.text(), HasSubstr("below the ground at 0 m"));
    EXPECT_EQ(samara_simulation_count(simulation.get()), 0U);
    group = cube_group(0.1);
    EXPECT_EQ(CALL(samara_simulation_add, simulation.get(), cube_on_disk().get(), &group, nullptr),
              SAMARA_OK);
}

TEST(CGround, ABodyThatIsPutBelowItIsLiftedOntoIt) {
    const SimulationPointer simulation =
        simulation_of(cube_on_disk(), cube_group(0.1), settings_with_ground(0.0));
    std::vector<samara_pose> poses = poses_at(simulation, 0.1);
    poses[0].position[2] = -1.0;
    Text error;
    ASSERT_EQ(CALL(samara_set_poses, simulation.get(), 0, 1, poses.data(), 0), SAMARA_OK) << error.text();
    EXPECT_GT(lowest_corner(poses_at(simulation, 0.2)[0]), -1e-4 * edge);
}

TEST(CGround, ABodyAtRestWakesWhereItIsPutElsewhereOrPushed) {
    const SimulationPointer simulation =
        simulation_of(cube_on_disk(), cube_group(0.03), settings_with_ground(0.0));
    const samara_pose lying = poses_at(simulation, 6.0)[0];
    EXPECT_TRUE(same_bytes({lying}, poses_at(simulation, 8.0)));
    Text error;
    samara_pose pushed = lying;
    pushed.velocity[0] = 0.5;
    ASSERT_EQ(CALL(samara_set_poses, simulation.get(), 0, 1, &pushed, 0), SAMARA_OK) << error.text();
    EXPECT_GT(poses_at(simulation, 8.1)[0].position[0], lying.position[0] + 0.01);
    samara_pose lifted = lying;
    lifted.position[2] += 0.01;
    ASSERT_EQ(CALL(samara_set_poses, simulation.get(), 0, 1, &lifted, 0), SAMARA_OK) << error.text();
    EXPECT_LT(poses_at(simulation, 8.2)[0].position[2], lifted.position[2] - 1e-3);
    EXPECT_NEAR(poses_at(simulation, 12.0)[0].position[2], lying.position[2], 1e-5 * edge);
}

TEST(CGround, AStateSavedAtRestGoesOnToTheSameBytes) {
    const auto fresh = [] {
        return simulation_of(cube_on_disk(), cube_group(0.03), settings_with_ground(0.0));
    };
    const SimulationPointer simulation = fresh();
    poses_at(simulation, 6.0);
    const std::string saved = state_of(simulation);
    const SimulationPointer restored = fresh();
    Text error;
    ASSERT_EQ(set_state(restored, saved, error), SAMARA_OK) << error.text();
    EXPECT_TRUE(same_bytes(poses_at(simulation, 7.0), poses_at(restored, 7.0)));
    EXPECT_EQ(state_of(simulation), state_of(restored));
}

TEST(CGround, IsThereOnlyWhereItIsAskedForAndMustBeANumber) {
    samara_settings settings = default_settings();
    EXPECT_EQ(settings.has_ground, 0);
    settings.ground = -0.1;  // without has_ground it says nothing
    const SimulationPointer simulation = simulation_of(cube_on_disk(), cube_group(0.0), settings);
    EXPECT_LT(poses_at(simulation, 3.0)[0].position[2], -0.3);
    settings.has_ground = 1;
    settings.ground = std::numeric_limits<double>::quiet_NaN();
    samara_simulation* none = nullptr;
    Text error;
    EXPECT_EQ(CALL(samara_simulation_create, &settings, &none), SAMARA_INVALID_ARGUMENT);
    EXPECT_THAT(error.text(), HasSubstr("ground is not a finite number"));
}

TEST(CGround, AStateFitsTheSameGroundAlone) {
    const auto at = [](double height) {
        return simulation_of(cube_on_disk(), cube_group(0.0), settings_with_ground(height));
    };
    const SimulationPointer simulation = at(-0.1);
    poses_at(simulation, 0.5);
    const std::string state = state_of(simulation);
    Text error;
    EXPECT_EQ(set_state(at(-0.1), state, error), SAMARA_OK) << error.text();
    EXPECT_EQ(set_state(at(-0.2), state, error), SAMARA_FOREIGN_STATE);
    EXPECT_EQ(set_state(simulation_of(cube_on_disk(), cube_group(0.0)), state, error), SAMARA_FOREIGN_STATE);
}

TEST(CSimulation, AGustCarriesANeutralBodyExactlyBetweenStepsToo) {
    const BodyOnDisk body;
    samara_settings settings = default_settings();
    settings.gust_amplitude[0] = 0.3;
    settings.gust_period = 0.7;
    samara_body_group group = rubber_group();
    group.density = settings.fluid_density;
    group.turbulence = SAMARA_TURBULENCE_NONE;
    const SimulationPointer simulation = simulation_of(body, group, settings);
    for (int i = 1; i <= 100; ++i) {
        const double phase = 2.0 * std::numbers::pi * (0.0137 * i) / 0.7;
        const samara_pose pose = poses_at(simulation, 0.0137 * i)[0];
        EXPECT_NEAR(pose.velocity[0], 0.3 * std::sin(phase), 1e-12);
        if (i != 50) continue;
        Text error;
        const samara_pose still = pose;
        ASSERT_EQ(CALL(samara_set_poses, simulation.get(), 0, 1, &still, 0), SAMARA_OK);
        EXPECT_LT(std::abs(poses_of(simulation)[0].position[0] - still.position[0]), 1e-14);
    }
}

}  // namespace
}  // namespace samara
