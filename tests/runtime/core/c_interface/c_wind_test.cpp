// A caller's wind.
#include <cmath>
#include <cstddef>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/c_interface_calls.hpp"
#include "samara/core/simulation/simulation.hpp"

namespace samara {
namespace {

using test::BodyOnDisk;
using test::default_settings;
using test::poses_at;
using test::rubber_group;
using test::same_bytes;
using test::simulation_of;
using test::SimulationPointer;
using test::Text;

constexpr double turning = 2.0;  // 1/s

/// A wind that rotates about the vertical, and pulsates.
void whirl(void* context, double time, std::size_t count, const double* places, double* velocities) {
    const double strength = *static_cast<const double*>(context) * (1.0 + 0.2 * std::sin(3.0 * time));
    for (std::size_t i = 0; i < count; ++i) {
        velocities[3 * i] = -strength * places[3 * i + 1];
        velocities[3 * i + 1] = strength * places[3 * i];
        velocities[3 * i + 2] = 0.0;
    }
}

samara_settings whirling(double* strength, std::int32_t threads = 1) {
    samara_settings settings = default_settings();
    settings.wind = whirl;
    settings.wind_context = strength;
    settings.threads = threads;
    return settings;
}

TEST(CWind, MovesTheBodiesAsTheFlightsOwnFunction) {
    const BodyOnDisk body;
    double strength = turning;
    const SimulationPointer simulation = simulation_of(body, rubber_group(40), whirling(&strength));
    const auto poses = poses_at(simulation, 0.5);
    SimulationSettings settings;
    settings.wind.function = whirl;
    settings.wind.function_context = &strength;
    Simulation core(settings);
    BodyPhysics physics;
    physics.mass.density = 1200.0;
    Release release{.orientation = Quaterniond(0.8, 0.0, -0.6, 0.0),
                    .count = 40,
                    .spread_position = Vector3d(0.1, 0.0, 0.0),
                    .spread_angle = 1.0};
    core.add(load_body_file(body.file()), physics, release);
    core.advance_to(0.5);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        EXPECT_EQ(Vector3d(poses[i].velocity), core.pose(i).velocity);
    }
    EXPECT_FALSE(same_bytes(poses, poses_at(simulation_of(body, rubber_group(40)), 0.5)));
}

TEST(CWind, IsTheSameForAnyTimesAndThreadsAndFromAState) {
    const BodyOnDisk body;
    double strength = turning;
    const SimulationPointer simulation = simulation_of(body, rubber_group(40), whirling(&strength));
    poses_at(simulation, 0.2);
    const std::string state = test::state_of(simulation);
    const auto poses = poses_at(simulation, 0.5);
    const SimulationPointer other = simulation_of(body, rubber_group(40), whirling(&strength, 4));
    for (const double time : {0.1, 0.201, 0.33}) poses_at(other, time);
    EXPECT_TRUE(same_bytes(poses_at(other, 0.5), poses));
    Text error;
    EXPECT_EQ(test::set_state(other, state, error), SAMARA_OK) << error.text();
    EXPECT_TRUE(same_bytes(poses_at(other, 0.5), poses));
    // One without a wind is another simulation.
    EXPECT_EQ(test::set_state(simulation_of(body, rubber_group(40)), state, error), SAMARA_FOREIGN_STATE);
}

TEST(CWind, ThatGivesNoNumberStopsTheSimulationAndAStateBringsItBack) {
    const BodyOnDisk body;
    double strength = turning;
    const SimulationPointer simulation = simulation_of(body, rubber_group(), whirling(&strength));
    poses_at(simulation, 0.1);
    const std::string state = test::state_of(simulation);
    const auto poses = poses_at(simulation, 0.2);
    strength = std::numeric_limits<double>::quiet_NaN();
    Text error;
    EXPECT_EQ(CALL(samara_advance_to, simulation.get(), 0.3), SAMARA_OUT_OF_RANGE);
    EXPECT_THAT(error.text(), testing::HasSubstr("the wind function returned a velocity"));
    EXPECT_EQ(CALL(samara_advance_to, simulation.get(), 0.3), SAMARA_OUT_OF_RANGE);
    strength = turning;
    EXPECT_EQ(test::set_state(simulation, state, error), SAMARA_OK);
    EXPECT_TRUE(same_bytes(poses_at(simulation, 0.2), poses));
}

TEST(CWind, IsNotReadFromTheSettingsOfAnOlderCaller) {
    samara_settings settings = default_settings();
    settings.size = offsetof(samara_settings, wind);
    double strength = std::numeric_limits<double>::quiet_NaN();
    settings.wind = whirl;
    settings.wind_context = &strength;
    const BodyOnDisk body;
    const auto poses = poses_at(simulation_of(body, rubber_group(), settings), 0.3);
    EXPECT_TRUE(same_bytes(poses, poses_at(simulation_of(body, rubber_group()), 0.3)));
}

}  // namespace
}  // namespace samara
