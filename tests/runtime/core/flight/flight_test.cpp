// Flight, the one class that flies bodies: for scenes, the C interface and C++ alike.
#include "samara/core/flight/flight.hpp"

#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/flight/body_group.hpp"
#include "samara/scene/simulation.hpp"
#include "support/compared_states.hpp"
#include "support/expect_error.hpp"
#include "support/known_bodies.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using testing::AllOf;
using testing::HasSubstr;

LoadedBody rubber() {
    return {test::rubber_ellipsoid(), "hash"};
}

BodyPhysics physics_of(double density) {
    BodyPhysics physics;
    physics.mass.density = density;
    physics.loads = Loads::coefficients;
    physics.turbulence = Turbulence::constant;
    physics.turbulent_kinetic_energy = 1e-3;
    physics.dissipation_rate = 1e-3;
    return physics;
}

FlightError::Kind fault_of(const std::function<void()>& work) {
    try {
        work();
    } catch (const FlightError& fault) {
        return fault.kind();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

TEST(Flight, NumbersTheCopiesOfARunTogether) {
    FlightSettings both;
    both.runs = 2;
    Flight flight(both);
    const BodyPhysics physics = physics_of(1200.0);
    EXPECT_EQ(flight.add(rubber(), physics, {.count = 3, .spread_angle = 1.0}, "a"), 0u);
    EXPECT_EQ(flight.add(rubber(), physics, {}, "b"), 6u);
    EXPECT_EQ(flight.size(), 8u);
    flight.advance_to(0.5);
    for (std::uint32_t run = 0; run < 2; ++run) {
        FlightSettings settings;
        settings.first_run = run;
        Flight alone(settings);
        alone.add(rubber(), physics, {.count = 3, .spread_angle = 1.0}, "a");
        alone.advance_to(0.5);
        for (std::size_t copy = 0; copy < 3; ++copy) {
            EXPECT_TRUE(test::same(flight.pose(std::size_t{3} * run + copy), alone.pose(copy)));
        }
    }
}

TEST(Flight, IsASceneToTheLastBit) {
    Scene scene;
    scene.duration = 0.7;
    scene.frame_rate = 37.0;
    scene.fluid.gust = {.amplitude = Vector3d(0.03, 0.0, 0.01), .period = 0.9};
    SceneBody body;
    static_cast<BodyPhysics&>(body) = physics_of(1100.0);
    body.name = "rubber";
    body.start = 0.1234;
    body.count = 2;
    body.spread_angle = 0.4;
    scene.bodies = {body};
    const Motion motion = simulate(scene, {rubber()}, 1, [](double, double) { return true; }).motion;
    Flight flight({.fluid = scene.fluid});
    flight.add(rubber(), body, body, "rubber");
    std::vector<Pose> poses(2);
    for (int frame = 0; frame < motion.frames(); ++frame) {
        flight.advance_to(motion.times[static_cast<std::size_t>(frame)]);
        flight.poses(0, 2, poses.data());
        for (int copy = 0; copy < 2; ++copy) {
            EXPECT_TRUE(test::same(poses[static_cast<std::size_t>(copy)],
                                   motion.pose(motion.bodies[0], 0, frame, copy)));
        }
    }
}

TEST(Flight, GoesOnFromAStateInAnotherFlightOfTheSameKind) {
    const auto made = [](double density) {
        Flight flight;
        flight.add(rubber(), physics_of(density), {.count = 2, .spread_angle = 1.0});
        return flight;
    };
    Flight first = made(1200.0);
    first.advance_to(0.31);
    const std::string state = first.state();
    EXPECT_EQ(state.size(), first.state_size());
    first.advance_to(0.8);
    Flight second = made(1200.0);
    second.set_state(state);
    EXPECT_EQ(second.time(), 0.31);
    second.advance_to(0.8);
    EXPECT_TRUE(test::same(first.pose(1), second.pose(1)));
    Flight other = made(1201.0);
    EXPECT_EQ(fault_of([&] { other.set_state(state); }), FlightError::Kind::foreign_state);
}

TEST(Flight, KindsOfOneBodyAndPhysicsShareWhatIsMadeOfThem) {
    const LoadedBody body = rubber();
    Flight flight;
    flight.add(body, physics_of(1200.0), {}, "a");
    flight.add(body, physics_of(1200.0), {.position = Vector3d(1.0, 0.0, 0.0)}, "b");
    flight.advance_to(0.1);
    EXPECT_EQ(&flight.kinds()[0]->body(), &flight.kinds()[1]->body());
}

TEST(Flight, TellsProgramsWhatWentWrong) {
    Flight flight;
    flight.add(rubber(), physics_of(1200.0), {}, "a");
    EXPECT_EQ(fault_of([&] { flight.add(rubber(), physics_of(1200.0), {}, "a"); }),
              FlightError::Kind::invalid_argument);
    flight.advance_to(1.0);
    EXPECT_EQ(fault_of([&] { flight.advance_to(0.5); }), FlightError::Kind::time_passed);
    EXPECT_EQ(fault_of([&] { flight.add(rubber(), physics_of(1200.0), {}, "b"); }),
              FlightError::Kind::invalid_argument);
    EXPECT_EQ(fault_of([] { Flight({.step = 0.0}); }), FlightError::Kind::invalid_argument);
}

TEST(Flight, TheExampleInCppRuns) {
    const test::TemporaryFolder folder;
    const std::string program = std::string(SAMARA_EXAMPLES) + "/example-fall-cpp";
    const auto run = [&](const std::string& file) {
        return run_subprocess(
            {"/bin/sh", "-c", program + " '" + file + "' > " + (folder / "output").string() + " 2>&1"});
    };
    ASSERT_EQ(run(SAMARA_SOURCE_DIRECTORY "/runtime/bodies/leaf.body.h5"), 0)
        << read_bytes(folder / "output");
    EXPECT_THAT(read_bytes(folder / "output"), AllOf(HasSubstr("1.0000 s  leaf 2"), HasSubstr("3000 steps")));
    EXPECT_EQ(run("missing.body.h5"), 1);
    EXPECT_THAT(read_bytes(folder / "output"),
                AllOf(testing::StartsWith("fall: "), HasSubstr("missing.body.h5")));
}

}  // namespace
}  // namespace samara
