// The needs of hosts: forces, impulses, removed bodies, contacts, the fluid's load.
#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/simulation/body_group.hpp"
#include "samara/core/simulation/simulation.hpp"
#include "support/compared_states.hpp"
#include "support/expect_error.hpp"
#include "support/known_bodies.hpp"
#include "support/obstacles.hpp"

namespace samara {
namespace {

using testing::HasSubstr;

const Vector3d no_gravity = Vector3d::Zero();

BodyPhysics ideal(double density = 1200.0) {
    BodyPhysics physics;
    physics.mass.density = density;
    physics.loads = Loads::none;
    physics.turbulence = Turbulence::none;
    return physics;
}

/// With drag and turbulence.
BodyPhysics stirred(double density = 1200.0) {
    BodyPhysics physics = ideal(density);
    physics.loads = Loads::coefficients;
    physics.turbulence = Turbulence::constant;
    physics.turbulent_kinetic_energy = 1e-3;
    physics.dissipation_rate = 1e-3;
    return physics;
}

LoadedBody ellipsoid() {
    return {test::rubber_ellipsoid(), "ellipsoid"};
}

/// A simulation of `count` ellipsoids without gravity.
Simulation floating(const BodyPhysics& physics, int count = 1) {
    Simulation simulation({.gravity = no_gravity});
    simulation.add(ellipsoid(), physics, {.count = count});
    return simulation;
}

/// K of the body and the fluid that is part of it (omega, v).
const Matrix6d& inertia_of(const Simulation& simulation) {
    return simulation.groups()[0]->body().inertia;
}

TEST(HostForce, MovesBodyAndFluidTogether) {
    for (int axis = 0; axis < 3; ++axis) {
        Simulation simulation = floating(ideal());
        const Vector3d force = 0.3 * Vector3d::Unit(axis);
        simulation.add_wrench(0, {.force = force});
        simulation.advance_to(0.5);
        const double inertia = inertia_of(simulation)(3 + axis, 3 + axis);
        EXPECT_NEAR((simulation.pose(0).velocity - 0.5 / inertia * force).norm(), 0.0, 1e-12);
        EXPECT_NEAR((simulation.pose(0).position - 0.125 / inertia * force).norm(), 0.0, 1e-12);
        EXPECT_GT(inertia, 1.1 * simulation.mass(0)) << "the fluid's part counts";
        simulation.advance_to(1.0);
        EXPECT_NEAR((simulation.pose(0).velocity - 0.5 / inertia * force).norm(), 0.0, 1e-12) << "it is gone";
    }
}

TEST(HostForce, AsAMomentTurnsBodyAndFluidTogether) {
    Simulation simulation = floating(ideal());
    simulation.add_wrench(0, {.moment = Vector3d(0.0, 1e-3, 0.0)});
    simulation.add_wrench(0, {.moment = Vector3d(0.0, 2e-3, 0.0)});
    simulation.advance_to(0.2);
    EXPECT_NEAR(simulation.pose(0).angular_velocity.y(), 3e-3 * 0.2 / inertia_of(simulation)(1, 1), 1e-12)
        << "several add up";
}

TEST(HostForce, ThatBalancesTheWeightHoldsABodyStillOffItsCentre) {
    BodyPhysics physics = stirred();
    physics.turbulence = Turbulence::none;
    physics.mass.density.reset();
    physics.mass.mass = 0.05;
    physics.mass.center_of_mass = Vector3d(0.002, -0.003, 0.004);
    Simulation simulation;
    simulation.add(ellipsoid(), physics, {});
    const ImmersedBody& body = simulation.groups()[0]->body();
    const Vector3d lift(0.0, 0.0, 9.81 * body.fluid_density * body.volume);
    const Pose start = simulation.pose(0);
    for (int frame = 1; frame <= 60; ++frame) {
        simulation.add_wrench(0, {.force = Vector3d(0.0, 0.0, 9.81 * body.mass) - lift,
                                  .moment = -body.center_of_buoyancy.cross(lift)});
        simulation.advance_to(frame / 60.0);
    }
    EXPECT_NEAR((simulation.pose(0).position - start.position).norm(), 0.0, 1e-12);
    EXPECT_NEAR(simulation.pose(0).orientation.angularDistance(start.orientation), 0.0, 1e-12);
}

TEST(HostForce, GivesTheSameMomentumAtAnyFrameRate) {
    const auto speed_at = [](double frame_rate) {
        Simulation simulation = floating(ideal());
        for (int frame = 1; frame <= frame_rate; ++frame) {
            simulation.add_wrench(0, {.force = Vector3d(0.1, 0.0, 0.0)});
            simulation.advance_to(frame / frame_rate);
        }
        return simulation.pose(0).velocity.x();
    };
    const double whole = speed_at(1.0);
    for (const double frame_rate : {24.0, 60.0, 144.0, 1000.0, 1200.0}) {
        EXPECT_NEAR(speed_at(frame_rate), whole, 1e-12) << frame_rate;
    }
}

TEST(HostForce, IsNotFeltBeforeTheStart) {
    Simulation simulation({.gravity = no_gravity});
    simulation.add(ellipsoid(), ideal(), {.start = 0.1});
    simulation.add_wrench(0, {.force = Vector3d(1.0, 0.0, 0.0)});
    simulation.advance_to(0.05);
    simulation.advance_to(0.2);
    EXPECT_EQ(simulation.pose(0).velocity.x(), 0.0);
    simulation.add_wrench(0, {.force = Vector3d(1.0, 0.0, 0.0)});
    simulation.advance_to(0.3);
    EXPECT_GT(simulation.pose(0).velocity.x(), 0.1);
}

TEST(HostForce, OnOneOfManyMovesItAsItMovesOneAloneAndTheOthersNotAtAll) {
    Simulation crowd({.gravity = no_gravity});
    crowd.add(ellipsoid(), stirred(), {.count = 20, .spread_angle = 1.0});
    Simulation others({.gravity = no_gravity});
    others.add(ellipsoid(), stirred(), {.count = 20, .spread_angle = 1.0});
    Simulation alone({.gravity = no_gravity});
    alone.add(ellipsoid(), stirred(), {.count = 1});
    Simulation pair({.gravity = no_gravity});
    pair.add(ellipsoid(), stirred(), {.count = 2});
    for (int frame = 1; frame <= 20; ++frame) {
        const Wrench wrench{.force = Vector3d(0.02, -0.03, 0.05 * frame),
                            .moment = Vector3d(1e-4, 0.0, 2e-4)};
        crowd.add_wrench(17, wrench);
        alone.add_wrench(0, wrench);
        pair.add_wrench(0, wrench);
        for (Simulation* simulation : {&crowd, &others, &alone, &pair}) simulation->advance_to(frame / 60.0);
    }
    for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(test::same(crowd.pose(i), others.pose(i)), i != 17) << i;
    EXPECT_TRUE(test::same(alone.pose(0), pair.pose(0)));
}

TEST(HostForce, OnABodyOfAnotherSizeMovesWhatThatBodyAndItsFluidWeigh) {
    Simulation simulation({.gravity = no_gravity});
    simulation.add(ellipsoid(), ideal(), {.smallest_size = 0.5, .largest_size = 0.5});
    ASSERT_EQ(simulation.size_of(0), 0.5);
    simulation.add_wrench(0, {.force = Vector3d(0.0, 0.01, 0.0), .moment = Vector3d(0.0, 1e-6, 0.0)});
    simulation.advance_to(0.1);
    EXPECT_NEAR(simulation.pose(0).velocity.y() * inertia_of(simulation)(4, 4) / 8.0, 0.001, 1e-12);
    EXPECT_NEAR(simulation.pose(0).angular_velocity.y() * inertia_of(simulation)(1, 1) / 32.0, 1e-7, 1e-16);
    EXPECT_NEAR(simulation.mass(0) * 8.0, simulation.groups()[0]->body().mass, 1e-15);
}

TEST(HostForce, WakesWhatRestsAndLetsItRestAgain) {
    Simulation simulation({.ground = 0.0});
    BodyPhysics physics = stirred();
    physics.turbulence = Turbulence::none;
    simulation.add(ellipsoid(), physics,
                   {.position = Vector3d(0.0, 0.0, 0.011),
                    .orientation = Quaterniond(std::sqrt(0.5), 0.0, std::sqrt(0.5), 0.0)});
    simulation.advance_to(5.0);
    ASSERT_TRUE(simulation.is_at_rest(0));
    const Pose there = simulation.pose(0);
    const double weight = 9.81 * (simulation.mass(0) - 998.2 * simulation.groups()[0]->body().volume);
    simulation.add_wrench(0, {.force = Vector3d(0.0, 0.01 * weight, 0.0)});
    simulation.advance_to(5.5);
    EXPECT_TRUE(simulation.is_at_rest(0))
        << "what stops a ball that rolls holds it against a hundredth of its weight";
    EXPECT_EQ(simulation.pose(0).position, there.position);
    simulation.add_wrench(0, {.force = Vector3d(0.0, 0.0, 2.0 * weight)});
    simulation.advance_to(6.0);
    EXPECT_FALSE(simulation.is_at_rest(0));
    EXPECT_GT(simulation.pose(0).position.z(), there.position.z() + 0.01);
    simulation.advance_to(15.0);
    EXPECT_TRUE(simulation.is_at_rest(0)) << "it fell back";
}

TEST(HostImpulse, ChangesTheVelocityByTheInverseOfK) {
    Simulation simulation = floating(ideal());
    simulation.advance_to(0.0013);
    const Wrench impulse{.force = Vector3d(1e-3, 2e-3, -3e-3), .moment = Vector3d(1e-5, -2e-5, 3e-5)};
    simulation.add_impulse(0, impulse);
    Vector6d momentum;
    momentum << impulse.moment, impulse.force;
    const Vector6d change = inertia_of(simulation).inverse() * momentum;
    const Pose now = simulation.pose(0);
    EXPECT_NEAR((now.angular_velocity - change.head<3>()).norm(), 0.0, 1e-12);
    EXPECT_NEAR((now.velocity - change.tail<3>()).norm(), 0.0, 1e-12);
    EXPECT_LT(now.position.norm(), 1e-15) << "it is where it was";
    simulation.advance_to(0.0023);
    EXPECT_NEAR((simulation.pose(0).position - 0.001 * change.tail<3>()).norm(), 0.0,
                1e-3 * simulation.pose(0).position.norm());
}

TEST(HostImpulse, TakesNothingFromTheFallAroundIt) {
    const auto height_with = [](int impulses) {
        Simulation simulation;
        simulation.add(ellipsoid(), ideal(), {});
        for (int i = 1; i <= 120; ++i) {
            simulation.advance_to(i / 120.0);
            for (int k = 0; k < impulses; ++k)
                simulation.add_impulse(0, {.force = Vector3d(0.0, 1e-300, 0.0)});
        }
        return simulation.pose(0).position.z();
    };
    EXPECT_NEAR(height_with(1), height_with(0), 1e-9 * std::abs(height_with(0)));
}

TEST(RemovedBody, StaysWhereItIsCostsNoStepsAndComesBackWhereItIsPut) {
    Simulation simulation({.fluid = {.current = Vector3d(0.1, 0.0, 0.0)}});
    simulation.add(ellipsoid(), stirred(), {.count = 3, .spread_position = Vector3d(0.1, 0.1, 0.0)});
    simulation.advance_to(0.1001);
    const Pose last = simulation.pose(1);
    simulation.remove(1);
    EXPECT_TRUE(test::same(simulation.pose(1), last));
    const std::uint64_t steps = simulation.steps();
    simulation.advance_to(0.2);
    EXPECT_TRUE(simulation.is_removed(1));
    EXPECT_TRUE(test::same(simulation.pose(1), last));
    EXPECT_EQ(simulation.steps() - steps, 2u * 49u) << "two bodies from 0.102 s to 0.2 s";
    Pose place = last;
    place.position = Vector3d(1.0, 2.0, 3.0);
    simulation.set_pose(1, place);
    EXPECT_FALSE(simulation.is_removed(1));
    simulation.advance_to(0.3);
    EXPECT_LT(simulation.pose(1).position.z(), 3.0);
    EXPECT_NEAR((simulation.pose(1).position - place.position).norm(), 0.0, 0.1);
}

TEST(RemovedBody, HasNoWakeWhereItIsPutBackAsOneThatIsSetHas) {
    Body shape = test::rubber_ellipsoid();
    shape.tables = test::blunt_tables(shape, 4);
    BodyPhysics physics = ideal();
    physics.loads = Loads::table;
    const auto flown = [&](const auto& change) {
        Simulation simulation;
        simulation.add({shape, "ellipsoid"}, physics,
                       {.orientation = Quaterniond(0.9, 0.3, 0.3, 0.0).normalized()});
        simulation.advance_to(0.2);
        change(simulation, simulation.pose(0));
        simulation.advance_to(0.25);
        return simulation.pose(0);
    };
    const Pose undisturbed = flown([](Simulation&, const Pose&) {});
    const auto apart = [&](const Pose& pose) {
        return pose.orientation.angularDistance(undisturbed.orientation);
    };
    EXPECT_LT(apart(flown([](Simulation& simulation, const Pose& now) { simulation.set_pose(0, now); })),
              1e-6);
    EXPECT_GT(apart(flown([](Simulation& simulation, const Pose& now) {
                  simulation.remove(0);
                  simulation.set_pose(0, now);
              })),
              1e-3);
}

TEST(RemovedBody, IsPartOfTheState) {
    const auto made = [] {
        Simulation simulation;
        simulation.add(ellipsoid(), stirred(), {.count = 2, .spread_angle = 1.0});
        return simulation;
    };
    Simulation first = made();
    first.advance_to(0.1);
    const std::string before = first.state();
    first.remove(0);
    first.advance_to(0.2);
    Simulation second = made();
    second.set_state(first.state());
    EXPECT_TRUE(second.is_removed(0));
    first.advance_to(0.4);
    second.advance_to(0.4);
    EXPECT_TRUE(test::same(first.pose(0), second.pose(0)));
    EXPECT_TRUE(test::same(first.pose(1), second.pose(1)));
    second.set_state(before);
    EXPECT_FALSE(second.is_removed(0));
    second.advance_to(0.4);
    EXPECT_LT(second.pose(0).position.z(), first.pose(0).position.z()) << "it falls again";
}

TEST(Contacts, GiveABodyThatComesToRestTheMomentumThatItsWeightTookFromIt) {
    Simulation simulation({.ground = 0.0});
    simulation.watch_contacts(true);
    simulation.add(ellipsoid(), ideal(), {.position = Vector3d(0.0, 0.0, 0.1)});
    Vector3d sum = Vector3d::Zero();
    double strongest = 0.0;
    double first_touch = 0.0;
    double time = 0.0;
    while (!simulation.is_at_rest(0) && time < 60.0) {
        time += 0.01;
        simulation.advance_to(time);
        const ContactRecord met = simulation.take_contacts(0);
        sum += met.impulse;
        strongest = std::max(strongest, met.strongest);
        if (met.strongest > 0.0 && first_touch == 0.0) {
            first_touch = met.time;
            EXPECT_EQ(met.obstacle, -1);
            EXPECT_NEAR((met.normal - Vector3d::UnitZ()).norm(), 0.0, 1e-12);
            EXPECT_NEAR(met.point.z(), 0.0, 2e-3) << "the contact lies on the ground";
        }
    }
    ASSERT_TRUE(simulation.is_at_rest(0));
    const double weight = 9.81 * (simulation.mass(0) - 998.2 * simulation.groups()[0]->body().volume);
    EXPECT_NEAR(sum.z(), weight * time, weight * 0.012) << "but for the last call, in which it came to rest";
    EXPECT_GT(strongest, 0.3 * weight * first_touch) << "the blow";
    EXPECT_EQ(simulation.take_contacts(0).strongest, 0.0) << "what was taken is taken";
}

TEST(Contacts, TellWhichObstacleWasMetAndChangeNothing) {
    const auto made = [] {
        SimulationSettings settings;
        settings.obstacles = {test::obstacle(test::sheet(1.0, 1.0), {Vector3d(5.0, 0.0, 0.0)}),
                              test::obstacle(test::sheet(1.0, 1.0))};
        settings.obstacles[1].name = "under";
        Simulation simulation(settings);
        simulation.add(ellipsoid(), stirred(), {.position = Vector3d(0.0, 0.0, 0.1), .count = 2});
        return simulation;
    };
    Simulation watched = made();
    Simulation plain = made();
    watched.watch_contacts(true);
    watched.advance_to(2.0);
    plain.advance_to(2.0);
    for (const std::size_t i : {0u, 1u}) {
        const ContactRecord met = watched.take_contacts(i);
        EXPECT_EQ(met.obstacle, 1);
        EXPECT_GT(met.impulse.z(), 0.0);
        EXPECT_TRUE(test::same(watched.pose(i), plain.pose(i)));
    }
    EXPECT_THAT(test::error_of([&] { (void)plain.take_contacts(0); }), HasSubstr("call watch_contacts"));
}

/// Current, gust and a vortex.
SimulationSettings in_moving_fluid() {
    SimulationSettings settings;
    settings.fluid.current = Vector3d(0.1, 0.2, 0.0);
    settings.fluid.gust = {.amplitude = Vector3d(0.3, 0.0, 0.1), .period = 0.9};
    settings.wind.vortices = {
        {.position = Vector3d(0.3, 0.0, 0.0), .axis = Vector3d::UnitZ(), .circulation = 1.0}};
    return settings;
}

/// A lopsided body in all that moves: turbulence, wind, gust and current.
Simulation lopsided_in_moving_fluid(double step, double size = 1.0) {
    SimulationSettings settings = in_moving_fluid();
    settings.step = step;
    Simulation simulation(settings);
    BodyPhysics physics;
    physics.mass.mass = 0.05;
    physics.mass.center_of_mass = Vector3d(0.002, -0.003, 0.004);
    simulation.add({test::lopsided_shape(), "lopsided"}, physics,
                   {.velocity = Vector3d(0.2, -0.3, 0.4),
                    .angular_velocity = Vector3d(2.0, 3.0, -4.0),
                    .smallest_size = size,
                    .largest_size = size});
    return simulation;
}

/// The body's own inertia about its centre of mass (world axes; angular, linear), and its own wrench.
std::pair<Matrix6d, Vector6d> own(const Simulation& simulation, std::size_t index, const Vector3d& gravity) {
    const Pose pose = simulation.pose(index);
    const Matrix3d turn = pose.orientation.toRotationMatrix();
    const Matrix3d inertia = turn * simulation.inertia(index) * turn.transpose();
    Matrix6d matrix = Matrix6d::Zero();
    matrix.topLeftCorner<3, 3>() = inertia;
    matrix.bottomRightCorner<3, 3>() = simulation.mass(index) * Matrix3d::Identity();
    Vector6d wrench;
    wrench << -pose.angular_velocity.cross(inertia * pose.angular_velocity), simulation.mass(index) * gravity;
    return {matrix, wrench};
}

const Vector3d earth(0.0, 0.0, -9.81);

void expect_the_acceleration_of_the_next_step(double size, int before) {
    constexpr double step = 1e-5;
    Simulation simulation = lopsided_in_moving_fluid(step, size);
    simulation.advance_to(before * step);
    const auto [mass, weight] = own(simulation, 0, earth);
    const FluidLoad load = simulation.fluid_load(0);
    const Vector6d acceleration = (mass + load.added_inertia).inverse() * (weight + load.wrench);
    const Pose now = simulation.pose(0);
    simulation.advance_to((before + 1) * step);
    const Pose next = simulation.pose(0);
    Vector6d flown;
    flown << (next.angular_velocity - now.angular_velocity) / step, (next.velocity - now.velocity) / step;
    const Vector6d off = acceleration - flown;
    EXPECT_LT(off.head<3>().norm(), 2e-3 * flown.head<3>().norm()) << size << ' ' << before;
    EXPECT_LT(off.tail<3>().norm(), 2e-3 * flown.tail<3>().norm()) << size << ' ' << before;
}

TEST(FluidLoads, GiveTheAccelerationOfTheBodysOwnNextStep) {
    for (const int before : {0, 40}) expect_the_acceleration_of_the_next_step(1.0, before);
}

TEST(FluidLoads, GiveItForBodiesOfAnotherSize) {
    for (const double size : {0.5, 3.0}) {
        for (const int before : {0, 40}) expect_the_acceleration_of_the_next_step(size, before);
    }
}

TEST(FluidLoads, HaveASymmetricInertiaAndADampingThatTakesEnergy) {
    const Simulation simulation = lopsided_in_moving_fluid(0.002);
    const FluidLoad load = simulation.fluid_load(0);
    EXPECT_LT((load.added_inertia - load.added_inertia.transpose()).norm(), 1e-15);
    const Eigen::SelfAdjointEigenSolver<Matrix6d> inertia(load.added_inertia);
    EXPECT_GT(inertia.eigenvalues().minCoeff(), 0.0);
    const Eigen::SelfAdjointEigenSolver<Matrix6d> damping(load.damping + load.damping.transpose());
    EXPECT_GE(damping.eigenvalues().minCoeff(), -1e-12 * damping.eigenvalues().maxCoeff());
}

/// The distance between a body that a host integrates itself and samara's own simulation after a second,
/// relative to the path.
double distance_of_host(double step) {
    const auto made = [&] {
        Simulation simulation({.step = step});
        BodyPhysics physics;
        physics.mass.density = 1200.0;
        physics.turbulence = Turbulence::none;
        simulation.add(
            {test::lopsided_shape(), "lopsided"}, physics,
            {.orientation = Quaterniond(Eigen::AngleAxisd(0.4, Vector3d(1.0, 2.0, 0.5).normalized()))});
        return simulation;
    };
    Simulation flown = made();
    flown.advance_to(1.0);
    Simulation asked = made();
    const int steps = static_cast<int>(std::lround(1.0 / step));
    for (int i = 0; i < steps; ++i) {
        Pose pose = asked.pose(0);
        const auto [mass, wrench] = own(asked, 0, earth);
        const FluidLoad load = asked.fluid_load(0);
        const Matrix6d system = mass + load.added_inertia + step * load.damping;
        const Vector6d change = step * system.inverse() * (wrench + load.wrench);
        pose.angular_velocity += change.head<3>();
        pose.velocity += change.tail<3>();
        pose.position += step * pose.velocity;
        const double angle = step * pose.angular_velocity.norm();
        pose.orientation =
            Quaterniond(Eigen::AngleAxisd(angle, pose.angular_velocity.normalized())) * pose.orientation;
        asked.advance_to((i + 1) * step);
        asked.set_pose(0, pose);
    }
    return (asked.pose(0).position - flown.pose(0).position).norm() / flown.pose(0).position.norm();
}

TEST(FluidLoads, LetAHostFlyTheBodyAsSamaraDoesToFirstOrder) {
    const double coarse = distance_of_host(0.002);
    const double fine = distance_of_host(0.001);
    EXPECT_LT(coarse, 0.02);
    EXPECT_NEAR(coarse / fine, 2.0, 0.5);
}

/// The fastest that a sinking sphere of that density came to be in a second, where the host pushes it with
/// -A a of the acceleration of the step before.
double fastest_with_lag(double density) {
    Simulation simulation;
    simulation.add({test::exact_sphere(0.01), "sphere"}, ideal(density), {});
    constexpr double step = 0.002;
    Vector6d acceleration = Vector6d::Zero();
    double fastest = 0.0;
    for (int i = 0; i < 500 && fastest < 1e6; ++i) {
        Pose pose = simulation.pose(0);
        const auto [mass, wrench] = own(simulation, 0, earth);
        const FluidLoad load = simulation.fluid_load(0);
        acceleration = mass.inverse() * (wrench + load.wrench - load.added_inertia * acceleration);
        pose.velocity += step * acceleration.tail<3>();
        fastest = std::max(fastest, pose.velocity.norm());
        simulation.advance_to((i + 1) * step);
        simulation.set_pose(0, pose);
    }
    return fastest;
}

TEST(FluidLoads, PushedWithTheAccelerationBeforeALightBodyDiverges) {
    EXPECT_LT(fastest_with_lag(600.0), 10.0) << "the fluid's 499 kg/m^3 is less than its own";
    EXPECT_GT(fastest_with_lag(400.0), 1e6) << "more";
}

TEST(FluidLoads, AreThoseOfAWholeStep) {
    Simulation simulation = floating(ideal());
    simulation.advance_to(0.003);
    EXPECT_THAT(test::error_of([&] { return simulation.fluid_load(0); }), HasSubstr("is within a step;"));
}

/// Whether each block of angular and linear parts is the same.
void expect_near(const Matrix6d& a, const Matrix6d& b) {
    for (const Eigen::Index row : {0, 3}) {
        for (const Eigen::Index column : {0, 3}) {
            const Matrix3d wanted = b.block<3, 3>(row, column);
            const Matrix3d difference = a.block<3, 3>(row, column) - wanted;
            EXPECT_LT(difference.norm(), 1e-9 * wanted.norm() + 1e-15);
        }
    }
}

TEST(FluidLoads, OfABodyOfAnotherSizeAreThoseOfABodyFileOfThatSize) {
    Body body = test::rubber_ellipsoid();
    body.tables = test::blunt_tables(body, 4);
    BodyPhysics of_tables = ideal();
    of_tables.loads = Loads::table;
    of_tables.turbulence = Turbulence::table;
    for (const BodyPhysics& physics : {of_tables, stirred()}) {
        for (const double size : {0.3, 2.0}) {
            Simulation sized(in_moving_fluid());
            Simulation scaled(in_moving_fluid());
            Release release{.velocity = Vector3d(0.2, -0.3, 0.4),
                            .angular_velocity = Vector3d(2.0, 3.0, -4.0)};
            scaled.add({test::scaled(body, size), "body"}, physics, release);
            release.smallest_size = release.largest_size = size;
            sized.add({body, "body"}, physics, release);
            for (Simulation* simulation : {&sized, &scaled}) simulation->advance_to(0.02);
            const FluidLoad one = sized.fluid_load(0);
            const FluidLoad other = scaled.fluid_load(0);
            EXPECT_LT((one.wrench - other.wrench).head<3>().norm(), 1e-9 * other.wrench.head<3>().norm());
            EXPECT_LT((one.wrench - other.wrench).tail<3>().norm(), 1e-9 * other.wrench.tail<3>().norm());
            expect_near(one.added_inertia, other.added_inertia);
            expect_near(one.damping, other.damping);
        }
    }
}

}  // namespace
}  // namespace samara
