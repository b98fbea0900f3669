// A wind in a simulation: the same whatever is asked for, saved and restored.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/scene/scene_simulation.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

using testing::HasSubstr;

LoadedBody rubber() {
    Body body = test::rubber_ellipsoid();
    body.tables = test::blunt_tables(body, 4);
    return {body, "hash"};
}

BodyPhysics physics() {
    BodyPhysics physics;
    physics.mass.density = 1050.0;
    return physics;
}

Release several() {
    return {.position = Vector3d(0.0, 0.0, 1.0),
            .count = 20,
            .spread_position = Vector3d(0.5, 0.5, 0.2),
            .spread_angle = 2.0};
}

Wind windy() {
    Wind wind;
    wind.velocity = Vector3d(0.4, 0.0, 0.0);
    wind.profile = WindProfile{.height = 1.0, .ground = -3.0};
    wind.gusts = WindGusts{.rms = 0.1, .length = 0.5};
    wind.vortices.push_back({.circulation = 0.3, .core = 0.2});
    return wind;
}

SimulationSettings settings_with(const Wind& wind, int threads = 1) {
    SimulationSettings settings;
    settings.wind = wind;
    settings.threads = threads;
    return settings;
}

Simulation simulation_in(const SimulationSettings& settings) {
    Simulation simulation(settings);
    simulation.add(rubber(), physics(), several());
    return simulation;
}

std::vector<double> poses_of(const Simulation& simulation) {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < simulation.size(); ++i) {
        const Pose pose = simulation.pose(i);
        for (const double number : pose.position) numbers.push_back(number);
        for (const double number : pose.orientation.coeffs()) numbers.push_back(number);
        for (const double number : pose.velocity) numbers.push_back(number);
        for (const double number : pose.angular_velocity) numbers.push_back(number);
    }
    return numbers;
}

std::vector<double> flown(const SimulationSettings& settings, double time = 0.5) {
    Simulation simulation = simulation_in(settings);
    simulation.advance_to(time);
    return poses_of(simulation);
}

TEST(WindFlight, AUniformSteadyWindGivesTheBytesOfACurrent) {
    Wind wind;
    wind.velocity = Vector3d(0.31, -0.17, 0.05);
    SimulationSettings current;
    current.fluid.current = wind.velocity;
    EXPECT_EQ(flown(settings_with(wind)), flown(current));
    EXPECT_NE(flown(settings_with(wind)), flown({}));
}

TEST(WindFlight, IsTheSameForAnyTimesAndThreads) {
    const std::vector<double> expected = flown(settings_with(windy()));
    EXPECT_EQ(flown(settings_with(windy(), 3)), expected);
    Simulation often = simulation_in(settings_with(windy()));
    for (int frame = 1; frame <= 12; ++frame) often.advance_to(frame / 24.0);
    EXPECT_EQ(poses_of(often), expected);
}

TEST(WindFlight, GoesOnFromAStateToTheSameBytes) {
    Simulation simulation = simulation_in(settings_with(windy()));
    simulation.advance_to(0.2);
    const std::string state = simulation.state();
    simulation.advance_to(0.5);
    Simulation other = simulation_in(settings_with(windy()));
    other.set_state(state);
    other.advance_to(0.5);
    EXPECT_EQ(poses_of(other), poses_of(simulation));
}

TEST(WindFlight, AStateIsThatOfItsWindAlone) {
    Simulation simulation = simulation_in(settings_with(windy()));
    const std::string state = simulation.state();
    std::vector<Wind> others(6, windy());
    others[0] = {};
    others[1].velocity.x() = 0.5;
    others[2].profile->roughness = 0.04;
    others[3].gusts->seed = 2;
    others[4].vortices[0].circulation = 0.4;
    others[5].fans.push_back({});
    for (const Wind& wind : others) {
        Simulation other = simulation_in(settings_with(wind));
        EXPECT_THROW(other.set_state(state), SimulationError);
    }
}

TEST(WindFlight, GustsAreOfTheFlightsSeedUnlessTheyHaveTheirOwn) {
    SimulationSettings one = settings_with(windy());
    SimulationSettings two = one;
    two.seed = 2;
    EXPECT_NE(flown(one), flown(two));
    Wind same = windy();
    same.gusts->seed = 1;
    EXPECT_EQ(flown(settings_with(same)), flown(one));
}

TEST(WindFlight, ReynoldsNumbersAreOfTheVelocityInTheWind) {
    // Carried along by a wind ten times as fast as it falls.
    Wind fast;
    fast.velocity = Vector3d(3.0, 0.0, 0.0);
    fast.profile = WindProfile{.law = WindProfile::Law::power, .exponent = 1e-9, .ground = -1e3};
    Release carried = several();
    carried.velocity = fast.velocity;
    Simulation in_wind(settings_with(fast));
    in_wind.add(rubber(), physics(), carried);
    in_wind.advance_to(0.3);
    Simulation still = simulation_in({});
    still.advance_to(0.3);
    EXPECT_NEAR(in_wind.report().highest_reynolds_number, still.report().highest_reynolds_number,
                1e-3 * still.report().highest_reynolds_number);
}

TEST(WindFlight, AWindFunctionThatGivesNoNumberStopsTheFlight) {
    Wind wind;
    wind.function = [](void*, double time, std::size_t count, const double*, double* velocities) {
        if (time > 0.1) velocities[3 * count - 1] = std::numeric_limits<double>::quiet_NaN();
    };
    Simulation simulation = simulation_in(settings_with(wind));
    simulation.advance_to(0.09);
    try {
        simulation.advance_to(0.5);
        FAIL() << "nothing was thrown";
    } catch (const SimulationError& error) {
        EXPECT_EQ(error.reason(), SimulationError::Reason::out_of_range);
        EXPECT_THAT(error.what(), HasSubstr("the wind function returned a velocity"));
    }
    EXPECT_THROW(simulation.advance_to(0.6), SimulationError);
}

TEST(WindFlight, MovesWhatLiesOnTheGround) {
    SimulationSettings settings;
    settings.ground = 0.0;
    Release lying;
    lying.position = Vector3d(0.0, 0.0, 0.011);
    lying.orientation = Quaterniond(std::sqrt(0.5), 0.0, std::sqrt(0.5), 0.0);  // on its flat side
    const auto way = [&](double speed) {
        settings.wind = {};
        if (speed > 0.0) settings.wind.fans.push_back({.position = Vector3d(-0.3, 0.0, 0.0), .speed = speed});
        Simulation simulation(settings);
        simulation.add(rubber(), physics(), lying);
        simulation.advance_to(1.0);
        return simulation.pose(0).position.x();
    };
    const double still = way(0.0);
    EXPECT_NEAR(way(0.02), still, 1e-3);
    EXPECT_GT(way(1.0), still + 0.05);
}

}  // namespace
}  // namespace samara
