// Simulation, the one class that simulates bodies: for scenes, the C interface and C++ alike.
#include "samara/core/simulation/simulation.hpp"

#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/simulation/body_group.hpp"
#include "samara/scene/scene_simulation.hpp"
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

SimulationError::Reason error_of(const std::function<void()>& work) {
    try {
        work();
    } catch (const SimulationError& error) {
        return error.reason();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

/// Advances to a time within budgets, the first of which are of no time: one step a call. Returns the calls.
int advance_by_budgets(Simulation& simulation, double time) {
    int calls = 0;
    for (; simulation.time() < time; ++calls) simulation.advance_within(time, calls < 20 ? 0.0 : 1e3);
    return calls;
}

TEST(Simulation, ABudgetLeavesStepsButNeverChangesThem) {
    for (const bool collide : {false, true}) {
        SimulationSettings settings;
        settings.bodies_collide = collide;
        Simulation whole(settings);
        Simulation parts(settings);
        for (Simulation* simulation : {&whole, &parts}) {
            simulation->add(rubber(), physics_of(1200.0), {.count = 3, .spread_position = {0.2, 0.2, 0.2}},
                            "a");
            simulation->add_wrench(1, {{0.0, 0.01, 0.0}, {1e-5, 0.0, 0.0}});
        }
        whole.advance_to(0.1);
        parts.advance_within(0.1, 0.0);
        EXPECT_DOUBLE_EQ(parts.time(), settings.step);
        parts.add_wrench(1, {{0.0, 0.01, 0.0}, {1e-5, 0.0, 0.0}});
        parts.advance_within(0.1, 1e3);
        EXPECT_EQ(parts.time(), 0.1);
        whole.advance_to(0.2);
        EXPECT_EQ(advance_by_budgets(parts, 0.2), 21);
        whole.advance_to(0.2123);
        parts.advance_within(0.2123, 0.0);  // between two steps: of the seven that are left one is taken
        EXPECT_LT(parts.time(), 0.2123);
        advance_by_budgets(parts, 0.2123);
        EXPECT_EQ(parts.time(), 0.2123);
        for (std::size_t i = 0; i < whole.size(); ++i) {
            EXPECT_EQ(parts.pose(i).position, whole.pose(i).position) << i << " " << collide;
            EXPECT_EQ(parts.pose(i).velocity, whole.pose(i).velocity) << i << " " << collide;
        }
    }
}

TEST(Simulation, NumbersTheCopiesOfARunTogether) {
    SimulationSettings both;
    both.runs = 2;
    Simulation simulation(both);
    const BodyPhysics physics = physics_of(1200.0);
    EXPECT_EQ(simulation.add(rubber(), physics, {.count = 3, .spread_angle = 1.0}, "a"), 0u);
    EXPECT_EQ(simulation.add(rubber(), physics, {}, "b"), 6u);
    EXPECT_EQ(simulation.size(), 8u);
    simulation.advance_to(0.5);
    for (std::uint32_t run = 0; run < 2; ++run) {
        SimulationSettings settings;
        settings.first_run = run;
        Simulation alone(settings);
        alone.add(rubber(), physics, {.count = 3, .spread_angle = 1.0}, "a");
        alone.advance_to(0.5);
        for (std::size_t copy = 0; copy < 3; ++copy) {
            EXPECT_TRUE(test::same(simulation.pose(std::size_t{3} * run + copy), alone.pose(copy)));
        }
    }
}

TEST(Simulation, IsASceneToTheLastBit) {
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
    Simulation simulation({.fluid = scene.fluid});
    simulation.add(rubber(), body, body, "rubber");
    std::vector<Pose> poses(2);
    for (int frame = 0; frame < motion.frames(); ++frame) {
        simulation.advance_to(motion.times[static_cast<std::size_t>(frame)]);
        simulation.poses(0, 2, poses.data());
        for (int copy = 0; copy < 2; ++copy) {
            EXPECT_TRUE(test::same(poses[static_cast<std::size_t>(copy)],
                                   motion.pose(motion.bodies[0], 0, frame, copy)));
        }
    }
}

TEST(Simulation, GoesOnFromAStateInAnotherFlightOfTheSameKind) {
    const auto made = [](double density) {
        Simulation simulation;
        simulation.add(rubber(), physics_of(density), {.count = 2, .spread_angle = 1.0});
        return simulation;
    };
    Simulation first = made(1200.0);
    first.advance_to(0.31);
    const std::string state = first.state();
    EXPECT_EQ(state.size(), first.state_size());
    first.advance_to(0.8);
    Simulation second = made(1200.0);
    second.set_state(state);
    EXPECT_EQ(second.time(), 0.31);
    second.advance_to(0.8);
    EXPECT_TRUE(test::same(first.pose(1), second.pose(1)));
    Simulation other = made(1201.0);
    EXPECT_EQ(error_of([&] { other.set_state(state); }), SimulationError::Reason::foreign_state);
}

TEST(Simulation, KeepsItsPrecision) {
    const auto made = [](Precision precision) {
        Simulation simulation({.precision = precision});
        simulation.add(rubber(), physics_of(1200.0), {.count = 20, .spread_angle = 1.0});
        return simulation;
    };
    Simulation first = made(Precision::single_precision);
    first.advance_to(0.31);
    const std::string state = first.state();
    first.advance_to(0.8);
    Simulation second = made(Precision::single_precision);
    second.set_state(state);
    for (const double time : {0.4, 0.401, 0.8}) second.advance_to(time);
    Simulation other = made(Precision::double_precision);
    EXPECT_EQ(error_of([&] { other.set_state(state); }), SimulationError::Reason::foreign_state);
    other.advance_to(0.8);
    for (std::size_t i = 0; i < 20; ++i) {
        EXPECT_TRUE(test::same(first.pose(i), second.pose(i)));
        EXPECT_FALSE(test::same(first.pose(i), other.pose(i)));
        EXPECT_LT((first.pose(i).position - other.pose(i).position).norm(), 1e-3);
    }
    EXPECT_EQ(
        error_of([] { Simulation({.bodies_collide = true, .precision = Precision::single_precision}); }),
        SimulationError::Reason::invalid_argument);
}

TEST(Simulation, KindsOfOneBodyAndPhysicsShareWhatIsMadeOfThem) {
    const LoadedBody body = rubber();
    Simulation simulation;
    simulation.add(body, physics_of(1200.0), {}, "a");
    simulation.add(body, physics_of(1200.0), {.position = Vector3d(1.0, 0.0, 0.0)}, "b");
    simulation.advance_to(0.1);
    EXPECT_EQ(&simulation.groups()[0]->body(), &simulation.groups()[1]->body());
}

TEST(Simulation, TellsProgramsWhatWentWrong) {
    Simulation simulation;
    simulation.add(rubber(), physics_of(1200.0), {}, "a");
    EXPECT_EQ(error_of([&] { simulation.add(rubber(), physics_of(1200.0), {}, "a"); }),
              SimulationError::Reason::invalid_argument);
    simulation.advance_to(1.0);
    EXPECT_EQ(error_of([&] { simulation.advance_to(0.5); }), SimulationError::Reason::time_passed);
    EXPECT_EQ(error_of([&] { simulation.add(rubber(), physics_of(1200.0), {}, "b"); }),
              SimulationError::Reason::invalid_argument);
    EXPECT_EQ(error_of([] { Simulation({.step = 0.0}); }), SimulationError::Reason::invalid_argument);
}

TEST(Simulation, TheExampleInCppRuns) {
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
