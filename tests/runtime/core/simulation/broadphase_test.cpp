// Bodies that collide: exact cases, and what a collision depends on.
#include "samara/core/simulation/broadphase.hpp"

#include <chrono>
#include <cmath>
#include <ctime>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "samara/kirchhoff/kirchhoff_solver.hpp"
#include "samara/scene/ready_bodies.hpp"
#include "support/colliding_bodies.hpp"
#include "support/compared_states.hpp"
#include "support/ground_bodies.hpp"
#include "support/known_bodies.hpp"
#include "support/program_run.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

constexpr double gravity = 9.81;
constexpr double steps[] = {0.002, 1.0 / 60.0, 1.0 / 24.0};

LoadedBody ball() {
    static const LoadedBody body = test::body_of(test::ellipsoid(Vector3d::Constant(0.01), 4));
    return body;
}

LoadedBody block() {
    static const LoadedBody body = test::body_of(test::box({0.04, 0.03, 0.01}, 2));
    return body;
}

LoadedBody card() {
    static const LoadedBody body = test::body_of(test::box({0.06, 0.09, 0.0003}, 2));
    return body;
}

SimulationSettings on_ground(double step) {
    SimulationSettings settings = test::colliding_in_vacuum(gravity, step);
    settings.ground = 0.0;
    return settings;
}

Quaterniond turned(double angle, const Vector3d& axis) {
    return Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
}

Vector3d momentum_of(const Simulation& simulation) {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < simulation.size(); ++i)
        sum += simulation.mass(i) * simulation.pose(i).velocity;
    return sum;
}

/// Of bodies alone, about the origin.
Vector3d angular_momentum_of(const Simulation& simulation) {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < simulation.size(); ++i) {
        const Pose pose = simulation.pose(i);
        const Vector3d own = pose.orientation.conjugate() * pose.angular_velocity;
        sum += simulation.mass(i) * pose.position.cross(pose.velocity) +
               pose.orientation * (simulation.inertia(i) * own);
    }
    return sum;
}

TEST(Broadphase, BallsThatMeetHeadOnGoOnTogether) {
    for (const double step : steps) {
        Simulation simulation(test::colliding_in_vacuum(0.0, step));
        simulation.add(ball(), test::without_fluid(2000.0),
                       {.position = {-0.05, 0, 0}, .velocity = {1.0, 0, 0}}, "a");
        simulation.add(ball(), test::without_fluid(500.0),
                       {.position = {0.05, 0, 0}, .velocity = {-0.5, 0, 0}}, "b");
        const double momentum = momentum_of(simulation).x();
        simulation.advance_to(0.5);
        // Without restitution, as on the ground: (4 * 1 - 0.5)/5.
        EXPECT_NEAR(simulation.pose(0).velocity.x(), 0.7, 1e-6);
        EXPECT_NEAR(simulation.pose(1).velocity.x(), 0.7, 1e-6);
        EXPECT_NEAR(momentum_of(simulation).x(), momentum, 1e-12 * momentum);
        const double apart = simulation.pose(1).position.x() - simulation.pose(0).position.x();
        EXPECT_NEAR(apart, 0.02, 3e-5);
        EXPECT_EQ(test::deepest_overlap(simulation), 0.0);
    }
}

TEST(Broadphase, AnImpactAskewKeepsMomentumAndAngularMomentumAndTakesEnergy) {
    for (const double step : steps) {
        Simulation simulation(test::colliding_in_vacuum(0.0, step));
        simulation.add(
            block(), test::without_fluid(700.0),
            {.position = {-0.1, 0.008, 0.0}, .velocity = {1.0, 0, 0}, .angular_velocity = {0, 0, 3.0}}, "a");
        simulation.add(block(), test::without_fluid(900.0),
                       {.position = {0.1, -0.008, 0.003},
                        .orientation = turned(0.5, {1, 2, 3}),
                        .velocity = {-1.0, 0, 0}},
                       "b");
        simulation.watch_contacts(true);
        const Vector3d momentum = momentum_of(simulation);
        const double energy = test::energy_of(simulation, 0.0);
        double missed = 0.0;  // of angular momentum, in the steps in which they touch
        for (double time = 0.0; time < 1.0; time += step) {
            const Vector3d angular = angular_momentum_of(simulation);
            simulation.advance_to(time + step);
            if (simulation.take_contacts(0).strongest == 0.0) continue;
            missed += (angular_momentum_of(simulation) - angular).norm();
        }
        const double scale = simulation.mass(0) * 1.0;
        EXPECT_LT((momentum_of(simulation) - momentum).norm(), 1e-12 * scale);
        EXPECT_GT(missed, 0.0);
        EXPECT_LT(missed, (step < 0.01 ? 1e-3 : 5e-3) * scale * 0.02) << step;
        EXPECT_LT(test::energy_of(simulation, 0.0), energy);
        EXPECT_EQ(test::deepest_overlap(simulation), 0.0);
    }
}

TEST(Broadphase, TheFluidThatBodiesCarryMeetsWithThem) {
    // A ball's fluid is half of that it displaces.
    Body body = *test::body_of(test::ellipsoid(Vector3d::Constant(0.01), 3)).body;
    body.kirchhoff = kirchhoff_tensor(body.surface, body.moments);
    const LoadedBody wet(body, "");
    BodyPhysics physics = test::without_fluid(2000.0);
    physics.added_mass = true;
    BodyPhysics light = physics;
    light.mass.density = 100.0;
    SimulationSettings settings = test::colliding_in_vacuum(0.0, 0.002);
    settings.fluid.density = 1000.0;
    Simulation simulation(settings);
    simulation.add(wet, physics, {.position = {-0.05, 0, 0}, .velocity = {1.0, 0, 0}}, "a");
    simulation.add(wet, light, {.position = {0.05, 0, 0}}, "b");
    simulation.advance_to(0.4);
    EXPECT_NEAR(simulation.pose(0).velocity.x(), 2500.0 / (2500.0 + 600.0), 2e-3);
    // Balls of triangles are struck a little beside their middles: they go on together, rotating slowly.
    const double turning = simulation.pose(0).angular_velocity.norm();
    EXPECT_LT(turning, 2e-3);
    EXPECT_NEAR(simulation.pose(1).velocity.x(), simulation.pose(0).velocity.x(), turning * 0.01);
}

TEST(Broadphase, ABlockPushesAnotherAlongTheGroundUntilFrictionStopsBoth) {
    for (const double step : {0.0005, 0.002}) {
        Simulation simulation(on_ground(step));
        const Vector3d start(0.0, 0.0, 0.005);
        simulation.add(block(), test::without_fluid(700.0), {.position = start, .velocity = {1.0, 0, 0}},
                       "a");
        simulation.add(block(), test::without_fluid(700.0), {.position = start + Vector3d(0.06, 0, 0)}, "b");
        simulation.advance_to(1.0);
        // 0.02 m to the other with friction 0.5; half the velocity is left, and takes both to rest.
        const double square = 1.0 - 2.0 * 0.5 * gravity * 0.02;
        const double slide = 0.25 * square / (2.0 * 0.5 * gravity);
        EXPECT_NEAR(simulation.pose(1).position.x() - 0.06, slide, 0.5 * step + 0.02 * slide);
        EXPECT_NEAR(simulation.pose(1).position.x() - simulation.pose(0).position.x(), 0.04, 1e-4);
        EXPECT_TRUE(simulation.is_at_rest(0) && simulation.is_at_rest(1));
    }
}

TEST(Broadphase, AStackOfCardsStaysToTheLastBit) {
    for (const double step : steps) {
        Simulation simulation(on_ground(step));
        for (int i = 0; i < 6; ++i) {
            simulation.add(card(), test::without_fluid(700.0),
                           {.position = {0.002 * i, 0.0, 0.00016 + 0.00031 * i}},
                           "card-" + std::to_string(i));
        }
        simulation.advance_to(0.5);
        std::vector<Pose> poses(6);
        simulation.poses(0, 6, poses.data());
        simulation.advance_to(5.0);
        for (std::size_t i = 0; i < 6; ++i) {
            EXPECT_TRUE(simulation.is_at_rest(i));
            EXPECT_TRUE(test::same(simulation.pose(i), poses[i]));
            const double height = 0.00015 + 0.0003 * static_cast<double>(i);
            EXPECT_NEAR(simulation.pose(i).position.z(), height, 6e-5 * static_cast<double>(i + 1));
            EXPECT_NEAR(simulation.pose(i).position.x(), 0.002 * static_cast<double>(i), 1e-5);
        }
        EXPECT_EQ(test::deepest_overlap(simulation), 0.0);
    }
}

TEST(Broadphase, ACoinFallsOffAnothersEdgeWhereItsCentreIsBeyondIt) {
    const LoadedBody coin = test::body_of(test::disc(0.0125, 0.002));
    for (const double step : steps) {
        for (const double beyond : {-0.004, 0.004}) {
            Simulation simulation(on_ground(step));
            simulation.add(coin, test::without_fluid(8000.0), {.position = {0, 0, 0.001}}, "below");
            simulation.add(coin, test::without_fluid(8000.0), {.position = {0.0125 + beyond, 0, 0.00302}},
                           "above");
            simulation.advance_to(2.0);
            const double height = simulation.pose(1).position.z();
            const double tilt =
                std::acos(std::min(1.0, (simulation.pose(1).orientation * Vector3d::UnitZ()).z()));
            if (beyond < 0.0) {
                EXPECT_NEAR(height, 0.003, 3e-5) << step;
                EXPECT_LT(tilt, 1e-3);
            } else {
                EXPECT_LT(height, 0.0026) << step;
                EXPECT_GT(tilt, 0.1);
            }
            EXPECT_TRUE(simulation.is_at_rest(1)) << step << ' ' << beyond;
            EXPECT_GT(test::lowest_point(simulation, 1), -1e-6);
        }
    }
}

TEST(Broadphase, BodiesThatStartInsideEachOtherArePushedApartGently) {
    Simulation simulation(test::colliding_in_vacuum(0.0, 0.002));
    simulation.add(block(), test::without_fluid(700.0), {}, "a");
    simulation.add(block(), test::without_fluid(700.0), {.position = {0.01, 0.0, 0.006}}, "b");
    double way = 0.0;
    for (int i = 1; i <= 1000; ++i) {
        const double before = simulation.pose(1).position.z();
        simulation.advance_to(0.002 * i);
        way = std::max(way, std::abs(simulation.pose(1).position.z() - before));
    }
    EXPECT_EQ(test::deepest_overlap(simulation), 0.0);
    EXPECT_EQ(test::energy_of(simulation, 0.0), 0.0);
    EXPECT_LT(way, 0.001 * 0.025);  // of the radius, in a step
}

TEST(Broadphase, NothingPassesThroughAThinCardAtFilmSteps) {
    for (const double step : steps) {
        for (int i = 0; i < 12; ++i) {
            Simulation simulation(test::colliding_in_vacuum(0.0, step));
            const double turn = 0.5 * i;
            simulation.add(card(), test::without_fluid(700.0), {}, "wall");
            simulation.add(card(), test::without_fluid(700.0),
                           {.position = {0.003 * i - 0.01, 0.002, 0.5},
                            .orientation = turned(turn, {1.0, 0.3 * i, 0.2}),
                            .velocity = {0, 0, -12.0},
                            .angular_velocity = {2.0 * i, 3.0, -1.0}},
                           "thrown");
            bool met = false;
            simulation.watch_contacts(true);
            for (double time = 0.0; time < 0.2; time += step) {
                simulation.advance_to(time + step);
                met = met || simulation.take_contacts(1).strongest > 0.0;
                ASSERT_LT(test::deepest_overlap(simulation), 1e-9) << step << ' ' << i << ' ' << time;
            }
            EXPECT_TRUE(met);
            EXPECT_LT(simulation.pose(0).position.z(), -0.1);  // it was taken along
        }
    }
}

TEST(Broadphase, BesideAVortexWithACoreOfNoSizeAStepTakesBoundedWork) {
    SimulationSettings settings;
    settings.fluid = *fluid_preset("air");
    settings.ground = 0.0;
    settings.bodies_collide = true;
    settings.wind.vortices = {{.position = {0.01, 0.0, 0.0}, .circulation = 1e6, .core = 1e-12}};
    Simulation simulation(settings);
    simulation.add(
        load_body_file(ready_body_file("leaf")), BodyPhysics(),
        {.position = {0.0, 0.0, 0.3}, .count = 60, .spread_position = {0.04, 0.04, 0.1}, .spread_angle = 3.1},
        "leaf");
    const std::clock_t begin = std::clock();
    simulation.advance_to(0.02);
    EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 20.0) << "minutes without a bound";
    for (std::size_t i = 0; i < simulation.size(); ++i) EXPECT_TRUE(simulation.pose(i).position.allFinite());
}

TEST(Broadphase, WhatIsMetIsNotedOfBoth) {
    Simulation simulation(test::colliding_in_vacuum(0.0, 0.002));
    simulation.watch_contacts(true);
    simulation.add(ball(), test::without_fluid(2000.0), {.position = {-0.03, 0, 0}, .velocity = {1.0, 0, 0}},
                   "a");
    simulation.add(ball(), test::without_fluid(2000.0), {.position = {0.03, 0, 0}}, "b");
    simulation.advance_to(0.2);
    const ContactRecord first = simulation.take_contacts(0);
    const ContactRecord second = simulation.take_contacts(1);
    EXPECT_EQ(first.body, 1);
    EXPECT_EQ(second.body, 0);
    EXPECT_NEAR(first.impulse.x(), -0.5 * simulation.mass(0), 1e-6 * simulation.mass(0));
    EXPECT_LT((first.impulse + second.impulse).norm(), 1e-12 * simulation.mass(0));
    EXPECT_NEAR(first.normal.x(), -1.0, 1e-6);
}

TEST(Broadphase, WhatALoneBodyDoesIsWhatItDoesWithoutMeetings) {
    SimulationSettings settings = on_ground(0.002);
    settings.fluid = *fluid_preset("water");
    BodyPhysics physics = test::without_fluid(1200.0);
    physics.loads = Loads::coefficients;
    physics.turbulence = Turbulence::constant;
    physics.turbulent_kinetic_energy = 1e-3;
    physics.dissipation_rate = 1e-3;
    const Release release{
        .position = {0, 0, 0.5}, .start = 0.1, .count = 3, .spread_position = {3.0, 3.0, 0.1}};
    Simulation meeting(settings);
    meeting.add({test::rubber_ellipsoid(), ""}, physics, release, "a");
    settings.bodies_collide = false;
    Simulation alone(settings);
    alone.add({test::rubber_ellipsoid(), ""}, physics, release, "a");
    for (const double time : {0.37, 1.0, 3.0}) {
        meeting.advance_to(time);
        alone.advance_to(time);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(test::same(meeting.pose(i), alone.pose(i))) << time;
    }
}

/// Cards and balls that fall onto one place, in noise.
Simulation pile(int threads, int runs) {
    SimulationSettings settings = on_ground(0.002);
    settings.fluid = *fluid_preset("air");
    settings.threads = threads;
    settings.runs = runs;
    Simulation simulation(settings);
    BodyPhysics physics = test::without_fluid(700.0);
    physics.loads = Loads::coefficients;
    physics.turbulence = Turbulence::constant;
    physics.turbulent_kinetic_energy = 1e-2;
    physics.dissipation_rate = 1e-2;
    simulation.add(
        card(), physics,
        {.position = {0, 0, 0.2}, .count = 4, .spread_position = {0.02, 0.02, 0.1}, .spread_angle = 3.0},
        "card");
    simulation.add(ball(), physics,
                   {.position = {0, 0, 0.3},
                    .start = 0.0131,
                    .count = 4,
                    .spread_position = {0.02, 0.02, 0.1},
                    .spread_start = 0.2},
                   "ball");
    return simulation;
}

TEST(Broadphase, AStepBesideAVortexWithoutACoreHasAnEnd) {
    const test::TemporaryFolder folder;
    std::string text =
        "[scene]\nduration = 0.02\nstep = 0.002\nbodies_meet = true\n[fluid]\npreset = \"water\"\n"
        "[[wind.vortex]]\nkind = \"rankine\"\nposition = [-0.011, 0, 0]\naxis = [0, 0, 1]\n"
        "circulation = 1.0\ncore = 1e-12\n";
    for (const char* place : {"-0.011", "0.011"}) {
        text += fmt::format(
            "[[body]]\nname = \"at{1}\"\nshape = \"samara:cube\"\ndensity = 1200\n"
            "position = [{0}, 0, 0]\n",
            place, place[0] == '-' ? "left" : "right");
    }
    (void)folder.file("scene.toml", text);
    const auto start = std::chrono::steady_clock::now();
    const test::ProgramRun run = run_program_in(folder, {"samara", "simulate", "scene.toml", "-o", "out.h5"});
    const std::chrono::duration<double> lasted = std::chrono::steady_clock::now() - start;
    EXPECT_LT(lasted.count(), 60.0) << "of ten steps";
    EXPECT_TRUE(run.status == 0 || test::is_one_line(run.error)) << run.error;
}

TEST(Broadphase, AreTheSameForAnyThreadsAndCalls) {
    Simulation one = pile(1, 3);
    Simulation three = pile(3, 3);
    one.advance_to(0.8);
    for (int i = 1; i <= 16; ++i) three.advance_to(0.05 * i);
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_TRUE(test::same(one.pose(i), three.pose(i)));
}

TEST(Broadphase, BodiesOfDifferentRunsNeverMeet) {
    Simulation all = pile(1, 3);
    Simulation first = pile(1, 1);
    all.advance_to(0.8);
    first.advance_to(0.8);
    for (std::size_t copy = 0; copy < 4; ++copy) {
        EXPECT_TRUE(test::same(all.pose(copy), first.pose(copy)));
        EXPECT_TRUE(test::same(all.pose(12 + copy), first.pose(4 + copy)));
    }
}

TEST(Broadphase, GoOnFromAState) {
    Simulation simulation = pile(1, 1);
    simulation.advance_to(0.3);
    const std::string state = simulation.state();
    simulation.advance_to(0.9);
    Simulation other = pile(1, 1);
    other.set_state(state);
    other.advance_to(0.9);
    for (std::size_t i = 0; i < simulation.size(); ++i)
        EXPECT_TRUE(test::same(simulation.pose(i), other.pose(i)));
}

TEST(Broadphase, WhatLiesOnABodyFallsWhereThatIsTakenAway) {
    Simulation simulation(on_ground(0.002));
    simulation.add(block(), test::without_fluid(700.0), {.position = {0, 0, 0.0051}}, "below");
    simulation.add(block(), test::without_fluid(700.0), {.position = {0, 0, 0.0152}}, "above");
    simulation.advance_to(1.0);
    ASSERT_TRUE(simulation.is_at_rest(1));
    simulation.remove(0);
    simulation.advance_to(2.0);
    EXPECT_NEAR(simulation.pose(1).position.z(), 0.005, 1e-5);
}

TEST(Broadphase, BodiesMeetOnObstaclesToo) {
    SimulationSettings settings = test::colliding_in_vacuum(gravity, 0.002);
    Obstacle shelf;
    shelf.name = "shelf";
    shelf.surface = test::box({0.2, 0.2, 0.02}, 1);
    settings.obstacles.push_back(shelf);
    Simulation simulation(settings);
    for (int i = 0; i < 3; ++i) {
        simulation.add(block(), test::without_fluid(700.0), {.position = {0.002 * i, 0, 0.0152 + 0.0102 * i}},
                       "block-" + std::to_string(i));
    }
    simulation.advance_to(1.0);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_TRUE(simulation.is_at_rest(i));
        EXPECT_NEAR(simulation.pose(i).position.z(), 0.015 + 0.01 * static_cast<double>(i), 2e-4);
    }
}

}  // namespace
}  // namespace samara
