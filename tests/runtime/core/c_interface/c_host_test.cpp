// What game engines and robotics simulators ask of the C interface.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/c_interface_calls.hpp"
#include "samara/core/simulation/simulation.hpp"

namespace samara {
namespace {

using namespace test;
using testing::HasSubstr;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

samara_settings weightless() {
    samara_settings settings = default_settings();
    settings.gravity[2] = 0.0;
    return settings;
}

/// Without loads, at the origin.
samara_body_group ideal_group() {
    samara_body_group group;
    EXPECT_EQ(samara_default_body_group(&group, sizeof group, nullptr, 0), SAMARA_OK);
    group.density = 1200.0;
    group.loads = SAMARA_LOADS_NONE;
    group.turbulence = SAMARA_TURBULENCE_NONE;
    return group;
}

TEST(CHost, PushesAtAPointAsByAForceAndItsMoment) {
    const BodyOnDisk body;
    const SimulationPointer at_point = simulation_of(body, ideal_group(), weightless());
    const SimulationPointer by_moment = simulation_of(body, ideal_group(), weightless());
    const double force[3] = {0.1, 0.0, 0.0};
    const double point[3] = {0.0, 0.0, 0.02};
    const double moment[3] = {0.0, 0.002, 0.0};
    Text error;
    ASSERT_EQ(CALL(samara_add_force, at_point.get(), 0, force, point), SAMARA_OK) << error.text();
    ASSERT_EQ(CALL(samara_add_force, by_moment.get(), 0, force, nullptr), SAMARA_OK) << error.text();
    ASSERT_EQ(CALL(samara_add_moment, by_moment.get(), 0, moment), SAMARA_OK) << error.text();
    const std::vector<samara_pose> pushed = poses_at(at_point, 0.1);
    const std::vector<samara_pose> turned = poses_at(by_moment, 0.1);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(pushed[0].position[axis], turned[0].position[axis], 1e-12);
        EXPECT_NEAR(pushed[0].angular_velocity[axis], turned[0].angular_velocity[axis], 1e-10);
    }
    EXPECT_GT(pushed[0].angular_velocity[1], 1.0);
    EXPECT_GT(pushed[0].velocity[0], 0.1);
}

TEST(CHost, AngularAndLinearImpulsesAreOneAtAPoint) {
    const BodyOnDisk body;
    const SimulationPointer at_point = simulation_of(body, ideal_group(), weightless());
    const SimulationPointer in_two = simulation_of(body, ideal_group(), weightless());
    const double impulse[3] = {0.0, 0.01, 0.0};
    const double point[3] = {0.005, 0.0, 0.0};
    const double angular[3] = {0.0, 0.0, 5e-5};
    Text error;
    ASSERT_EQ(CALL(samara_add_impulse, at_point.get(), 0, impulse, point), SAMARA_OK) << error.text();
    ASSERT_EQ(CALL(samara_add_impulse, in_two.get(), 0, impulse, nullptr), SAMARA_OK) << error.text();
    ASSERT_EQ(CALL(samara_add_angular_impulse, in_two.get(), 0, angular), SAMARA_OK) << error.text();
    const samara_pose one = poses_of(at_point)[0];
    const samara_pose other = poses_of(in_two)[0];
    EXPECT_NEAR(one.velocity[1], other.velocity[1], 1e-15);
    EXPECT_NEAR(one.angular_velocity[2], other.angular_velocity[2], 1e-14);
    samara_mass_properties own;
    ASSERT_EQ(CALL(samara_get_mass_properties, at_point.get(), 0, &own), SAMARA_OK) << error.text();
    EXPECT_LT(one.velocity[1], 0.9 * 0.01 / own.mass) << "the fluid takes its part";
}

TEST(CHost, RemovedBodiesStandStillUntilTheyArePutBack) {
    const BodyOnDisk body;
    const SimulationPointer simulation = simulation_of(body, rubber_group(3));
    Text error;
    const std::vector<samara_pose> poses = poses_at(simulation, 0.5);
    ASSERT_EQ(CALL(samara_remove, simulation.get(), 1, 2), SAMARA_OK) << error.text();
    EXPECT_EQ(samara_is_removed(simulation.get(), 0), 0);
    EXPECT_EQ(samara_is_removed(simulation.get(), 2), 1);
    EXPECT_EQ(samara_is_removed(simulation.get(), 3), 0) << "there is none such";
    const std::vector<samara_pose> later = poses_at(simulation, 1.0);
    EXPECT_TRUE(same_bytes({later.begin() + 1, later.end()}, {poses.begin() + 1, poses.end()}));
    EXPECT_LT(later[0].position[2], poses[0].position[2]);
    const double force[3] = {1.0, 0.0, 0.0};
    EXPECT_EQ(CALL(samara_add_force, simulation.get(), 2, force, nullptr), SAMARA_INVALID_ARGUMENT);
    EXPECT_EQ(error.text(), "body 2 is removed; put it back with samara_set_poses");
    ASSERT_EQ(CALL(samara_set_poses, simulation.get(), 2, 1, &poses[2], 0), SAMARA_OK) << error.text();
    EXPECT_EQ(samara_is_removed(simulation.get(), 2), 0);
    EXPECT_LT(poses_at(simulation, 1.5)[2].position[2], poses[2].position[2]);
}

TEST(CHost, KindsSpreadSizesAndStarts) {
    const BodyOnDisk body;
    samara_body_group group = rubber_group(8);
    group.smallest_size = 0.5;
    group.largest_size = 2.0;
    group.spread_start = 0.4;
    const SimulationPointer simulation = simulation_of(body, group);
    std::array<double, 8> sizes{};
    Text error;
    ASSERT_EQ(CALL(samara_get_sizes, simulation.get(), 0, 8, sizes.data()), SAMARA_OK) << error.text();
    EXPECT_THAT(sizes, testing::Each(testing::AllOf(testing::Ge(0.5), testing::Le(2.0))));
    EXPECT_GT(*std::max_element(sizes.begin(), sizes.end()) - *std::min_element(sizes.begin(), sizes.end()),
              0.3);
    samara_mass_properties large;
    ASSERT_EQ(CALL(samara_get_mass_properties, simulation.get(), 3, &large), SAMARA_OK) << error.text();
    EXPECT_NEAR(large.mass, 1200.0 * samara_body_volume(body.get()) * std::pow(sizes[3], 3), 1e-9);
    EXPECT_GT(large.inertia[0], 0.0);
    const std::vector<samara_pose> begin = poses_of(simulation);
    const std::vector<samara_pose> soon = poses_at(simulation, 0.2);
    int waiting = 0;
    for (std::size_t i = 0; i < 8; ++i) waiting += soon[i].position[2] == begin[i].position[2] ? 1 : 0;
    EXPECT_GT(waiting, 0);
    EXPECT_LT(waiting, 8);
}

TEST(CHost, ASingleBodyHasTheSizeThatIsGivenTwice) {
    const BodyOnDisk body;
    samara_body_group group = ideal_group();
    group.smallest_size = group.largest_size = 0.25;
    const SimulationPointer simulation = simulation_of(body, group);
    double size = 0.0;
    Text error;
    ASSERT_EQ(CALL(samara_get_sizes, simulation.get(), 0, 1, &size), SAMARA_OK) << error.text();
    EXPECT_EQ(size, 0.25);
}

TEST(CHost, AKindOfVersionSixStillHasTheShapesSize) {
    const BodyOnDisk body;
    samara_body_group group;
    const std::size_t old_size = offsetof(samara_body_group, spread_start);
    ASSERT_EQ(samara_default_body_group(&group, old_size, nullptr, 0), SAMARA_OK);
    EXPECT_EQ(group.size, old_size);
    group.density = 1200.0;
    group.smallest_size = not_a_number;  // which a caller of that version has not
    const SimulationPointer simulation = simulation_of(body, group);
    double size = 0.0;
    Text error;
    ASSERT_EQ(CALL(samara_get_sizes, simulation.get(), 0, 1, &size), SAMARA_OK) << error.text();
    EXPECT_EQ(size, 1.0);
}

TEST(CHost, TakesWhatBodiesMetIntoObjectsOfTheHost) {
    const BodyOnDisk body;
    samara_settings settings = default_settings();
    settings.has_ground = 1;
    samara_body_group group = ideal_group();
    group.count = 2;
    group.position[2] = 0.1;
    const SimulationPointer simulation = simulation_of(body, group, settings);
    Text error;
    ASSERT_EQ(CALL(samara_watch_contacts, simulation.get(), 1), SAMARA_OK) << error.text();
    poses_at(simulation, 10.0);
    struct Object {
        samara_contact contact;
        double own;
    };
    std::array<Object, 2> objects{};
    objects[0].own = objects[1].own = 7.0;
    ASSERT_EQ(CALL(samara_take_contacts, simulation.get(), 0, 2, &objects[0].contact, sizeof(Object)),
              SAMARA_OK)
        << error.text();
    for (const Object& object : objects) {
        EXPECT_GT(object.contact.strongest, 0.0);
        EXPECT_EQ(object.contact.obstacle, -1);
        EXPECT_EQ(object.contact.at_rest, 1);
        EXPECT_NEAR(object.contact.normal[2], 1.0, 1e-12);
        EXPECT_GT(object.contact.time, 0.1);
        EXPECT_EQ(object.own, 7.0);
    }
    samara_contact again;
    ASSERT_EQ(CALL(samara_take_contacts, simulation.get(), 1, 1, &again, 0), SAMARA_OK) << error.text();
    EXPECT_EQ(again.strongest, 0.0);
    EXPECT_EQ(again.at_rest, 1);
}

TEST(CHost, GivesTheFluidLoadOfTheFlight) {
    const BodyOnDisk body;
    const SimulationPointer simulation = simulation_of(body, rubber_group());
    poses_at(simulation, 0.1);
    samara_fluid_load load;
    Text error;
    ASSERT_EQ(CALL(samara_get_fluid_load, simulation.get(), 0, &load), SAMARA_OK) << error.text();
    for (std::size_t row = 0; row < 6; ++row) {
        for (std::size_t column = 0; column < 6; ++column) {
            EXPECT_NEAR(load.added_inertia[6 * row + column], load.added_inertia[6 * column + row], 1e-15);
        }
        EXPECT_GT(load.added_inertia[7 * row], 0.0);
        EXPECT_GT(load.damping[7 * row], 0.0);
    }
    EXPECT_GT(load.wrench[5], 0.0) << "buoyancy and drag, upwards";
}

TEST(CHost, LetsBodiesMeetAndSaysWhichWasMet) {
    const BodyOnDisk body;
    samara_settings settings = default_settings();
    settings.bodies_collide = 1;
    settings.gravity[2] = 0.0;
    const SimulationPointer simulation = simulation_of(body, ideal_group(), settings);
    samara_body_group striking = ideal_group();
    striking.name = "striking";
    striking.position[2] = 0.1;
    striking.velocity[2] = -0.5;
    Text error;
    ASSERT_EQ(CALL(samara_simulation_add, simulation.get(), body.get(), &striking, nullptr), SAMARA_OK)
        << error.text();
    ASSERT_EQ(CALL(samara_watch_contacts, simulation.get(), 1), SAMARA_OK) << error.text();
    poses_at(simulation, 1.0);
    std::array<samara_contact, 2> contacts{};
    ASSERT_EQ(CALL(samara_take_contacts, simulation.get(), 0, 2, contacts.data(), 0), SAMARA_OK)
        << error.text();
    EXPECT_EQ(contacts[0].obstacle, -2 - 1);
    EXPECT_EQ(contacts[1].obstacle, -2 - 0);
    EXPECT_LT(contacts[0].impulse[2], 0.0);
    EXPECT_NEAR(contacts[0].impulse[2], -contacts[1].impulse[2], 1e-12);
}

TEST(CHost, StepsInSinglePrecisionWhereBodiesDoNotMeet) {
    const BodyOnDisk body;
    samara_settings settings = default_settings();
    const samara_pose in_double = poses_at(simulation_of(body, rubber_group(), settings), 0.5)[0];
    settings.precision = SAMARA_PRECISION_SINGLE;
    const samara_pose in_single = poses_at(simulation_of(body, rubber_group(), settings), 0.5)[0];
    EXPECT_NE(in_single.position[2], in_double.position[2]);
    EXPECT_NEAR(in_single.position[2], in_double.position[2], 1e-4);
    samara_simulation* none = nullptr;
    Text error;
    settings.bodies_collide = 1;
    EXPECT_EQ(CALL(samara_simulation_create, &settings, &none), SAMARA_INVALID_ARGUMENT);
    EXPECT_THAT(error.text(), HasSubstr("precision must be \"double\" where bodies_collide is true"));
    settings.precision = 2;
    EXPECT_EQ(CALL(samara_simulation_create, &settings, &none), SAMARA_INVALID_ARGUMENT);
    EXPECT_THAT(error.text(), HasSubstr("precision is not one of"));
}

TEST(CHost, RefusesWhatIsNoForceBodyOrPlace) {
    const BodyOnDisk body;
    const SimulationPointer simulation = simulation_of(body, rubber_group());
    samara_simulation* s = simulation.get();
    Text error;
    const auto expect_rejected = [&](samara_status status, const std::string& why) {
        EXPECT_EQ(status, SAMARA_INVALID_ARGUMENT);
        EXPECT_THAT(error.text(), HasSubstr(why));
    };
    const std::string before = state_of(simulation);
    const double good[3] = {1.0, 0.0, 0.0};
    const double bad[3] = {0.0, not_a_number, 0.0};
    expect_rejected(CALL(samara_add_force, s, 1, good, nullptr), "body is 1, but there are 1");
    expect_rejected(CALL(samara_add_force, s, 0, bad, nullptr), "force");
    expect_rejected(CALL(samara_add_force, s, 0, good, bad), "point");
    expect_rejected(CALL(samara_add_force, s, 0, nullptr, nullptr), "force");
    expect_rejected(CALL(samara_add_force, nullptr, 0, good, nullptr), "simulation");
    expect_rejected(CALL(samara_add_moment, s, 0, bad), "moment");
    expect_rejected(CALL(samara_add_impulse, s, 0, bad, nullptr), "impulse");
    expect_rejected(CALL(samara_add_angular_impulse, s, 0, bad), "angular_impulse");
    expect_rejected(CALL(samara_remove, s, 0, 2), "bodies 0 to 2 are requested, but there are 1");
    expect_rejected(CALL(samara_get_sizes, s, 0, 1, nullptr), "sizes");
    expect_rejected(CALL(samara_take_contacts, s, 0, 1, nullptr, 0), "contacts");
    samara_contact contact;
    expect_rejected(CALL(samara_take_contacts, s, 0, 1, &contact, 50), "stride is 50");
    expect_rejected(CALL(samara_take_contacts, s, 0, 1, &contact, 0), "call watch_contacts");
    expect_rejected(CALL(samara_get_mass_properties, s, 0, nullptr), "properties");
    expect_rejected(CALL(samara_get_fluid_load, s, 0, nullptr), "load");
    samara_body_group group = rubber_group(2);
    group.smallest_size = 0.0;
    expect_rejected(CALL(samara_simulation_add, s, body.get(), &group, nullptr), "smallest_size");
    group.smallest_size = 2.0;
    expect_rejected(CALL(samara_simulation_add, s, body.get(), &group, nullptr),
                    "the smallest and the largest size");
    group = rubber_group(1);
    group.largest_size = 2.0;
    expect_rejected(CALL(samara_simulation_add, s, body.get(), &group, nullptr), "needs several copies");
    EXPECT_EQ(state_of(simulation), before) << "a call that fails changes nothing";
    poses_at(simulation, 0.003);
    samara_fluid_load load;
    expect_rejected(CALL(samara_get_fluid_load, s, 0, &load), "is within a step");
}

}  // namespace
}  // namespace samara
